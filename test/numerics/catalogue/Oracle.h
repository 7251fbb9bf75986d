/// The picture of a scene in numbers of 256 bits, from what its file holds,
/// with the formulas as textbooks have them. Shares no code with the
/// reference, whose doubles it judges.
#pragma once

#include "HardCase.h"

#include <cstdint>
#include <vector>

namespace vorion::test {

/// How near the reference in fp64 is to the oracle.
struct OracleVerdict {
  double Error = 0; ///< largest, in parts of the largest colour
  /// Pixels compared; and of these left out since a decision there is closer
  /// than doubles can tell.
  uint64_t Pixels = 0, Close = 0;
  std::string Broken; ///< a Gaussian culled by one alone; empty: none
  /// Decimal digits that are right; at most 16.
  double digits() const;
};

/// Compares so many pixels of \p C under \p O that about \p Evaluations
/// (pixel, Gaussian) pairs are evaluated, at least 16 pixels. Of cameras the
/// oracle has pinholes that stand still, of rules and supports INRIA's without
/// anti-aliasing, exact, box3 and square3.
OracleVerdict compareWithOracle(const HardCase &C,
                                const splat::RenderOptions &O,
                                uint64_t Evaluations);

} // namespace vorion::test
