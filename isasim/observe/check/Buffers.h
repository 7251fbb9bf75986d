/// Who holds which part of global memory: what a driver has allocated, by name.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace vorion::isasim {

class Buffers {
public:
  struct Buffer {
    uint32_t Address = 0;
    uint64_t Bytes = 0;
    std::string Name; ///< "buffer", or what it is for the run
    uint64_t end() const { return Address + Bytes; }
  };

  void add(uint32_t Address, uint64_t Bytes, std::string Name) {
    ByAddress[Address] = {Address, Bytes, std::move(Name)};
  }
  void remove(uint32_t Address) { ByAddress.erase(Address); }
  /// Renames the buffer that holds \p Address, if one does.
  void rename(uint32_t Address, std::string Name);

  bool empty() const { return ByAddress.empty(); }
  /// The buffer that holds all of [Address, Address + Bytes), or nullptr.
  const Buffer *find(uint32_t Address, uint64_t Bytes) const;
  /// "4 bytes past the end of 'out' (256 bytes at 0x...)", or where else
  /// \p Address lies as seen from the nearest buffer.
  std::string describe(uint32_t Address) const;

private:
  std::map<uint32_t, Buffer> ByAddress;
};

} // namespace vorion::isasim
