#include "effects/Registry.h"

#include <algorithm>
#include <array>

namespace vorion::splat {

std::string_view name(EffectKind K) {
  switch (K) {
  case EffectKind::Scene:
    return "scene";
  case EffectKind::Machine:
    return "machine";
  case EffectKind::Observation:
    return "observation";
  }
  return {};
}

namespace effects {

std::span<const Effect *const> all() {
  static constexpr std::array List{&Sh1,
                                   &Sh2,
                                   &Sh3,
                                   &ViewColor,
                                   &Antialias,
                                   &NearPlane,
                                   &FieldOfView,
                                   &Faint,
                                   &AlphaClamp,
                                   &Background,
                                   &OpenCvLens,
                                   &FisheyeLens,
                                   &OrthographicLens,
                                   &EquirectangularLens,
                                   &Unscented,
                                   &RollingShutter,
                                   &Needles,
                                   &Crop,
                                   &Windows,
                                   &RayOrder,
                                   &IntersectTags,
                                   &ActivatedScene,
                                   &CullBlocks,
                                   &ZTiles,
                                   &PixelUnit,
                                   &SkipSaturated,
                                   &Clock,
                                   &Numerics,
                                   &Checkers,
                                   &Traces,
                                   &Debugger,
                                   &SortedPairs,
                                   &Depth,
                                   &Normals,
                                   &PixelLists};
  return List;
}

const Effect *find(std::string_view Name) {
  const auto At = std::ranges::find(all(), Name, &Effect::Name);
  return At == all().end() ? nullptr : *At;
}

const Effect *lensOf(LensModel M) {
  switch (M) {
  case LensModel::Pinhole:
    break;
  case LensModel::OpenCv:
    return &OpenCvLens;
  case LensModel::Fisheye:
    return &FisheyeLens;
  case LensModel::Orthographic:
    return &OrthographicLens;
  case LensModel::Equirectangular:
    return &EquirectangularLens;
  }
  return nullptr;
}

} // namespace effects
} // namespace vorion::splat
