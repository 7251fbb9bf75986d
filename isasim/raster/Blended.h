/// Front ends whose primitives are blended (docs/primitives.md): where a
/// primitive's box is in a tile, and the exponent of its density at a pixel.
/// Included once per vector level, as Vector.h.
#pragma once

#include "raster/Datapath.h"
#include "raster/DatapathParts.h"

namespace vorion::raster {
namespace {

/// Bit i is set if \p Is says so of centre i, by the definition of the box
/// itself, so that no coordinate is ever converted to an integer. Always one
/// run of bits.
template <typename Test>
VORION_INLINE uint64_t inBox(const float *Centres, Test Is) {
  uint64_t Result = 0;
  for (unsigned B = 0; B != Blocks; ++B)
    Result |= uint64_t{bits(Is(load(Centres + B * LaneCount)))}
              << (B * LaneCount);
  return Result;
}

/// The body of the front end with number \p Primitive; one that has no body
/// does not compile.
template <uint32_t Primitive> class BlendedBody;

template <> class BlendedBody<VR_PRIMITIVE_CONIC> {
public:
  using Record = Gaussian;

  /// What is the same in all rows, for the 16 columns from First.
  struct Columns {
    unsigned First;
    Float16 Dx; ///< from the pixel to the mean
    Int16 Inside;
    Float16 AX2; ///< a * dx * dx
    Float16 BX;  ///< b * dx
  };
  /// What is the same in a row.
  struct Row {
    float Dy;  ///< from the pixel to the mean
    float CY2; ///< c * dy * dy
  };

  VORION_INLINE static CutBox box(const Gaussian &G, const float *CentreX,
                                  const float *CentreY) {
    const auto Along = [&G](unsigned Axis) {
      return [&G, Axis](Float16 Centre) {
        return __builtin_elementwise_abs(Centre - G.Mean[Axis]) <=
               G.Extent[Axis];
      };
    };
    return cutBox(inBox(CentreX, Along(0)), inBox(CentreY, Along(1)));
  }

  VORION_INLINE static Columns columns(unsigned First, const Gaussian &G,
                                       const float *CentreX) {
    const Float16 Dx = G.Mean[0] - load(CentreX + First);
    return {First, Dx, __builtin_elementwise_abs(Dx) <= G.Extent[0],
            G.Conic[0] * Dx * Dx, G.Conic[1] * Dx};
  }

  VORION_INLINE static Row row(const Gaussian &G, float CentreY) {
    const float Dy = G.Mean[1] - CentreY;
    return {Dy, G.Conic[2] * Dy * Dy};
  }

  VORION_INLINE static Float16 power(const Gaussian &, const Columns &C,
                                     const Row &R, RayFalloff) {
    return -0.5F * (C.AX2 + R.CY2) - C.BX * R.Dy;
  }

  /// \name Backward: what is summed of s = opacity exp(power) dL/dalpha
  /// @{
  static constexpr unsigned MomentCount = 5;
  VORION_INLINE static void moments(const Gaussian &, const Columns &C,
                                    const Row &R, RayFalloff, Float16 S,
                                    Float16 *To) {
    To[0] = S * -C.Dx;
    To[1] = S * -R.Dy;
    To[2] = To[0] * -C.Dx;
    To[3] = To[0] * -R.Dy;
    To[4] = To[1] * -R.Dy;
  }
  /// @}
};

/// Numbers that count pixels are exact, and so are their differences.
template <> class BlendedBody<VR_PRIMITIVE_RAY> {
protected:
  static constexpr float Degree4 = -1.0F / 18.0F;

  /// Centres of the first and the last column or row of the box.
  struct Ends {
    float First, Last;
    VORION_INLINE Int16 operator()(Float16 Centre) const {
      return (Centre >= First) & (Centre <= Last);
    }
  };
  VORION_INLINE static float centre(uint32_t Number) {
    return static_cast<float>(Number) + 0.5F;
  }
  /// Where the ray meets the Gaussian.
  struct Meeting {
    Float16 U, L;
    Float16 Far; ///< what the square of the distance is divided by
    Float16 Q;
  };

  VORION_INLINE static Ends across(const RayGaussian &G) {
    return {centre(G.First & 0xFFFF), centre(G.Last & 0xFFFF)};
  }
  VORION_INLINE static Ends down(const RayGaussian &G) {
    return {centre(G.First >> 16), centre(G.Last >> 16)};
  }

public:
  using Record = RayGaussian;

  struct Columns {
    unsigned First;
    Int16 Inside;
    Float16 Dx; ///< from the mean to the pixel
    Float16 AX; ///< a * dx
    Float16 LX; ///< 1 + the slope along columns * dx
  };
  struct Row {
    float Dy;  ///< from the mean to the pixel
    float BY;  ///< b * dy
    float V;   ///< c * dy
    float CY2; ///< (c * dy)^2
    float LY;  ///< the slope along rows * dy
  };

  VORION_INLINE static CutBox box(const RayGaussian &G, const float *CentreX,
                                  const float *CentreY) {
    return cutBox(inBox(CentreX, across(G)), inBox(CentreY, down(G)));
  }

  VORION_INLINE static Columns columns(unsigned First, const RayGaussian &G,
                                       const float *CentreX) {
    const Float16 Centre = load(CentreX + First);
    const Ends Box = across(G);
    const Float16 Dx = Centre - Box.First - G.Mean[0];
    return {First, Box(Centre), Dx, G.Factor[0] * Dx, 1.0F + G.Slope[0] * Dx};
  }

  VORION_INLINE static Row row(const RayGaussian &G, float CentreY) {
    const float Dy = CentreY - down(G).First - G.Mean[1];
    const float V = G.Factor[2] * Dy;
    return {Dy, G.Factor[1] * Dy, V, V * V, G.Slope[1] * Dy};
  }

  VORION_INLINE static Meeting meet(const RayGaussian &G, const Columns &C,
                                    const Row &R) {
    const Float16 U = C.AX + R.BY;
    const Float16 Beside = U * U + R.CY2;
    const Float16 L = C.LX + R.LY;
    const Float16 Far = L * L + G.Near * Beside;
    return {U, L, Far, Beside / Far};
  }

  VORION_INLINE static Float16 power(const RayGaussian &G, const Columns &C,
                                     const Row &R, RayFalloff Falloff) {
    const Meeting M = meet(G, C, R);
    // Where the plane is not above 0, the ray has the Gaussian behind it.
    Float16 Q = M.L > 0.0F ? M.Q : Float16(__builtin_nanf(""));
    if (Falloff.IsLowPass) {
      const Float16 Blurred = blurred(C, R);
      Q = Q <= Blurred ? Q : Blurred;
    }
    return Falloff.IsDegree4 ? Degree4 * Q * Q : -0.5F * Q;
  }

  /// \name Backward, as the conic's
  /// @{
  static constexpr unsigned MomentCount = 8;
  VORION_INLINE static void moments(const RayGaussian &G, const Columns &C,
                                    const Row &R, RayFalloff Falloff, Float16 S,
                                    Float16 *To) {
    const Meeting M = meet(G, C, R);
    const Float16 K = M.L / M.Far;
    const Float16 U = M.U * K, V = R.V * K;
    const Float16 T = Falloff.IsDegree4 ? S * M.Q : S;
    const Float16 Deep = T * M.Q;
    To[0] = T * U;
    To[1] = T * V;
    To[2] = To[0] * U;
    To[3] = To[0] * V;
    To[4] = To[1] * V;
    To[5] = To[0] * M.Q;
    To[6] = To[1] * M.Q;
    To[7] = Deep * M.Q;
  }
  /// @}

protected:
  /// The q of the low pass: on the picture, of a variance of 1/2 px^2.
  VORION_INLINE static Float16 blurred(const Columns &C, const Row &R) {
    return 2.0F * (C.Dx * C.Dx + R.Dy * R.Dy);
  }
};

/// Rays with the low pass: a pixel has either the moments of where its ray
/// meets the Gaussian, or those of the picture.
class SurfelBody : public BlendedBody<VR_PRIMITIVE_RAY> {
  using Ray = BlendedBody<VR_PRIMITIVE_RAY>;

public:
  static constexpr unsigned MomentCount = Ray::MomentCount + 2;
  VORION_INLINE static void moments(const RayGaussian &G, const Columns &C,
                                    const Row &R, RayFalloff Falloff, Float16 S,
                                    Float16 *To) {
    const Meeting M = meet(G, C, R);
    const Float16 Blurred = blurred(C, R);
    const Int16 Meets = (M.L > 0.0F) & (M.Q <= Blurred);
    Ray::moments(G, C, R, Falloff, S, To);
    for (unsigned K = 0; K != Ray::MomentCount; ++K)
      To[K] = Meets ? To[K] : Float16(0.0F);
    const Float16 T = Falloff.IsDegree4 ? S * Blurred : S;
    To[8] = Meets ? Float16(0.0F) : T * C.Dx;
    To[9] = Meets ? Float16(0.0F) : T * R.Dy;
  }
};

} // namespace
} // namespace vorion::raster
