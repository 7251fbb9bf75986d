/// A bit for each byte of guest memory.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <unordered_map>

namespace vorion::isasim {

class ShadowBits {
public:
  void set(uint32_t Address, uint64_t Bytes, bool Value) {
    while (Bytes) {
      const uint32_t Offset = Address % PageBytes;
      const uint64_t Part = std::min<uint64_t>(Bytes, PageBytes - Offset);
      Page &P = page(Address);
      if (Part == PageBytes)
        Value ? P.set() : P.reset();
      else
        for (uint64_t N = 0; N != Part; ++N)
          P[Offset + N] = Value;
      Address += static_cast<uint32_t>(Part);
      Bytes -= Part;
    }
  }
  /// Whether all are set; the range lies within a page.
  bool all(uint32_t Address, unsigned Bytes) {
    const Page &P = page(Address);
    for (unsigned N = 0; N != Bytes; ++N)
      if (!P[(Address + N) % PageBytes])
        return false;
    return true;
  }
  void clear() {
    Pages.clear();
    Last = nullptr;
  }

private:
  static constexpr uint32_t PageBytes = 4096;
  using Page = std::bitset<PageBytes>;

  Page &page(uint32_t Address) {
    const uint32_t Number = Address / PageBytes;
    if (Last && LastNumber == Number)
      return *Last;
    std::unique_ptr<Page> &P = Pages[Number];
    if (!P)
      P = std::make_unique<Page>();
    LastNumber = Number;
    Last = P.get();
    return *Last;
  }

  std::unordered_map<uint32_t, std::unique_ptr<Page>> Pages;
  uint32_t LastNumber = 0;
  Page *Last = nullptr;
};

} // namespace vorion::isasim
