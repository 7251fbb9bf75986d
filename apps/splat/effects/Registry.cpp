#include "effects/Registry.h"

#include "splat/LaneUnits.h"

#include <algorithm>
#include <array>
#include <vector>

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

static std::vector<Parameter> makeParameters() {
  std::vector<Parameter> List{
      Parameter{"TILE_SIZE", "side of a tile, px"},
      Parameter{"TILE_HEIGHT", "the same, of training's tiles upright"},
      Parameter{"KEEP_COUNTS", "--deal last-frame: tiles keep their counts"},
      Parameter{"KEEP_LAST", "training: pixels keep their last contributor"},
      Parameter{"KEEP_PLACES", "training: and where each's pairs begin"},
      Parameter{"SCENE_IN_BLOCKS", "parameters as drawing has them (layout.h)"},
      Parameter{"SH_DEGREE", "the way back: bands that have gradients"},
      Parameter{"ANTIALIASED", "the way back through the compensation"},
      Parameter{"CLAMP_STOPS", "the way back, gsplat: none through 0.99"},
      Parameter{"LIMIT_FOLLOWS_DEPTH", "the way back, gsplat: of the limits"},
      Parameter{"STORED_PARAMETERS", "the way back ends before activation"},
      Parameter{"ABSOLUTE_SUMS", "the way back: sums of absolute gradients"},
      Parameter{"RECORD_SPACE", "the way back: memory of its Gaussians"},
      Parameter{"WARP_SUMS", "the way back by atomics: a warp's pixels first"},
      Parameter{"POSES", "the way back to the camera's pose, too"},
      Parameter{"GROUP", "work-items that draw a tile of the cores' path"},
      Parameter{"MOMENTS_BY_PLANE",
                "the optimiser: its moments are on the host"},
      Parameter{"TILE_ROWS", "the loss: rows of a group's tile"},
      Parameter{"RAY_WINDOW",
                "order ray: Gaussians that a pixel finds at once"},
      Parameter{"DILATION", "added to the covariance's diagonal, px^2"},
      Parameter{"KEEP_DEPTH", "the rules' test of a depth"},
      Parameter{"ANTIALIAS_FLOOR", "least ratio of determinants"},
      Parameter{"ALPHA_CUTOFF", "alpha that is blended, in 255ths"},
      Parameter{"MIN_POWER", "exponent below which no opacity is visible"},
      Parameter{"STOP_AT_EQUAL", "the rules' stop is T' <= cut-off, not <"},
      Parameter{"SUPPORT_EXACT", "support: every pixel with alpha >= 1/255"},
      Parameter{"SUPPORT_BOX3", "support: the box of 3 sigma an axis"},
      Parameter{"SUPPORT_SQUARE3", "support: INRIA's radius as a square"},
      Parameter{"SUPPORT_OFFICIAL16", "support: the square's 16x16 tiles"},
  };
  for (const std::string_view Macro : ExpMacros)
    List.push_back({Macro, "exponential unit of the cores' path"});
  return List;
}

std::span<const Parameter> parameters() {
  static const std::vector<Parameter> List = makeParameters();
  return List;
}

} // namespace effects
} // namespace vorion::splat
