#include "picture/View.h"

namespace vorion::splat {

splat_view makeView(const Camera &C, const RenderOptions &Options) {
  splat_view V{};
  const auto Rotation = C.worldToCameraRotation();
  const auto Translation = C.worldToCameraTranslation();
  // What the rounding to fp32 takes away goes into the low parts.
  const auto Low = [](double Value) {
    return static_cast<float>(Value -
                              static_cast<double>(static_cast<float>(Value)));
  };
  for (std::size_t I = 0; I < 9; ++I)
    V.rotation[I] = static_cast<float>(Rotation[I]);
  for (std::size_t I = 0; I < 3; ++I) {
    V.position[I] = static_cast<float>(C.Position[I]);
    V.position_low[I] = Low(C.Position[I]);
  }
  for (std::size_t I = 0; I < 3; ++I) {
    V.depth_axis[I] = static_cast<float>(Rotation[6 + I]);
    V.depth_axis_low[I] = Low(Rotation[6 + I]);
  }
  V.depth_offset[0] = static_cast<float>(Translation[2]);
  V.depth_offset[1] = Low(Translation[2]);

  const double Focal[2] = {C.Fx, C.Fy};
  const double Center[2] = {C.Cx, C.Cy};
  const int Size[2] = {C.Width, C.Height};
  const unsigned Tile[2] = {Options.tileSize(), Options.tileHeight()};
  for (int A = 0; A < 2; ++A) {
    V.focal[A] = static_cast<float>(Focal[A]);
    V.center[A] = static_cast<float>(Center[A]);
    V.size[A] = static_cast<uint>(Size[A]);
    V.tiles[A] = (V.size[A] + Tile[A] - 1) / Tile[A];
    // Where x/z (or y/z) is clamped in the Jacobian: INRIA at 1.3 times the
    // half field of view, gsplat 0.3 times beyond each edge of the picture. In
    // fp32, as the reference in fp32 has it.
    const auto Side = static_cast<float>(Size[A]);
    const float Tangent = Side / (2 * V.focal[A]);
    if (Options.Convention == Rules::Inria) {
      V.ratio_low[A] = -1.3F * Tangent;
      V.ratio_high[A] = 1.3F * Tangent;
    } else {
      V.ratio_low[A] = -(V.center[A] / V.focal[A] + 0.3F * Tangent);
      V.ratio_high[A] = (Side - V.center[A]) / V.focal[A] + 0.3F * Tangent;
    }
  }
  return V;
}

} // namespace vorion::splat
