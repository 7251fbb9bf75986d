/// From a scene and a camera to a picture, on the device.
#pragma once

#include "../io/Cameras.h"
#include "../io/Image.h"
#include "../io/Scene.h"
#include "Plan.h"

#include <optional>

namespace vorion::splat {

/// The sorted (tile, depth, Gaussian) triples, for comparing with a reference.
struct SortedPairs {
  std::vector<std::uint32_t> Tiles, DepthBits, Gaussians;
};

struct RenderResult {
  Image Picture;
  std::uint64_t Visible = 0; ///< Gaussians that some tile sees
  std::uint64_t Pairs = 0;   ///< (tile, Gaussian) pairs
  std::uint64_t DeviceBytes = 0;
  std::vector<StageReport> Stages;
  std::optional<SortedPairs> Sorted;
};

/// Uploads \p S and runs every stage with \p L, whose programs are built from
/// \p Plan. Only the picture, two counts and, on the raster path, a status a
/// tile come back; with \p KeepPairs the sorted pairs too.
Expected<RenderResult> render(Launcher &L, const RenderPlan &Plan,
                              const Scene &S, const Camera &C,
                              const RenderOptions &Options, bool KeepPairs);

} // namespace vorion::splat
