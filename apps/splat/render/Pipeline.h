/// The stages of a picture on the device, from Gaussians to blended pixels.
#pragma once

#include "device/Launcher.h"
#include "io/LocalFrame.h"
#include "mesh/Mesh.h"
#include "picture/Layout.h"
#include "render/Plan.h"
#include "render/Sorter.h"
#include "render/TileDivision.h"
#include "scene/Scene.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion::splat {

/// Default number of work-items of a group.
inline constexpr uint32_t GroupSize = 64;

/// A range of complete groups with at least \p Count work-items.
cl::NDRange itemsFor(uint32_t Count);

/// Reasons for culling Gaussians, in the order of the enumerators of
/// kernels/layout.h.
inline constexpr std::array<std::string_view, 5> CullReasons{
    "near", "degenerate", "faint", "outside", "non_finite"};

/// Work-items of a group that occupies a core: those of a warp.
inline constexpr std::size_t Lanes = 16;

/// A mesh in device memory.
struct MeshBuffers {
  cl::Buffer Positions, Colors, Corners; ///< as in Mesh
  /// With the effect \c Texture: as in Mesh; a splat_material each; the texels
  /// of all textures; and the 256 values of a channel in linear light.
  std::optional<cl::Buffer> TextureCoordinates, MaterialOf, Materials, Texels,
      Linear;
  std::optional<cl::Buffer> Normals; ///< with the effect \c Light, and
                                     ///< for \c RendererKind::Trace
  uint32_t Vertices = 0, Triangles = 0;
};

/// Copies what the effects of \p Plan need of \p M.
MeshBuffers uploadMesh(Launcher &Launch, const Mesh &M, const EffectPlan &Plan,
                       RendererKind Kind = RendererKind::Splat);

/// What a mesh leaves of a picture before Gaussians are blended.
struct MeshFrame {
  cl::Buffer Points;  ///< of its vertices in the camera's axes
  cl::Buffer Visible; ///< a vx_visibility a pixel (docs/primitives.md)
  /// Entries of the tile's list in front of it, by pixel. With the effect \c
  /// Layers a plane for each range between layers.
  cl::Buffer Limits;
  /// With the effect \c Layers: numbers of layers by pixel, a plane of
  /// vx_visibility for each, and the largest numbers of tiles.
  cl::Buffer LayerCounts, Layers, TileLayers;
  uint32_t MostLayers = 0; ///< of a pixel
};

/// The mesh in each pixel, rows from the top.
struct VisibleMesh {
  int Width = 0, Height = 0;
  std::vector<float> Depth;       ///< along the camera's axis; infinite: none
  std::vector<int32_t> Triangles; ///< of the mesh; -1: none
  /// The same of transparent ones in front of it, a plane for each, the nearest
  /// first.
  std::vector<float> LayerDepths;
  std::vector<int32_t> LayerTriangles;
};

/// Gaussians in device memory, before activation: in planes for training,
/// otherwise in blocks of planes (kernels/layout.h).
struct GaussianBuffers {
  cl::Buffer Geometry; ///< planes of layout.h's GEOMETRY_PLANES
  cl::Buffer Sh;       ///< plane 3 k + c: k-th stored coefficient of channel c
  uint32_t Count = 0;
  cl::Buffer Bounds;   ///< bounds of blocks, with the effect \c CullBlocks
  MeshBuffers Surface; ///< with the effect \c Mesh
  WorldPoint Origin{}; ///< of the means (Scene.h); cameras are in the caller's
                       ///< frame
};

/// A scene to be copied to the device.
class SceneSource {
public:
  // NOLINTBEGIN(google-explicit-constructor): calls pass scenes
  SceneSource(const Scene &Kept) : S(Kept) {}
  /// The copy takes the place of \p Given: the host's memory of its parameters
  /// is released as they are copied, and what is left has no Gaussians.
  SceneSource(Scene &&Given) : S(Given), Own(&Given) {}
  // NOLINTEND(google-explicit-constructor)

  const Scene &scene() const { return S; }
  /// Null if it is kept.
  Scene *given() const { return Own; }

private:
  const Scene &S;
  Scene *Own = nullptr;
};

