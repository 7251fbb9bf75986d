/// From a loss's gradients by the pixels of a frame to those by its Gaussians,
/// on the device.
#pragma once

#include "picture/Layout.h"
#include "render/DepthTargets.h"
#include "render/Pipeline.h"

#include <string_view>

namespace vorion::splat {

/// How the rasterizer's gather adds up the rows of a tile.
enum class GatherOrder { Tree, Rows };

constexpr std::string_view name(GatherOrder O) {
  return O == GatherOrder::Tree ? "tree" : "rows";
}

/// How the cores' way back adds up the pixels of a Gaussian.
enum class SimtSums {
  Ordered, ///< tile by tile in a fixed order
  Atomics, ///< by atomics in memory, as INRIA's program does
  Warp     ///< the pixels of a warp first, then by atomics
};

constexpr std::string_view name(SimtSums S) {
  switch (S) {
  case SimtSums::Ordered:
    return "ordered";
  case SimtSums::Atomics:
    return "atomics";
  case SimtSums::Warp:
    return "warp";
  }
  return {};
}

/// Whose gradients are wanted: of scales and opacities as they are activated,
/// or of their logarithms and logits, as they are stored.
enum class GradientsOf { Activated, Stored };

struct BackwardOptions {
  Reciprocal Unit = Reciprocal::Exact;
  GatherOrder Order = GatherOrder::Tree;
  SimtSums Pixels = SimtSums::Ordered;
  GradientsOf Parameters = GradientsOf::Activated;
  /// Also the sums of absolute gradients by the projected mean, x and y, px, as
  /// planes of \c sums() from SUM_WORDS on. By the cores alone: the rasterizer
  /// has no such sums.
  bool AbsoluteSums = false;
  /// Whether the frames are of a plan with these effects.
  bool Windows = false, Needles = false;
  /// Runs may have depth targets.
  bool Depths = false;
  /// \c gradients() has the planes of kernels/pose.h, too.
  bool Poses = false;

  uint32_t sums() const { return SUM_WORDS + (AbsoluteSums ? 2U : 0U); }
};

/// The programs that the way back needs beside those of \c planRender.
std::vector<ProgramSpec> planBackward(int ShDegree, const RenderOptions &O,
                                      const BackwardOptions &B);

/// Builds them. An error sticks where the device has not the lanes of sums by
/// warps.
void buildBackward(Launcher &Launch, int ShDegree, const RenderOptions &O,
                   const BackwardOptions &B);

/// Takes gradients back through frames that a \c Pipeline drew with the option
/// Training. Errors stick in the launcher.
class BackwardPipeline {
public:
  /// Keeps references to all but \p B. \p ShDegree: of the Gaussians' buffers.
  BackwardPipeline(Launcher &Launch, const RenderOptions &O,
                   const BackwardOptions &B, int ShDegree)
      : Launch(Launch), Options(O), Choice(B), ShDegree(ShDegree) {}

  /// What the loss says of each pixel: dL/d(red, green, blue) of the picture
  /// over \p Background, and dL/d(alpha), 3 floats and 1.
  void setUpstream(const Frame &F, const cl::Buffer &ByRender,
                   const cl::Buffer &ByAlpha,
                   const std::array<float, 3> &Background);
  /// Back through blending and projection of the frame that \p Forward has
  /// drawn, in stages of the launcher's; through its depths, too, if there are
  /// \p Known ones.
  void run(Pipeline &Forward, const DepthTargets &Known = {});
  /// Frees the results.
  void forget() { Upstream = PairSums = Sums = Gradients = ShGradients = {}; }

  /// \name Results, planes of as many floats as there are Gaussians
  /// @{
  const cl::Buffer &sums() const { return Sums; } ///< at least SUM_WORDS planes
  const cl::Buffer &gradients() const { return Gradients; } ///< GRADIENT_PLANES
  /// Plane 3 k + c: of coefficient k of channel c.
  const cl::Buffer &shGradients() const { return ShGradients; }
  /// @}

private:
  cl::Buffer sumsOf(Pipeline &Forward, const Frame &F, const cl::Buffer &By,
                    bool AsStages);
  cl::Buffer sumsByAtomics(const Frame &F, const cl::Buffer &By);
  void blend(Pipeline &Forward, const Frame &F, const cl::Buffer &By);
  cl::Buffer reduce(const Frame &F);
  cl::Buffer depthSums(Pipeline &Forward, const DepthTargets &Known);
  void project(const Frame &F);

  Launcher &Launch;
  const RenderOptions &Options;
  BackwardOptions Choice;
  int ShDegree;
  cl::Buffer Upstream, PairSums, Sums, Gradients, ShGradients;
};

} // namespace vorion::splat
