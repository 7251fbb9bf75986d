/// The backward pass on the device: from gradients of a loss by pixels to
/// gradients by Gaussians.
#pragma once

#include "picture/Layout.h"
#include "render/DepthTargets.h"
#include "render/Pipeline.h"

#include <string_view>

namespace vorion::splat {

/// The order in which the rasterizer's gather sums the rows of a tile.
enum class GatherOrder { Tree, Rows };

constexpr std::string_view name(GatherOrder O) {
  return O == GatherOrder::Tree ? "tree" : "rows";
}

/// How the backward pass on the cores sums the pixels of a Gaussian.
enum class SimtSums {
  Ordered, ///< tile by tile in a fixed order
  Atomics, ///< by atomics in memory, as in INRIA's program
  Warp     ///< within a warp first, then by atomics
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

/// The sums that \c BackwardPipeline::sums() has at least.
constexpr uint32_t recordSums(RendererKind Of) {
  if (Of == RendererKind::Surfel)
    return SURFEL_SUM_WORDS;
  return Of == RendererKind::Ray ? RAY_SUM_WORDS : SUM_WORDS;
}

/// The parameters of the gradients: activated scales and opacities, or the
/// stored logarithms and logits.
enum class GradientsOf { Activated, Stored };

struct BackwardOptions {
  Reciprocal Unit = Reciprocal::Exact;
  GatherOrder Order = GatherOrder::Tree;
  SimtSums Pixels = SimtSums::Ordered;
  GradientsOf Parameters = GradientsOf::Activated;
  /// Also computes the sums of absolute gradients by the projected mean, x and
  /// y, px, as planes of \c sums() from SUM_WORDS on. Only on the cores: the
  /// rasterizer has no such sums.
  bool AbsoluteSums = false;
  /// Whether the plan of the frames has these effects.
  bool Windows = false, Needles = false;
  /// Whether runs may have depth targets.
  bool Depths = false;
  /// Whether \c gradients() also has the planes of kernels/pose.h.
  bool Poses = false;

  /// What blending gives back of a Gaussian.
  uint32_t sums(RendererKind Of) const {
    return recordSums(Of) + (AbsoluteSums ? 2U : 0U);
  }
};

/// The programs of the backward pass in addition to those of \c planRender.
std::vector<ProgramSpec> planBackward(int ShDegree, const RenderOptions &O,
                                      const BackwardOptions &B);

/// Builds them. The launcher keeps an error if the device does not have the
/// number of lanes of sums by warps.
void buildBackward(Launcher &Launch, int ShDegree, const RenderOptions &O,
                   const BackwardOptions &B);

/// The backward pass through frames that a \c Pipeline rendered with the option
/// Training. The launcher keeps errors.
class BackwardPipeline {
public:
  /// Keeps references to all arguments except \p B. \p ShDegree is that of the
  /// Gaussians' buffers.
  BackwardPipeline(Launcher &Launch, const RenderOptions &O,
                   const BackwardOptions &B, int ShDegree)
      : Launch(Launch), Options(O), Choice(B), ShDegree(ShDegree) {}

  /// Sets the gradients of the loss for each pixel: dL/d(red, green, blue) of
  /// the picture over \p Background, and dL/d(alpha), 3 floats and 1. With a
  /// mesh \p Behind is that over the background, without Gaussians.
  void setUpstream(const Frame &F, const cl::Buffer &ByRender,
                   const cl::Buffer &ByAlpha,
                   const std::array<float, 3> &Background,
                   const std::optional<cl::Buffer> &Behind = std::nullopt);
  /// Backward pass through blending and projection of the frame that \p Forward
  /// rendered, as stages of the launcher; also through its depths if \p Known
  /// has targets.
  void run(Pipeline &Forward, const DepthTargets &Known = {});
  /// Frees the results.
  void forget() { Upstream = PairSums = Sums = Gradients = ShGradients = {}; }

  /// \name Results, planes of as many floats as there are Gaussians
  /// @{
  const cl::Buffer &sums() const { return Sums; } ///< recordSums() planes
  const cl::Buffer &gradients() const { return Gradients; } ///< GRADIENT_PLANES
  /// Plane 3 k + c: coefficient k of channel c.
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
