/// Instructions by what they do, for tests that draw from them.
#pragma once

#include "core/Isa.h"

#include <algorithm>
#include <array>

namespace vorion::isasim::testing {

/// What computes a register from registers and the immediate, lane by lane.
inline constexpr auto Computations = std::to_array<Op>({
#define INT(OP, RESULT) Op::OP,
#include "core/insns/integer.def"
#define FLOAT(OP, SOFT, RESULT) Op::OP,
#define FUSED(OP, SOFT, FACTOR, ADDEND) Op::OP,
#define COMPARE(OP, CONDITION, QUIET_IS_INVALID) Op::OP,
#define MINMAX(OP, IS_MIN) Op::OP,
#define TOINT(OP, SIGNED, SOFT) Op::OP,
#define FROMINT(OP, SIGNED, SOFT) Op::OP,
#include "core/insns/float.def"
});

/// What reads or writes memory.
inline constexpr auto Accesses = std::to_array<Op>({
#define LOAD(OP, T) Op::OP,
#define STORE(OP, T) Op::OP,
#define AMO(OP, KIND) Op::OP,
#include "core/insns/memory.def"
});

/// \p First and \p Others behind them.
template <size_t N, size_t M>
constexpr std::array<Op, N + M> joined(const std::array<Op, N> &First,
                                       const std::array<Op, M> &Others) {
  std::array<Op, N + M> All{};
  std::copy(Others.begin(), Others.end(),
            std::copy(First.begin(), First.end(), All.begin()));
  return All;
}

} // namespace vorion::isasim::testing
