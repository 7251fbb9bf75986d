/// Renders a scene on the device.
#pragma once

#include "io/Cameras.h"
#include "io/Image.h"
#include "render/Pipeline.h"
#include "render/PixelLists.h"
#include "scene/Scene.h"

#include <array>
#include <optional>

namespace vorion::splat {

/// The sorted (tile, depth, Gaussian) triples, for comparison with a reference.
struct SortedPairs {
  std::vector<uint32_t> Tiles, DepthBits, Gaussians;
};

struct RenderResult {
  Image Picture;
  uint64_t Visible = 0; ///< Gaussians that overlap a tile
  uint64_t Pairs = 0;   ///< (tile, Gaussian) pairs
  /// Gaussians that overlap no tile, by \c CullReasons.
  std::array<uint64_t, CullReasons.size()> Culled{};
  /// Peak size of the buffers on the device until the picture was read; for a
  /// sequence, since its first picture.
  uint64_t DeviceBytes = 0;
  std::vector<StageReport> Stages;
  std::optional<SortedPairs> Sorted;
  std::optional<DepthMap> Depths; ///< with the effect \c Depth
  /// With the effect \c Normals: sums of weights times normals, as colours.
  std::optional<Image> Normals;
  std::optional<PixelLists> Lists;      ///< with the effect \c PixelLists
  std::optional<RayWork> Rays;          ///< with \c RendererKind::Trace
  std::optional<VisibleMesh> MeshShown; ///< with RenderOptions::KeepVisible
};

/// The picture of \p F over \p Background, for the host.
cl::Buffer resolve(Launcher &Launch, const Frame &F,
                   const std::array<float, 3> &Background);
/// The same over the mesh of the effect \c Mesh, where there is one.
cl::Buffer resolveMesh(Launcher &Launch, const Frame &F,
                       const RenderOptions &Options);
/// The mesh in the pixels of \p F, which was drawn with \p Options.
VisibleMesh readVisible(Launcher &Launch, const Frame &F,
                        const RenderOptions &Options);
/// \p Resolved: the fourth channel is alpha, not transmittance.
Image readPicture(Launcher &Launch, const Frame &F, const cl::Buffer &Picture,
                  bool Resolved = true);

/// Of the rays of \p F.
RayWork readRayWork(Launcher &Launch, const Frame &F);

/// Uploads \p S and runs all stages with \p Launch, whose programs are built
/// from \p Plan. Reads back only the picture, two counts and, on the path
/// `raster`, a status per tile; with \p KeepPairs also the sorted pairs.
Expected<RenderResult> render(Launcher &Launch, const RenderPlan &Plan,
                              SceneSource S, const Camera &C,
                              const RenderOptions &Options, bool KeepPairs);

/// \name The same in steps, for a scene that stays on the device
/// @{
/// Checks \p S without the device, and builds the programs of \p Plan in a
/// stage.
Expected<Success> build(Launcher &Launch, const RenderPlan &Plan,
                        const Scene &S);
/// If \p Plan has the effect \c ActivatedScene: computes, in place and in a
/// stage, what does not depend on the camera.
void activate(Launcher &Launch, const RenderPlan &Plan,
              const GaussianBuffers &Gaussians);
/// Renders \p Gaussians, the result of \c uploadGaussians with the effects of
/// \p Plan and of \c activate().
Expected<RenderResult> draw(Launcher &Launch, const RenderPlan &Plan,
                            const GaussianBuffers &Gaussians, const Camera &C,
                            const RenderOptions &Options, bool KeepPairs);
/// @}

/// Several pictures of one scene.
struct SequenceResult {
  std::vector<RenderResult> Frames;
  std::vector<StageReport> Stages;  ///< of all pictures, in order of time
  std::vector<std::size_t> FrameOf; ///< the picture of each stage
};

/// The same for at least one of \p Cameras. With \p Overlap, on the path
/// `raster`, the rasterizers blend a picture while the cores prepare the next
/// one (docs/rasterizer.md, "What runs at the same time"); pictures do not
/// change.
Expected<SequenceResult> renderSequence(Launcher &Launch,
                                        const RenderPlan &Plan, SceneSource S,
                                        const std::vector<Camera> &Cameras,
                                        const RenderOptions &Options,
                                        bool Overlap);

} // namespace vorion::splat
