/// The stages of a picture on the device, from Gaussians to blended pixels.
#pragma once

#include "io/Cameras.h"
#include "picture/Layout.h"
#include "render/Plan.h"
#include "render/Sorter.h"
#include "scene/Scene.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

namespace vorion::splat {

/// Work-items of a group where a kernel has no say.
inline constexpr uint32_t GroupSize = 64;

/// Whole groups with a work-item for each of \p Count things.
cl::NDRange itemsFor(uint32_t Count);

/// Why Gaussians were culled, by the enumerators of kernels/layout.h.
inline constexpr std::array<std::string_view, 5> CullReasons{
    "near", "degenerate", "faint", "outside", "non_finite"};

/// Work-items of a group that has a core for itself: a warp.
inline constexpr std::size_t Lanes = 16;

/// Gaussians in the device's memory, before activation: in training in planes,
/// else in blocks of them (kernels/layout.h).
struct GaussianBuffers {
  cl::Buffer Geometry; ///< planes of layout.h's GEOMETRY_PLANES
  cl::Buffer Sh; ///< plane 3 k + c: coefficient k, of those there, of channel c
  uint32_t Count = 0;
  cl::Buffer Bounds; ///< of blocks, with the effect \c CullBlocks
};

/// Copies \p S to the device in planes, harmonics up to \p ShDegree.
GaussianBuffers uploadGaussians(Launcher &Launch, const Scene &S, int ShDegree);
/// In blocks, the bands that \p Plan evaluates, zeros where \p S has none.
GaussianBuffers uploadGaussians(Launcher &Launch, const Scene &S,
                                const EffectPlan &Plan);

/// The buffers of one picture, in the order in which they are filled.
struct Frame {
  splat_view View{};
  GaussianBuffers Gaussians;
  cl::Buffer Camera, Records, Rectangles;
  Sorter::Pairs Depths; ///< keys of every Gaussian, as projected
  cl::Buffer Order;     ///< the Gaussians seen, by depth
  cl::Buffer Ordered;   ///< their rectangles
  cl::Buffer Sums;      ///< and tiles, a sum a work-item
  /// In training: where the pairs of the i-th of them begin, before they are
  /// sorted by tile; one more for the end.
  cl::Buffer Places;
  /// Tiles of the pairs, and the lists of all tiles. In training the values are
  /// the pairs' places before the sort, and List is what they name.
  Sorter::Pairs ByTile;
  cl::Buffer List;
  cl::Buffer Ranges; ///< of each tile in the list
  /// The records that are blended: with the effect \c Windows those of the
  /// windows (kernels/window.h), else Records.
  cl::Buffer Blended;
  /// Where rasterizers draw, tiles by length; or those of each rasterizer, as
  /// kernels/deal_last_frame.cl leaves them.
  cl::Buffer TileOrder;
  cl::Buffer Parts;    ///< what they draw: Pixels, or its depth parts
  cl::Buffer Tails;    ///< their hand-over records
  cl::Buffer Statuses; ///< of the cores that started them
  cl::Buffer Pixels;   ///< colour in front of the background, transmittance
  /// In training: entries of its list that a pixel has taken. Where the last
  /// frame deals: Gaussians and fragments that a tile has taken, which the next
  /// frame inherits.
  cl::Buffer Last;
  /// With the effect \c Windows: how they lie, and a splat_crop of each.
  splat_windows Windows{};
  cl::Buffer WindowRays;
  uint32_t WindowCount = 0;
  cl::Buffer RayFrames; ///< with the effect \c RayOrder: a splat_ray_frame each
  uint32_t Visible = 0, Pairs = 0;
  uint32_t LeastKey = 0, GreatestKey = 0; ///< of those seen
  std::array<uint64_t, CullReasons.size()> Culled{};

  /// Gaussians with their copies beyond the sides of a picture that closes;
  /// those of each kind begin at a whole line (kernels/project_copies.cl).
  uint32_t Copies = 1;
  uint32_t stride() const {
    return Copies == 1 ? Gaussians.Count
                       : LINE_WORDS * blocksOf(Gaussians.Count);
  }
  uint32_t drawn() const { return Copies * stride(); }
  /// Gaussians that a tile sees, each once; Visible counts copies too.
  uint32_t seen() const;

  uint32_t tiles() const { return View.tiles[0] * View.tiles[1]; }
  uint32_t pixels() const { return View.size[0] * View.size[1]; }
};

/// Draws pictures of one size and kind. Needs the programs of \c planRender
/// for the same options; errors stick in the launcher.
class Pipeline {
public:
  /// Keeps references to \p Launch and \p O. \p Effects: of the programs.
  Pipeline(Launcher &Launch, const RenderOptions &O, EffectPlan Effects)
      : Launch(Launch), Options(O), Plan(std::move(Effects)), Sort(Launch) {}

  /// Projects, sorts and blends \p Gaussians as \p C sees them; each step is a
  /// stage of the launcher's. Buffers of the frame before are released.
  void draw(const GaussianBuffers &Gaussians, const Camera &C);

  /// \name The same in steps, for the rasterizers' path
  /// Between startBlending() and waitForBlending() other kernels may run, of
  /// other pipelines too, but only one pipeline may be between them.
  /// @{
  void prepare(const GaussianBuffers &Gaussians, const Camera &C);
  /// Tiles by length, and what blending needs of memory.
  void prepareRasterizers();
  void startBlending();
  void waitForBlending();
  void endBlending();
  /// @}

  /// Blends the frame's lists once more, with depths for the colours of its
  /// records; of what comes back the first channel is the sum of weights times
  /// depths. Needs the effect \c Depth; the frame's own pixels stay.
  cl::Buffer drawDepths();
  /// The same with normals. Needs the effect \c Normals.
  cl::Buffer drawNormals();

  /// In training: the frame as it is with the colours of \p Records, blended.
  /// The frame itself stays.
  Frame drawBeside(const cl::Buffer &Records);

  const Frame &frame() const { return Current; }

  /// What the rasterizers are told of a picture.
  splat_blend_options blendOptions() const;
  /// Fails if a core's status among \p Statuses is not 0.
  void checkStatuses(const cl::Buffer &Statuses);

private:
  void project(const Camera &C);
  cl::Buffer cullBlocks();
  /// Whether a lens or a crop lies behind the view.
  bool hasMoreThanView() const;
  void writeCamera(const Camera &C);
  void divide(const Camera &C);
  void sortByDepth();
  void countPairs();
  void duplicate();
  void sortByTile();
  void placeInWindows();
  void blend();
  cl::Buffer blendAgain();
  uint64_t wordsOfOrder() const;
  void dealByLastFrame();
  void allocatePixels();
  cl::Buffer countsOfTiles();
  void shade();
  void prepareRays();
  cl::Buffer words(std::string_view What, uint64_t N) {
    return Launch.allocate(What, 4 * N);
  }

  Launcher &Launch;
  const RenderOptions &Options;
  EffectPlan Plan;
  Sorter Sort;
  Frame Current;
  cl::Buffer Counts;     ///< of the tiles, over all frames; see Frame::Last
  cl::Buffer LastRanges; ///< where the last frame deals: its lists
};

} // namespace vorion::splat
