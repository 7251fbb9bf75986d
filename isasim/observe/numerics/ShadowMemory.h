/// A double for each word of guest memory that holds an fp32 value.
#pragma once

#include "core/IsaTables.h"
#include "observe/numerics/Sites.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace vorion::isasim {

/// What is shadowed belongs to the bits that were stored with it: a word that
/// something else has written since has no shadow, unless with the same bits.
class ShadowMemory {
public:
  struct Word {
    double Value = 0;
    uint32_t Bits = 0;
    uint32_t From = 0; ///< an Origin's word; 0: no shadow
  };

  /// For \p Cores cores; local memories are emptied, the rest stays.
  void begin(unsigned Cores) {
    Locals.resize(Cores);
    for (Pages &L : Locals)
      L.clear();
  }

  /// The shadow of the word at \p Address as core \p Core sees it, or nullptr
  /// if it has none or holds other bits than \p Bits.
  const Word *find(unsigned Core, uint32_t Address, uint32_t Bits) const {
    const Pages &P = pagesOf(Core, Address);
    const uint32_t Number = numberOf(Address);
    if (Number >= P.size() || !P[Number])
      return nullptr;
    const Word &W = (*P[Number])[Address / 4 % PageWords];
    return W.From != 0 && W.Bits == Bits ? &W : nullptr;
  }

  void set(unsigned Core, uint32_t Address, const Word &W) {
    Pages &P = pagesOf(Core, Address);
    const uint32_t Number = numberOf(Address);
    if (Number >= P.size())
      P.resize(Number + 1);
    if (!P[Number])
      P[Number] = std::make_unique<Page>();
    (*P[Number])[Address / 4 % PageWords] = W;
  }

  /// Words that overlap the range lose their shadow.
  void drop(unsigned Core, uint32_t Address, uint64_t Bytes) {
    Pages &P = pagesOf(Core, Address);
    const uint64_t End = Address + Bytes;
    for (uint64_t At = Address & ~3U; At < End;) {
      const uint32_t Number = numberOf(static_cast<uint32_t>(At));
      if (Number >= P.size() || !P[Number]) {
        At = (At / PageBytes + 1) * PageBytes;
        continue;
      }
      (*P[Number])[At / 4 % PageWords].From = 0;
      At += 4;
    }
  }

private:
  static constexpr uint32_t PageWords = 1024, PageBytes = 4 * PageWords;
  using Page = std::array<Word, PageWords>;
  using Pages = std::vector<std::unique_ptr<Page>>;

  static uint32_t numberOf(uint32_t Address) {
    return (Address >= VX_LOCAL_BASE ? Address - VX_LOCAL_BASE : Address) /
           PageBytes;
  }
  const Pages &pagesOf(unsigned Core, uint32_t Address) const {
    return Address >= VX_LOCAL_BASE ? Locals[Core] : Shared;
  }
  Pages &pagesOf(unsigned Core, uint32_t Address) {
    return Address >= VX_LOCAL_BASE ? Locals[Core] : Shared;
  }

  Pages Shared;
  std::vector<Pages> Locals; ///< by core
};

} // namespace vorion::isasim
