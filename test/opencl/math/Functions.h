/// The math functions of OpenCL C, what they should give and how far off they
/// may be.
#pragma once

#include <mpfr.h>
#include <span>

namespace vorion::test {

/// How arguments are drawn.
enum class Range {
  Any,       ///< any bit pattern, and special values
  Moderate,  ///< magnitudes from 2^-30 to 2^8
  Unit,      ///< [-1, 1]
  NearOne,   ///< 1 +- 2^-8
  Positive,  ///< any positive number but the largest and the least
  AboveOne,  ///< 1 to 2^60
  SmallInts, ///< whole numbers, magnitude up to 60, not 0
};

struct MathFunction {
  const char *Name;
  /// OpenCL C, of x, y, z: numbers or vectors. WHOLE(y) is y as an int, REAL(1)
  /// a constant.
  const char *Expression;
  void (*Exact)(mpfr_ptr Result, mpfr_srcptr X, mpfr_srcptr Y, mpfr_srcptr Z);
  /// Of OpenCL C, "Relative Error as ULPs", full profile. A function that must
  /// be rounded correctly has 0.5. Infinite where there is no limit.
  double HalfLimit, SingleLimit, DoubleLimit;
  /// Of x, and of y and z.
  Range X = Range::Any, Others = Range::Any;
};

/// A function that needs more than one kind of argument stands there more than
/// once, in a row.
std::span<const MathFunction> mathFunctions();

/// Those that only floats have: half_ and native_. The limits of half and
/// double have no meaning.
std::span<const MathFunction> floatFunctions();

} // namespace vorion::test
