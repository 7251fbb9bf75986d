/// The cores' instructions on other operands than they have: in double, and on
/// integers as the shadow would have them. From the same lists that the cores
/// are made of (core/insns/*.def).
#pragma once

#include "core/HostFp.h"
#include "core/Isa.h"
#include "core/State.h"

#include <bit>
#include <cmath>

namespace vorion::isasim {

using LaneDoubles = double __attribute__((vector_size(8 * MaxLanes)));
using LaneFloats = float __attribute__((vector_size(4 * MaxLanes)));

/// What an instruction is to the sanitizer.
enum class NumericKind : uint8_t {
  Other, ///< its result is no float's
  Float, ///< rounds
  Sign,
  MinMax,
  Compare,
  ToInt,
  FromInt,
  MoveBits, ///< between the files
  Integer,
  Shuffle,
  Load,
  Store,
  Atomic,
  Decide, ///< branches, splits, predicates and votes
};
NumericKind numericKind(Op O);

/// Operands by lane; an instruction uses those that it has.
struct DoubleOperands {
  LaneDoubles A, B, C;
};
/// A rounded operation \p O in double. \p Largest: of a sum, its larger
/// operand's magnitude, else 0.
void floatInDouble(Op O, const DoubleOperands &In, LaneDoubles &Result,
                   LaneDoubles &Largest);
/// Lanes in which comparison \p O holds.
uint32_t compareInDouble(Op O, const LaneDoubles &A, const LaneDoubles &B);
/// Integer operation \p O.
void integerResult(Op O, const LaneWords &A, const LaneWords &B, LaneWords &R);
/// Lanes in which branch \p O, or a split, predicate or vote on \p A, is true.
uint32_t decidedLanes(Op O, const LaneWords &A, const LaneWords &B);
/// Which lane a shuffle gives lane \p Lane, if it is active.
unsigned shuffleSource(Op O, unsigned Lane, uint32_t Control);
/// fcvt.w.s and fcvt.wu.s of a double, \p Rm 0 to 4.
uint32_t doubleToInt(double V, bool Signed, unsigned Rm);

inline constexpr uint32_t SignBit = 0x80000000U, InfinityBits = 0x7F800000U;
inline bool isFinite(uint32_t Word) {
  return (Word & InfinityBits) != InfinityBits;
}

/// The place of a register in the lists of a warp: x1 to x31, f0 to f31, or -1.
inline int shadowPlace(File F, unsigned Number) {
  return F == File::X && Number != 0 ? static_cast<int>(XBase + Number)
         : F == File::F              ? static_cast<int>(FBase + Number)
                                     : -1;
}

/// Calls F(lane) for the lanes of \p Mask, ascending.
template <typename Function> void forLanes(uint32_t Mask, Function F) {
  for (; Mask; Mask &= Mask - 1)
    F(static_cast<unsigned>(std::countr_zero(Mask)));
}

/// \p From in the lanes whose words are all ones.
template <typename T>
void mergeLanes(T &To, const T &From, const LaneWords &Lanes) {
  if constexpr (sizeof(T) == sizeof(LaneWords)) {
    To = (T)(((LaneWords)From & Lanes) | ((LaneWords)To & ~Lanes));
  } else {
    for (unsigned L = 0; L != MaxLanes; ++L)
      To[L] = Lanes[L] ? From[L] : To[L];
  }
}

/// Rounds to nearest whatever the guest's mode, and leaves its flags alone.
class OwnRounding {
public:
  OwnRounding() { HostFp::enter(0); }

private:
  HostFp Guest;
};

void toDouble(const LaneWords &FloatBits, LaneDoubles &To);
/// All ones in the lanes of \p Mask.
LaneWords wordsOf(uint32_t Mask);

/// Of \p Is from what it should be, at most 1: no digit is right.
inline double relativeError(double Is, double Should) {
  const double Off = std::fabs(Is - Should);
  if (Off == 0)
    return 0;
  const double Error = Off / std::fabs(Should);
  return Error < 1 ? Error : 1; // NaN too
}
/// The same by lane.
void relativeErrors(const LaneDoubles &Is, const LaneDoubles &Should,
                    LaneDoubles &Error);

} // namespace vorion::isasim
