/// When what a unit has asked memory for is there, and which part of the wait
/// for it belongs to the link.
#pragma once

#include "timing/common/Turn.h"

#include <algorithm>
#include <cstdint>

namespace vorion::isasim {

/// Of a line that has come, or of a write that has been taken. Times are cycles
/// of the chip.
struct Arrival {
  uint64_t At = 0; ///< Turn::Never while it is not known
  /// \name Its messages are on the link to the L2, or wait for it
  /// @{
  uint64_t RequestUntil = 0;         ///< the request until then
  uint64_t AnswerFrom = Turn::Never; ///< the answer from then until At
  /// @}

  bool crossesLink() const { return RequestUntil || AnswerFrom != Turn::Never; }

  /// Divides the cycles from \p From until \p Until, in which a unit waited for
  /// it, in the order of time: \p Spend gets whether a part is of the link, and
  /// where the part ends.
  template <typename Function>
  void divide(uint64_t From, uint64_t Until, Function Spend) const {
    const auto Part = [&](bool IsLink, uint64_t End) {
      End = std::min(End, Until);
      if (End > From) {
        Spend(IsLink, End);
        From = End;
      }
    };
    Part(true, RequestUntil);
    Part(false, AnswerFrom);
    Part(true, At);
    Part(false, Until);
  }
};

} // namespace vorion::isasim