/// Copies \p S to the device in planes, with harmonics up to \p ShDegree.
GaussianBuffers uploadGaussians(Launcher &Launch, const Scene &S, int ShDegree);
/// Copies \p S in blocks, with the bands that \p Plan evaluates, zero-filled if
/// \p S lacks them.
GaussianBuffers uploadGaussians(Launcher &Launch, SceneSource From,
                                const EffectPlan &Plan);

/// What traced rays take of a picture (kernels/layout.h).
struct TraceFrame {
  cl::Buffer Shapes;  ///< a splat_traced each
  cl::Buffer Boxes;   ///< of Gaussians, BOX_WORDS each
  cl::Buffer Colors;  ///< seen from the camera
  float Distance = 0; ///< the mean of a coordinate, from the camera
  splat_tree Tree{};
  cl::Buffer Nodes;  ///< their boxes
  cl::Buffer Leaves; ///< of each Gaussian
  cl::Buffer Rays;   ///< RAY_PLANES of those of all pixels
  cl::Buffer Work;   ///< a splat_ray_work for each ray
};

/// The buffers of one picture, in the order in which they are filled.
struct Frame {
  splat_view View{};
  GaussianBuffers Gaussians;
  cl::Buffer Camera, Records, Rectangles;
  Sorter::Pairs Depths; ///< keys of all Gaussians after projection
  cl::Buffer Order;     ///< visible Gaussians by depth
  cl::Buffer Ordered;   ///< their rectangles
  cl::Buffer Sums;      ///< and sums of tiles, one per work-item
  /// In training: the start of the pairs of the i-th visible Gaussian, before
  /// they are sorted by tile; and the end.
  cl::Buffer Places;
  /// Tiles of the pairs, and the lists of all tiles. In training the values are
  /// the positions of pairs before the sort, and List has the Gaussians.
  Sorter::Pairs ByTile;
  cl::Buffer List;
  cl::Buffer Ranges; ///< of each tile in the list
  /// The blended records: those of the windows (kernels/window.h) with the
  /// effect \c Windows, otherwise Records.
  cl::Buffer Blended;
  /// For rasterizers: tiles sorted by length, or the tiles of each rasterizer
  /// from kernels/deal_last_frame.cl.
  cl::Buffer TileOrder;
  cl::Buffer Parts;    ///< their output: Pixels, or its depth segments
  cl::Buffer Tails;    ///< their hand-over records
  cl::Buffer Statuses; ///< of the cores that started them
  cl::Buffer Pixels;   ///< colour without background, transmittance
  /// In training: entries of the list that a pixel has processed. If tiles are
  /// distributed by the last frame: Gaussians and fragments of each tile, for
  /// the next frame.
  cl::Buffer Last;
  /// With the effect \c Windows: their layout, and a splat_crop for each.
  splat_windows Windows{};
  cl::Buffer WindowRays;
  uint32_t WindowCount = 0;
  MeshFrame Surface;    ///< with the effect \c Mesh
  cl::Buffer RayFrames; ///< with the effect \c RayOrder: a splat_ray_frame for
                        ///< each Gaussian
  TraceFrame Traced;    ///< with \c RendererKind::Trace
  uint32_t Visible = 0, Pairs = 0;
  uint32_t LeastKey = 0, GreatestKey = 0; ///< of visible Gaussians
  std::array<uint64_t, CullReasons.size()> Culled{};

  /// Copies of each Gaussian: 3 for a full sphere, for the positions beyond its
  /// left and right edge. Each set of copies is aligned to a line
  /// (kernels/project_copies.cl).
  uint32_t Copies = 1;
  uint32_t stride() const {
    return Copies == 1 ? Gaussians.Count
                       : LINE_WORDS * blocksOf(Gaussians.Count);
  }
  uint32_t drawn() const { return Copies * stride(); }
  /// Visible Gaussians, each counted once; Visible also counts copies.
  uint32_t seen() const;

  uint32_t tiles() const { return View.tiles[0] * View.tiles[1]; }
  uint32_t pixels() const { return View.size[0] * View.size[1]; }
};

/// What the rays of a picture took.
struct RayWork {
  uint64_t Rays = 0;
  uint64_t Nodes = 0;       ///< boxes that were tested
  uint64_t Evaluated = 0;   ///< Gaussians whose boxes they meet
  uint64_t Blended = 0;     ///< Gaussians
  uint64_t Restarts = 0;    ///< passes beyond the first
  uint32_t MostBlended = 0; ///< by a ray
};

