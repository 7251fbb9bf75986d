/// From a scene and a camera to a picture, on the device.
#pragma once

#include "io/Cameras.h"
#include "io/Image.h"
#include "render/Pipeline.h"
#include "render/PixelLists.h"
#include "scene/Scene.h"

#include <array>
#include <optional>

namespace vorion::splat {

/// The sorted (tile, depth, Gaussian) triples, for comparing with a reference.
struct SortedPairs {
  std::vector<uint32_t> Tiles, DepthBits, Gaussians;
};

struct RenderResult {
  Image Picture;
  uint64_t Visible = 0; ///< Gaussians that some tile sees
  uint64_t Pairs = 0;   ///< (tile, Gaussian) pairs
  /// Gaussians that no tile sees, by \c CullReasons.
  std::array<uint64_t, CullReasons.size()> Culled{};
  /// Most bytes of buffers that were on the device at once until the picture
  /// was read; of a sequence, since its first picture.
  uint64_t DeviceBytes = 0;
  std::vector<StageReport> Stages;
  std::optional<SortedPairs> Sorted;
  std::optional<DepthMap> Depths; ///< where the effect \c Depth is on
  /// Where \c Normals is on: for colours the sums of weights times normals.
  std::optional<Image> Normals;
  std::optional<PixelLists> Lists; ///< where \c PixelLists is on
};

/// The picture of \p F in front of \p Background, and its copy for the host.
cl::Buffer resolve(Launcher &Launch, const Frame &F,
                   const std::array<float, 3> &Background);
/// \p Resolved: the fourth channel is alpha already, not the transmittance.
Image readPicture(Launcher &Launch, const Frame &F, const cl::Buffer &Picture,
                  bool Resolved = true);

/// Uploads \p S and runs every stage with \p Launch, whose programs are built
/// from
/// \p Plan. Only the picture, two counts and, on the raster path, a status a
/// tile come back; with \p KeepPairs the sorted pairs too.
Expected<RenderResult> render(Launcher &Launch, const RenderPlan &Plan,
                              const Scene &S, const Camera &C,
                              const RenderOptions &Options, bool KeepPairs);

/// \name The same in steps, for who keeps a scene on the device
/// @{
/// What can be said to be wrong with \p S before the device is asked; builds
/// the programs of \p Plan, which are a stage.
Expected<Success> build(Launcher &Launch, const RenderPlan &Plan,
                        const Scene &S);
/// Computes what no camera changes, once, in the place of what was uploaded: a
/// stage, where \p Plan has the effect \c ActivatedScene.
void activate(Launcher &Launch, const RenderPlan &Plan,
              const GaussianBuffers &Gaussians);
/// Draws \p Gaussians, which \c uploadGaussians has made of the scene by the
/// effects of \p Plan, and \c activate() has seen.
Expected<RenderResult> draw(Launcher &Launch, const RenderPlan &Plan,
                            const GaussianBuffers &Gaussians, const Camera &C,
                            const RenderOptions &Options, bool KeepPairs);
/// @}

/// Several pictures of one scene.
struct SequenceResult {
  std::vector<RenderResult> Frames;
  std::vector<StageReport> Stages;  ///< of all, in the order of time
  std::vector<std::size_t> FrameOf; ///< whose each of these is
};

/// The same for every one of \p Cameras, at least one. With \p Overlap, for the
/// rasterizers' path, the rasterizers blend a picture while the cores prepare
/// the next one (docs/rasterizer.md, "What runs at the same time"); pictures
/// are the same.
Expected<SequenceResult> renderSequence(Launcher &Launch,
                                        const RenderPlan &Plan, const Scene &S,
                                        const std::vector<Camera> &Cameras,
                                        const RenderOptions &Options,
                                        bool Overlap);

} // namespace vorion::splat
