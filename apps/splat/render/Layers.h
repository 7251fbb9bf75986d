/// What a picture has beside its colours: depths, normals, opacity, and the
/// Gaussians of each pixel (docs/judging.md, "Outputs beside the picture").
#pragma once

#include "render/Renderer.h"
#include "vorion/support/Outputs.h"

#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// What stands for a pixel's many depths.
enum class DepthAs {
  Accumulated, ///< the sum of weights times depths
  Expected,    ///< that over the sum of weights
  Median       ///< where half of the light is left
};

constexpr std::string_view name(DepthAs D) {
  return D == DepthAs::Accumulated ? "accumulated"
         : D == DepthAs::Expected  ? "expected"
                                   : "median";
}

inline constexpr unsigned MaxTop = 64;

/// The files that are wanted; empty ones are not.
struct LayerFiles {
  std::string Depth, Normals, Opacity, Contributors;
  DepthAs As = DepthAs::Accumulated;
  unsigned Top = 8; ///< contributors that are kept of a pixel, 1 to MaxTop

  /// As their options name them.
  std::vector<NamedFile> named() const;
  bool any() const {
    return !Depth.empty() || !Normals.empty() || !Opacity.empty() ||
           !Contributors.empty();
  }
  /// \name What the device is to do for them
  /// @{
  bool needDepths() const { return !Depth.empty() && As != DepthAs::Median; }
  bool needNormals() const { return !Normals.empty(); }
  bool needLists() const {
    return !Contributors.empty() || (!Depth.empty() && As == DepthAs::Median);
  }
  /// @}
};

/// The depths of \p R, which \p O drew with what \p As needs.
DepthMap depthsOf(const RenderResult &R, const RenderOptions &O, DepthAs As);

/// Writes them of \p R, which \p O drew with all that they need.
Expected<Success> writeLayers(const LayerFiles &F, const RenderResult &R,
                              const RenderOptions &O);

} // namespace vorion::splat
