/// Instructions by what they do, for tests that draw from them.
#pragma once

#include "core/Effects.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

namespace vorion::isasim::testing {

/// All instructions of \p Classes, in the order of the records.
inline std::vector<Op> opsOf(std::initializer_list<EffectClass> Classes) {
  std::vector<Op> Ops;
  for (unsigned N = 0; N != NumOps; ++N)
    if (const Op O = static_cast<Op>(N);
        std::ranges::find(Classes, effectsOf(O).Class) != Classes.end())
      Ops.push_back(O);
  return Ops;
}

/// What computes a register from registers and the immediate, without a trap or
/// a jump.
inline std::vector<Op> computations() {
  return opsOf(
      {EffectClass::LaneWise, EffectClass::Vote, EffectClass::Shuffle});
}

/// What reads or writes memory.
inline std::vector<Op> accesses() {
  return opsOf({EffectClass::Load, EffectClass::Store, EffectClass::Atomic});
}

} // namespace vorion::isasim::testing
