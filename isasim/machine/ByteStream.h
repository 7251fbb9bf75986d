/// Values as bytes of the host, for what this build of the simulator reads
/// again. Whatever has the same functions in a writer and a reader is told
/// once, as a template of either.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace vorion::isasim {

/// Numbers, and structures of numbers: no bool, whose bytes could be wrong.
template <typename T>
concept Plain = std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>;

class ByteWriter {
public:
  template <Plain T> void value(const T &From) {
    raw(std::as_bytes(std::span(&From, 1)));
  }
  void flag(const bool &From) { value(static_cast<uint32_t>(From)); }
  template <Plain T> void list(const std::vector<T> &From) {
    value(uint64_t{From.size()});
    raw(std::as_bytes(std::span(From)));
  }
  void text(const std::string &From) {
    value(uint64_t{From.size()});
    raw(std::as_bytes(std::span(From)));
  }
  void raw(std::span<const std::byte> From) {
    Bytes.insert(Bytes.end(), From.begin(), From.end());
  }
  const std::vector<std::byte> &bytes() const { return Bytes; }

private:
  std::vector<std::byte> Bytes;
};

/// Once something is not there, nothing more is read.
class ByteReader {
public:
  explicit ByteReader(std::span<const std::byte> From) : Rest(From) {}

  template <Plain T> void value(T &To) { copy(&To, sizeof(T)); }
  void flag(bool &To) {
    uint32_t Word = 0;
    value(Word);
    To = Word != 0;
  }
  template <Plain T> void list(std::vector<T> &To) {
    To.resize(count(sizeof(T)));
    copy(To.data(), To.size() * sizeof(T));
  }
  void text(std::string &To) {
    To.resize(count(1));
    copy(To.data(), To.size());
  }
  /// The next \p Bytes of what is read, or as many as there are.
  std::span<const std::byte> raw(uint64_t Bytes) {
    Good &= Bytes <= Rest.size();
    const auto Taken = Rest.first(Good ? Bytes : 0);
    Rest = Rest.subspan(Taken.size());
    return Taken;
  }
  bool good() const { return Good; }
  /// Whether all was there, and nothing else is.
  bool atEnd() const { return Good && Rest.empty(); }

private:
  /// How many of \p Each bytes follow. Is believed as far as there are bytes.
  std::size_t count(std::size_t Each) {
    uint64_t Count = 0;
    value(Count);
    Good &= Count <= Rest.size() / Each;
    return Good ? Count : 0;
  }
  void copy(void *To, std::size_t Bytes) {
    const auto From = raw(Bytes);
    if (!From.empty())
      std::memcpy(To, From.data(), From.size());
  }

  std::span<const std::byte> Rest;
  bool Good = true;
};

} // namespace vorion::isasim