/// Renders pictures of one size and kind. Needs the programs of \c planRender
/// for the same options. The launcher keeps errors.
class Pipeline {
public:
  /// Keeps references to \p Launch and \p O. \p Effects is the plan of the
  /// programs.
  Pipeline(Launcher &Launch, const RenderOptions &O, EffectPlan Effects)
      : Launch(Launch), Options(O), Plan(std::move(Effects)), Sort(Launch) {}

  /// Divides subsequent pictures by \p By, which must outlive them; null: not.
  void divide(TileDivision *By) { Division = By; }
  /// Null if the frame is not divided.
  TileDivision *division() const { return Division; }

  /// Projects, sorts and blends \p Gaussians for the view \p C; each step is a
  /// stage of the launcher. Releases the buffers of the previous frame.
  void draw(const GaussianBuffers &Gaussians, const Camera &C);

  /// \name The same in steps, for the path `raster`
  /// Between startBlending() and waitForBlending() other kernels may run, also
  /// of other pipelines, but only one pipeline may be between them.
  /// @{
  void prepare(const GaussianBuffers &Gaussians, const Camera &C);
  /// Sorts tiles by length, and allocates the memory for blending.
  void prepareRasterizers();
  void startBlending();
  void waitForBlending();
  void endBlending();
  /// @}

  /// Blends the lists of the frame again with depths in place of colours. The
  /// first channel of the result is the sum of weights times depths. Needs the
  /// effect \c Depth; the frame's pixels do not change.
  cl::Buffer drawDepths();
  /// The same with normals. Needs the effect \c Normals.
  cl::Buffer drawNormals();

  /// In training: a copy of the frame, blended with the colours of \p Records.
  /// The frame does not change.
  Frame drawBeside(const cl::Buffer &Records);

  const Frame &frame() const { return Current; }

  /// The options of the rasterizers for a picture.
  splat_blend_options blendOptions() const;
  /// Fails if a core's status among \p Statuses is not 0.
  void checkStatuses(const cl::Buffer &Statuses);

private:
  /// Begins a frame of \p Gaussians, and is the camera in their frame.
  Camera begin(const GaussianBuffers &Gaussians, const Camera &Given);
  /// \name Traced rays (TraceStage.cpp)
  /// @{
  void trace(const Camera &C);
  void shape(const Camera &C);
  void buildTree();
  void castRays(const Camera &C);
  void traceRays(const Camera &C);
  cl::Buffer reflect(uint32_t Rays);
  void traceThrough(const cl::Buffer &Rays, bool Onward);
  /// @}
  void project(const Camera &C);
  cl::Buffer cullBlocks();
  /// Whether a lens or a crop follows the view in the buffer.
  bool hasMoreThanView() const;
  void writeCamera(const Camera &C);
  void divide(const Camera &C);
  void sortByDepth();
  void countPairs();
  void duplicate();
  void sortByTile();
  void placeMesh();
  void showMesh();
  Frame setUpMesh(AlphaMode Mode);
  void drawMesh();
  void drawOpaque(const Frame &Triangles);
  void drawFragments(const Frame &Triangles);
  void clearLayers();
  void sortLayers();
  void composeLayer(uint32_t Layer);
  std::optional<cl::Buffer> limits() const;
  std::optional<cl::Buffer> visibleMesh() const;
  std::optional<cl::Buffer> withLayers(const cl::Buffer &Own) const;
  std::optional<cl_uint> numberOf(uint32_t Range) const;
  void placeInWindows();
  void blend();
  void rasterize(uint32_t Range);
  cl::Buffer blendAgain();
  uint64_t wordsOfOrder() const;
  void dealByLastFrame();
  void allocatePixels();
  cl::Buffer countsOfTiles();
  void shade(uint32_t Range);
  void prepareRays();
  cl::Buffer words(std::string_view What, uint64_t N) {
    return Launch.allocate(What, 4 * N);
  }

  Launcher &Launch;
  const RenderOptions &Options;
  EffectPlan Plan;
  Sorter Sort;
  TileDivision *Division = nullptr;
  Frame Current;
  cl::Buffer Counts;     ///< of tiles, over all frames; see Frame::Last
  cl::Buffer LastRanges; ///< lists of the last frame, if it distributes the
                         ///< tiles
};

} // namespace vorion::splat
