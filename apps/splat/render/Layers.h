/// Additional outputs of a picture: depths, normals, opacity, and the Gaussians
/// of each pixel (docs/judging.md, "Outputs beside the picture").
#pragma once

#include "render/Renderer.h"
#include "vorion/support/Outputs.h"

#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// The definition of a pixel's depth.
enum class DepthAs {
  Accumulated, ///< the sum of weights times depths
  Expected,    ///< the same divided by the sum of weights
  Median       ///< where the transmittance falls to a half
};

constexpr std::string_view name(DepthAs D) {
  return D == DepthAs::Accumulated ? "accumulated"
         : D == DepthAs::Expected  ? "expected"
                                   : "median";
}

inline constexpr unsigned MaxTop = 64;

/// The requested files; empty names are not requested.
struct LayerFiles {
  std::string Depth, Normals, Opacity, Contributors;
  DepthAs As = DepthAs::Accumulated;
  unsigned Top = 8; ///< contributors per pixel, 1 to MaxTop

  /// The files with the names of their options.
  std::vector<NamedFile> named() const;
  bool any() const {
    return !Depth.empty() || !Normals.empty() || !Opacity.empty() ||
           !Contributors.empty();
  }
  /// \name What they need from the device
  /// @{
  bool needDepths() const { return !Depth.empty() && As != DepthAs::Median; }
  bool needNormals() const { return !Normals.empty(); }
  bool needLists() const {
    return !Contributors.empty() || (!Depth.empty() && As == DepthAs::Median);
  }
  /// @}
};

/// The depths of \p R, rendered with \p O and the outputs that \p As needs.
DepthMap depthsOf(const RenderResult &R, const RenderOptions &O, DepthAs As);

/// Writes the files for \p R, rendered with \p O and all outputs that they
/// need.
Expected<Success> writeLayers(const LayerFiles &F, const RenderResult &R,
                              const RenderOptions &O);

} // namespace vorion::splat
