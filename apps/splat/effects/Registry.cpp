#include "effects/Registry.h"

#include <algorithm>
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

static std::vector<const Effect *> makeList() {
  std::vector List{&Sh1,       &Sh2,         &Sh3,   &ViewColor,  &Antialias,
                   &NearPlane, &FieldOfView, &Faint, &AlphaClamp, &Background};
  for (const Effect &Lens : ofLenses())
    List.push_back(&Lens);
  for (const Effect *E :
       {&Unscented,   &RollingShutter, &Needles,        &Crop,
        &Windows,     &Rays,           &Degree4,        &Surfels,
        &RayOrder,    &Mesh,           &Texture,        &Light,
        &Layers,      &IntersectTags,  &ActivatedScene, &CullBlocks,
        &ZTiles,      &PixelUnit,      &SkipSaturated,  &Clock,
        &Numerics,    &Checkers,       &Traces,         &Debugger,
        &SortedPairs, &Depth,          &Normals,        &PixelLists})
    List.push_back(E);
  return List;
}

std::span<const Effect *const> all() {
  static const std::vector<const Effect *> List = makeList();
  return List;
}

const Effect *find(std::string_view Name) {
  const auto At = std::ranges::find(all(), Name, &Effect::Name);
  return At == all().end() ? nullptr : *At;
}

} // namespace effects
} // namespace vorion::splat
