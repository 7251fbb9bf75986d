/// The build-time choices of kernel programs that follow from RenderOptions.
#pragma once

#include "picture/Options.h"

#include <cmath>

namespace vorion::splat {

/// The exponent below which no opacity up to 1 is visible, with a margin larger
/// than the error of any exponential unit. Rounded to six decimals, as in
/// reports.
inline float leastPower(const RenderOptions &O) {
  const double Power = std::log(O.AlphaCutoff / 255.0) - 0.06;
  return static_cast<float>(std::round(1e6 * Power) / 1e6);
}

/// Sets the choices of \p P that follow from \p O, if its program has them. \p
/// P is a structure `Program` of kernel_headers.py.
template <typename Program> void choose(Program &P, const RenderOptions &O) {
  const bool Inria = O.Convention == Rules::Inria;
  if constexpr (requires { P.TILE_SIZE; }) {
    P.TILE_SIZE = O.tileSize();
    if (O.tileHeight() != O.tileSize())
      P.TILE_HEIGHT = O.tileHeight();
  }
  if constexpr (requires { P.SUPPORT_EXACT; })
    P.SUPPORT_EXACT = O.Reach == Support::Exact;
  if constexpr (requires { P.SUPPORT_BOX3; })
    P.SUPPORT_BOX3 = O.Reach == Support::Box3;
  if constexpr (requires { P.SUPPORT_SQUARE3; })
    P.SUPPORT_SQUARE3 = O.Reach == Support::Square3;
  if constexpr (requires { P.SUPPORT_OFFICIAL16; })
    P.SUPPORT_OFFICIAL16 = O.Reach == Support::Official16;
  if constexpr (requires { P.DILATION; })
    P.DILATION = O.Dilation;
  if constexpr (requires { P.ALPHA_CUTOFF; })
    P.ALPHA_CUTOFF = static_cast<cl_float>(O.AlphaCutoff);
  if constexpr (requires { P.MIN_POWER; })
    P.MIN_POWER = leastPower(O);
  if constexpr (requires { P.NEAR_LIMIT; })
    P.NEAR_LIMIT = O.nearLimit();
  if constexpr (requires { P.NEAR_IS_LEFT_OUT; })
    P.NEAR_IS_LEFT_OUT = Inria;
  if constexpr (requires { P.SUBPIXEL_BITS; })
    if (O.SubpixelBits != MaxSubpixelBits)
      P.SUBPIXEL_BITS = O.SubpixelBits;
  if constexpr (requires { P.DEPTH_SCALE; })
    if (O.MeshDepth != DepthFormat::Fp32)
      P.DEPTH_SCALE = O.depthScale();
  if constexpr (requires { P.FILTER_BITS; })
    P.FILTER_BITS = O.FilterBits;
  if constexpr (requires { P.GROUP; })
    P.GROUP = O.SimtGroup;
  if constexpr (requires { P.RAY_WINDOW; })
    P.RAY_WINDOW = O.RayWindow;
  if constexpr (requires { P.CHECKPOINTS; })
    P.CHECKPOINTS = O.Restart == RayRestart::Checkpoint;
  if constexpr (requires { P.EXP_DEGREE; })
    if (const unsigned Degree = kernelDegree(O.Exponential); Degree != 0)
      P.EXP_DEGREE = Degree;
  if constexpr (requires { P.STOP_AT_EQUAL; })
    P.STOP_AT_EQUAL = !Inria;
  if constexpr (requires { P.CLAMP_STOPS; })
    P.CLAMP_STOPS = !Inria;
  if constexpr (requires { P.LIMIT_FOLLOWS_DEPTH; })
    P.LIMIT_FOLLOWS_DEPTH = !Inria;
  if constexpr (requires { P.ANTIALIASED; })
    P.ANTIALIASED = O.Antialiased;
  if constexpr (requires { P.KEEP_COUNTS; })
    P.KEEP_COUNTS = O.Deal == Dealing::LastFrame;
  if constexpr (requires { P.KEEP_LAST; })
    P.KEEP_LAST = O.Training;
  if constexpr (requires { P.KEEP_PLACES; })
    P.KEEP_PLACES = O.Training;
  if constexpr (requires { P.SCENE_IN_BLOCKS; })
    P.SCENE_IN_BLOCKS = !O.Training;
}

} // namespace vorion::splat
