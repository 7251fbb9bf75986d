/// From a scene and a camera to a picture, on the device.
#pragma once

#include "../io/Cameras.h"
#include "../io/Image.h"
#include "../io/Scene.h"
#include "Plan.h"

#include <array>
#include <optional>
#include <string_view>

namespace vorion::splat {

/// The sorted (tile, depth, Gaussian) triples, for comparing with a reference.
struct SortedPairs {
  std::vector<std::uint32_t> Tiles, DepthBits, Gaussians;
};

/// Why Gaussians were culled, by the enumerators of kernels/layout.h.
inline constexpr std::array<std::string_view, 5> CullReasons{
    "near", "degenerate", "faint", "outside", "non_finite"};

struct RenderResult {
  Image Picture;
  std::uint64_t Visible = 0; ///< Gaussians that some tile sees
  std::uint64_t Pairs = 0;   ///< (tile, Gaussian) pairs
  /// Gaussians that no tile sees, by \c CullReasons.
  std::array<std::uint64_t, CullReasons.size()> Culled{};
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
