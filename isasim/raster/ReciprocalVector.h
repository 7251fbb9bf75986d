/// The units for 1 / (1 - alpha), 16 lanes at a time. What they are and cost:
/// Reciprocals.h and docs/lane-units.md#reciprocal-units. Included once per
/// vector level, as Vector.h.
#pragma once

#include "raster/Reciprocals.h"
#include "raster/UnitTables.h"
#include "raster/Vector.h"

namespace vorion::raster {
namespace {

/// \p Steps Newton-Raphson steps towards 1 / \p D.
template <unsigned Steps>
VORION_INLINE Float16 newtonRaphson(Float16 D, Float16 Y) {
#pragma clang loop unroll(full)
  for (unsigned I = 0; I != Steps; ++I)
    Y = Y * (2.0F - D * Y);
  return Y;
}

VORION_INLINE Float16 seedsAt(const float *Seeds, Int16 Index) {
  Float16 Y;
  for (unsigned L = 0; L != LaneCount; ++L)
    Y[L] = Seeds[Index[L]];
  return Y;
}

VORION_INLINE Float16 paperReciprocal(const reciprocal_tables::Spaced &Table,
                                      Float16 Alpha, Float16 D) {
  Float16 Taylor = Alpha + 1.0F;
  Taylor = Taylor * Alpha + 1.0F;
  Taylor = Taylor * Alpha + 1.0F;
  Taylor = Taylor * Alpha + 1.0F;
  // Seven comparators; a true comparison is -1.
  Int16 Index = 0;
  for (const float Threshold : Table.Thresholds)
    Index -= D < Threshold;
  const Float16 Iterated = newtonRaphson<2>(D, seedsAt(Table.Seeds, Index));
  return Alpha < 0.5F ? Taylor : Iterated;
}

/// The seed for 1 / D, D in [2^-126, 2).
VORION_INLINE Float16 mantissaSeed(Float16 D) {
  const Int16 Bits = __builtin_bit_cast(Int16, D);
  const Int16 Index = Bits >> 20 & (reciprocal_tables::Entries - 1);
  const Int16 Exponent = (Bits >> 23) - 127;
  const Float16 Seed = seedsAt(reciprocal_tables::OfMantissa.Seeds, Index);
  return __builtin_bit_cast(Float16,
                            __builtin_bit_cast(Int16, Seed) - (Exponent << 23));
}

/// 1 / (1 - \p Alpha) for alpha in [1/255, 0.99]; other lanes get any number.
VORION_INLINE Float16 reciprocal(Reciprocal Unit, Float16 Alpha) {
  const Float16 D = 1.0F - Alpha;
  switch (Unit) {
  case Reciprocal::Exact:
    break;
  case Reciprocal::EvenLeft:
    return paperReciprocal(reciprocal_tables::EvenLeft, Alpha, D);
  case Reciprocal::EvenBest:
    return paperReciprocal(reciprocal_tables::EvenBest, Alpha, D);
  case Reciprocal::LogLeft:
    return paperReciprocal(reciprocal_tables::LogLeft, Alpha, D);
  case Reciprocal::LogBest:
    return paperReciprocal(reciprocal_tables::LogBest, Alpha, D);
  case Reciprocal::Mantissa2:
    return newtonRaphson<2>(D, mantissaSeed(D));
  case Reciprocal::Mantissa3:
    return newtonRaphson<3>(D, mantissaSeed(D));
  }
  return 1.0F / D;
}

} // namespace
} // namespace vorion::raster
