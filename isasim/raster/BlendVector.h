/// The blend arithmetics, 16 lanes at a time (docs/abi.md, "Rasterizer").
/// Included once per vector level, as Vector.h.
#pragma once

#include "raster/RasterTables.h"
#include "raster/Vector.h"

namespace vorion::raster {
namespace {

/// What a pixel's transmittance becomes, and what a colour is weighted with.
struct BlendStep {
  Float16 NextT, Weight;
};

/// The arithmetic of number \p Number; one that has no body does not compile.
template <uint32_t Number> struct BlendBody;

template <> struct BlendBody<VR_BLEND_FP32> {
  VORION_INLINE static Float16 operand(Float16 X) { return X; }
  VORION_INLINE static BlendStep step(Float16 Alpha, Float16 T) {
    return {T * (1.0F - Alpha), Alpha * T};
  }
};

/// Nearest number of \p KeptBits significand bits with fp32's exponents, ties
/// to even; what rounds beyond the largest becomes infinite.
template <int KeptBits> VORION_INLINE Float16 roundSignificand(Float16 X) {
  constexpr int Dropped = 24 - KeptBits;
  const Int16 Bits = __builtin_bit_cast(Int16, X);
  // A carry out of the significand is what the exponent needs.
  const Int16 Rounded =
      Bits + ((1 << (Dropped - 1)) - 1) + (Bits >> Dropped & 1);
  return __builtin_bit_cast(Float16, Rounded & ~((1 << Dropped) - 1));
}

struct Bf16 {
  VORION_INLINE static Float16 round(Float16 X) {
    return roundSignificand<8>(X);
  }
};

/// IEEE binary16 with subnormal numbers; what is larger than its largest number
/// becomes that.
struct Fp16 {
  VORION_INLINE static Float16 round(Float16 X) {
    constexpr float SmallestNormal = 0x1p-14F;
    constexpr float Largest = 65504.0F;
    // Adding it leaves a multiple of 2^-24, the step of subnormal numbers.
    constexpr float ToSubnormal = 0.75F;
    const Float16 Size = __builtin_elementwise_abs(X);
    const Float16 Normal = roundSignificand<11>(Size);
    Float16 Rounded =
        Size < SmallestNormal ? (Size + ToSubnormal) - ToSubnormal : Normal;
    Rounded = Rounded < Largest ? Rounded : Float16(Largest);
    const auto SignBit = Int16(static_cast<int32_t>(0x80000000U));
    return __builtin_bit_cast(Float16,
                              __builtin_bit_cast(Int16, Rounded) |
                                  (__builtin_bit_cast(Int16, X) & SignBit));
  }
};

/// Operands are rounded to \p Format; products are then exact in fp32, and sums
/// are fp32's. Taking from T what the pixel gets loses less than 1 - alpha in
/// \p Format would, which has no digits for a small alpha.
template <typename Format> struct NarrowBlend {
  VORION_INLINE static Float16 operand(Float16 X) { return Format::round(X); }
  VORION_INLINE static BlendStep step(Float16 Alpha, Float16 T) {
    const Float16 Taken = Format::round(Alpha) * Format::round(T);
    return {T - Taken, Format::round(Taken)};
  }
};

template <> struct BlendBody<VR_BLEND_BF16> : NarrowBlend<Bf16> {};
template <> struct BlendBody<VR_BLEND_FP16> : NarrowBlend<Fp16> {};

} // namespace
} // namespace vorion::raster
