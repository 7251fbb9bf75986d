// The stage of a mesh: its triangles are drawn, and become limits of the
// pixels' lists.
#include "effects/Registry.h"
#include "kernels/mesh.cl.h"
#include "kernels/mesh_fragments.cl.h"
#include "kernels/mesh_fragments_simt.cl.h"
#include "kernels/mesh_layers.cl.h"
#include "kernels/mesh_raster.cl.h"
#include "kernels/mesh_simt.cl.h"
#include "kernels/tiles.cl.h"
#include "render/Pipeline.h"
#include "render/Renderer.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <utility>

namespace vorion::splat {

/// Bytes of a vx_triangle and of a vx_visibility (docs/isa.md).
static constexpr uint64_t TriangleBytes = 72, VisibilityBytes = 8;

static_assert(TEXTURE_LEVELS == MaxTextureLevels);
static_assert(static_cast<int>(Wrap::Mirror) == WRAP_MIRROR &&
              static_cast<int>(Wrap::Clamp) == WRAP_CLAMP);

/// The materials of \p M, and the texels of all textures.
static std::pair<std::vector<splat_material>, std::vector<uint32_t>>
texturesOf(const Mesh &M) {
  std::vector<uint32_t> Texels;
  std::vector<uint32_t> Firsts; // of the textures
  for (const Texture &T : M.Textures) {
    Firsts.push_back(static_cast<uint32_t>(Texels.size()));
    Texels.insert(Texels.end(), T.Texels.begin(), T.Texels.end());
  }
  std::vector<splat_material> Materials;
  for (const Material &From : M.Materials) {
    splat_material &To = Materials.emplace_back();
    To.mode = static_cast<uint32_t>(From.Alpha);
    To.cutoff = From.Cutoff;
    if (!From.Picture)
      continue;
    const Texture &T = M.Textures[*From.Picture];
    const Sampler &S = From.Sampling;
    To.levels = static_cast<uint32_t>(T.Levels.size());
    To.size[0] = static_cast<uint32_t>(T.Levels[0].Width);
    To.size[1] = static_cast<uint32_t>(T.Levels[0].Height);
    for (std::size_t A = 0; A < 2; ++A)
      To.wrap[A] = static_cast<uint32_t>(S.Wraps[A]);
    To.filters = (S.MagnifiesLinearly ? FILTER_LARGER : 0U) |
                 (S.MinifiesLinearly ? FILTER_SMALLER : 0U) |
                 (S.Levels == Sampler::Mips::None ? 0U : FILTER_LEVELS) |
                 (S.Levels == Sampler::Mips::Linear ? FILTER_BETWEEN : 0U);
    for (std::size_t L = 0; L < T.Levels.size(); ++L)
      To.first[L] =
          Firsts[*From.Picture] + static_cast<uint32_t>(T.Levels[L].First);
  }
  return {std::move(Materials), std::move(Texels)};
}

MeshBuffers uploadMesh(Launcher &Launch, const Mesh &M, const EffectPlan &Plan,
                       RendererKind Kind) {
  const auto Upload = [&](std::string_view What, const auto &From) {
    const uint64_t Bytes = sizeof(From[0]) * uint64_t{From.size()};
    cl::Buffer To = Launch.allocate(What, Bytes);
    Launch.write(What, To, From.data(), Bytes);
    return To;
  };
  MeshBuffers B;
  B.Positions = Upload("mesh's vertices", M.Positions);
  B.Colors = Upload("mesh's colours", M.Colors);
  B.Corners = Upload("mesh's triangles", M.Corners);
  B.Vertices = static_cast<uint32_t>(M.vertices());
  B.Triangles = static_cast<uint32_t>(M.triangles());
  // Lives until all of it is written.
  const bool HasLooks =
      Plan.done(effects::Texture) || Plan.done(effects::Layers);
  const auto [Materials, Texels] =
      HasLooks ? texturesOf(M) : decltype(texturesOf(M))();
  if (HasLooks) {
    B.MaterialOf = Upload("materials of triangles", M.MaterialOf);
    B.Materials = Upload("materials", Materials);
  }
  std::vector<float> Linear;
  if (Plan.done(effects::Texture)) {
    for (int Value = 0; Value < 256; ++Value)
      Linear.push_back(static_cast<float>(toLinear(Value / 255.0)));
    B.TextureCoordinates =
        Upload("texture coordinates of the mesh", M.TextureCoordinates);
    B.Texels = Upload("textures", Texels);
    B.Linear = Upload("linear values", Linear);
  }
  std::vector<float> Normals;
  if (Plan.done(effects::Light) || Kind == RendererKind::Trace) {
    if (M.Normals.empty())
      Normals.resize(3 * M.Corners.size());
    B.Normals =
        Upload("normals of the mesh", M.Normals.empty() ? Normals : M.Normals);
  }
  Launch.settle();
  return B;
}

/// Towards the light of \p O.
static std::optional<cl_float4> lightOf(const RenderOptions &O) {
  if (!O.Light)
    return std::nullopt;
  return cl_float4{{-(*O.Light)[0], -(*O.Light)[1], -(*O.Light)[2], 0}};
}

/// \p B where kernels shade textures, which alone need materials for colours.
static std::optional<cl::Buffer> ofTexture(const MeshBuffers &M,
                                           const std::optional<cl::Buffer> &B) {
  return M.TextureCoordinates ? B : std::nullopt;
}

/// The vertices in the camera's axes.
void Pipeline::placeMesh() {
  const MeshBuffers &M = Current.Gaussians.Surface;
  Current.Surface.Points =
      Launch.allocate("mesh in the camera", 16 * uint64_t{M.Vertices});
  Launch.run(itemsFor(M.Vertices), GroupSize,
             kernels::mesh::mesh_points{.camera = Current.Camera,
                                        .positions = M.Positions,
                                        .points = Current.Surface.Points,
                                        .count = M.Vertices});
}

/// The records of the triangles of \p Mode to draw, with the lists of the
/// tiles. Without the effect Layers all are opaque.
Frame Pipeline::setUpMesh(AlphaMode Mode) {
  const MeshBuffers &M = Current.Gaussians.Surface;
  std::optional<cl::Buffer> MaterialOf, Materials;
  std::optional<cl_uint> OfMode;
  if (Plan.done(effects::Layers)) {
    MaterialOf = M.MaterialOf;
    Materials = M.Materials;
    OfMode = static_cast<cl_uint>(Mode);
  }
  const cl::Buffer Numbers = words("numbers of triangles", M.Triangles),
                   Firsts =
                       words("places of triangles", uint64_t{M.Triangles} + 1);
  Launch.run(itemsFor(M.Triangles), GroupSize,
             kernels::mesh::mesh_count{.camera = Current.Camera,
                                       .points = Current.Surface.Points,
                                       .corners = M.Corners,
                                       .counts = Numbers,
                                       .material_of = MaterialOf,
                                       .materials = Materials,
                                       .mode = OfMode,
                                       .triangles = M.Triangles});
  Sort.scan(Numbers, Firsts, M.Triangles);
  Frame Own;
  Own.View = Current.View;
  Launch.read("triangles to draw", &Own.Visible, Firsts, 4,
              4 * uint64_t{M.Triangles});
  // The tiles of triangles are those of Gaussians, in the mesh's order.
  const uint32_t Room = std::max(Own.Visible, 1U);
  Own.Gaussians.Count = Room;
  Own.Records = Launch.allocate("triangles to draw", TriangleBytes * Room);
  Own.Rectangles = words("triangles' rectangles", 2 * uint64_t{Room});
  Own.Order = words("triangles' order", Room);
  Launch.run(itemsFor(M.Triangles), GroupSize,
             kernels::mesh::mesh_setup{.camera = Current.Camera,
                                       .points = Current.Surface.Points,
                                       .corners = M.Corners,
                                       .firsts = Firsts,
                                       .records = Own.Records,
                                       .rectangles = Own.Rectangles,
                                       .order = Own.Order,
                                       .stride = Room,
                                       .material_of = MaterialOf,
                                       .materials = Materials,
                                       .mode = OfMode,
                                       .triangles = M.Triangles});
  std::swap(Own, Current);
  countPairs();
  std::vector<uint32_t> Sums(Sort.share(Current.Visible).items());
  Launch.read("sums of pairs", Sums.data(), Current.Sums,
              4 * uint64_t{Sums.size()});
  const uint64_t Pairs = std::reduce(Sums.begin(), Sums.end(), uint64_t{0});
  // Too many fail where they are allocated.
  Current.Pairs = static_cast<uint32_t>(std::min<uint64_t>(Pairs, ~0U));
  duplicate();
  sortByTile();
  std::swap(Own, Current);
  return Own;
}

/// The nearest of the opaque triangles in each pixel.
void Pipeline::showMesh() {
  placeMesh();
  Current.Surface.Visible =
      Launch.allocate("visible triangles", VisibilityBytes * Current.pixels());
  drawOpaque(setUpMesh(AlphaMode::Opaque));
}

void Pipeline::drawMesh() {
  MeshFrame &To = Current.Surface;
  const splat_view &V = Current.View;
  const bool HasLayers = Plan.done(effects::Layers);
  showMesh();
  if (HasLayers) {
    clearLayers();
    // Layers are in front of what masks leave.
    for (const AlphaMode Mode : {AlphaMode::Mask, AlphaMode::Blend})
      if (Options.Surface->has(Mode))
        drawFragments(setUpMesh(Mode));
  }
  To.Limits =
      words("limits of pixels",
            uint64_t{HasLayers ? MOST_LAYERS + 1U : 1U} * Current.pixels());
  Launch.run(itemsFor(Current.pixels()), GroupSize,
             kernels::mesh::mesh_limits{.visible = To.Visible,
                                        .depths = Current.Depths.Keys,
                                        .list = Current.List,
                                        .ranges = Current.Ranges,
                                        .limits = To.Limits,
                                        .width = V.size[0],
                                        .count = Current.pixels(),
                                        .tiles_x = V.tiles[0],
                                        .shift = 32 - Options.DepthBits});
  if (HasLayers)
    sortLayers();
}

void Pipeline::drawOpaque(const Frame &Triangles) {
  if (Launch.failure())
    return;
  const MeshFrame &To = Current.Surface;
  const splat_view &V = Current.View;
  if (Options.Blending == Path::Simt)
    return Launch.run(
        Current.tiles() * Lanes, Lanes,
        kernels::mesh_simt::mesh_visibility{.records = Triangles.Records,
                                            .list = Triangles.List,
                                            .ranges = Triangles.Ranges,
                                            .visible = To.Visible,
                                            .width = V.size[0],
                                            .height = V.size[1],
                                            .tiles_x = V.tiles[0]});
  const cl::Buffer Statuses =
      words("cores' statuses", Launch.device().computeUnits());
  Launch.run(Launch.device().computeUnits() * Lanes, Lanes,
             kernels::mesh_raster::mesh_visibility{.records = Triangles.Records,
                                                   .list = Triangles.List,
                                                   .ranges = Triangles.Ranges,
                                                   .visible = To.Visible,
                                                   .statuses = Statuses,
                                                   .width = V.size[0],
                                                   .height = V.size[1],
                                                   .tiles_x = V.tiles[0],
                                                   .tiles = Current.tiles()});
  checkStatuses(Statuses);
}

/// What triangles that are not opaque do in the pixels.
void Pipeline::drawFragments(const Frame &Triangles) {
  if (Launch.failure())
    return;
  const MeshFrame &To = Current.Surface;
  const MeshBuffers &M = Current.Gaussians.Surface;
  if (Options.Blending == Path::Simt)
    return Launch.run(Current.tiles() * Lanes, Lanes,
                      kernels::mesh_fragments_simt::mesh_fragments{
                          .camera = Current.Camera,
                          .points = Current.Surface.Points,
                          .corners = M.Corners,
                          .colors = M.Colors,
                          .material_of = *M.MaterialOf,
                          .materials = *M.Materials,
                          .coordinates = M.TextureCoordinates,
                          .texels = M.Texels,
                          .linear = M.Linear,
                          .normals = M.Normals,
                          .light = lightOf(Options),
                          .records = Triangles.Records,
                          .list = Triangles.List,
                          .ranges = Triangles.Ranges,
                          .visible = To.Visible,
                          .counts = To.LayerCounts,
                          .layers = To.Layers});
  const cl::Buffer Statuses =
      words("cores' statuses", Launch.device().computeUnits());
  Launch.run(Launch.device().computeUnits() * Lanes, Lanes,
             kernels::mesh_fragments::mesh_fragments{
                 .camera = Current.Camera,
                 .points = Current.Surface.Points,
                 .corners = M.Corners,
                 .colors = M.Colors,
                 .material_of = *M.MaterialOf,
                 .materials = *M.Materials,
                 .coordinates = M.TextureCoordinates,
                 .texels = M.Texels,
                 .linear = M.Linear,
                 .normals = M.Normals,
                 .light = lightOf(Options),
                 .records = Triangles.Records,
                 .list = Triangles.List,
                 .ranges = Triangles.Ranges,
                 .visible = To.Visible,
                 .counts = To.LayerCounts,
                 .layers = To.Layers,
                 .statuses = Statuses,
                 .tiles = Current.tiles()});
  checkStatuses(Statuses);
}

void Pipeline::clearLayers() {
  MeshFrame &To = Current.Surface;
  const uint64_t Pixels = Current.pixels();
  To.LayerCounts = words("numbers of layers", Pixels);
  To.Layers = Launch.allocate("layers", VisibilityBytes * MOST_LAYERS * Pixels);
  To.TileLayers = words("layers of tiles", Current.tiles() + 1ULL);
  Launch.run(
      itemsFor(Current.pixels()), GroupSize,
      kernels::mesh_layers::mesh_clear_layers{.layer_counts = To.LayerCounts,
                                              .tile_layers = To.TileLayers,
                                              .count = Current.pixels(),
                                              .tiles = Current.tiles()});
}

/// By their depths, with the ranges between them.
void Pipeline::sortLayers() {
  MeshFrame &To = Current.Surface;
  Launch.run(
      itemsFor(Current.pixels()), GroupSize,
      kernels::mesh_layers::mesh_sort_layers{.layers = To.Layers,
                                             .layer_counts = To.LayerCounts,
                                             .depths = Current.Depths.Keys,
                                             .list = Current.List,
                                             .ranges = Current.Ranges,
                                             .limits = To.Limits,
                                             .tile_layers = To.TileLayers,
                                             .width = Current.View.size[0],
                                             .count = Current.pixels(),
                                             .tiles_x = Current.View.tiles[0],
                                             .tiles = Current.tiles(),
                                             .shift = 32 - Options.DepthBits});
  Launch.read("most layers", &To.MostLayers, To.TileLayers, 4,
              4 * uint64_t{Current.tiles()});
  if (!Launch.failure() && To.MostLayers > MOST_LAYERS)
    Launch.fail({Options.Surface->file(),
                 fmt::format("a pixel has {} transparent surfaces, expected at "
                             "most {}",
                             To.MostLayers, static_cast<int>(MOST_LAYERS)),
                 ExitCode::InputFile});
  if (Launch.failure())
    To.MostLayers = 0;
}

/// Blends layer \p Layer of each pixel behind what the pixel has.
void Pipeline::composeLayer(uint32_t Layer) {
  const MeshBuffers &M = Current.Gaussians.Surface;
  Launch.run(itemsFor(Current.pixels()), GroupSize,
             kernels::mesh_layers::mesh_compose{
                 .camera = Current.Camera,
                 .points = Current.Surface.Points,
                 .corners = M.Corners,
                 .colors = M.Colors,
                 .coordinates = M.TextureCoordinates,
                 .material_of = ofTexture(M, M.MaterialOf),
                 .materials = ofTexture(M, M.Materials),
                 .texels = M.Texels,
                 .linear = M.Linear,
                 .normals = M.Normals,
                 .light = lightOf(Options),
                 .layers = Current.Surface.Layers,
                 .layer_counts = Current.Surface.LayerCounts,
                 .pixels = Current.Pixels,
                 .count = Current.pixels(),
                 .layer = Layer});
}

cl::Buffer resolveMesh(Launcher &Launch, const Frame &F,
                       const RenderOptions &Options) {
  cl::Buffer Picture = Launch.allocate("picture", 16 * uint64_t{F.pixels()});
  const MeshBuffers &M = F.Gaussians.Surface;
  const auto [Red, Green, Blue] = Options.Background;
  Launch.run(
      itemsFor(F.pixels()), GroupSize,
      kernels::mesh::mesh_resolve{.camera = F.Camera,
                                  .points = F.Surface.Points,
                                  .corners = M.Corners,
                                  .colors = M.Colors,
                                  .coordinates = M.TextureCoordinates,
                                  .material_of = ofTexture(M, M.MaterialOf),
                                  .materials = ofTexture(M, M.Materials),
                                  .texels = M.Texels,
                                  .linear = M.Linear,
                                  .normals = M.Normals,
                                  .light = lightOf(Options),
                                  .visible = F.Surface.Visible,
                                  .pixels = F.Pixels,
                                  .picture = Picture,
                                  .count = F.pixels(),
                                  .red = Red,
                                  .green = Green,
                                  .blue = Blue});
  return Picture;
}

VisibleMesh readVisible(Launcher &Launch, const Frame &F,
                        const RenderOptions &Options) {
  struct Word {
    float Depth;
    int32_t Triangle;
  };
  const std::size_t Pixels = F.pixels();
  VisibleMesh V{static_cast<int>(F.View.size[0]),
                static_cast<int>(F.View.size[1]),
                {},
                {},
                {},
                {}};
  const auto Append = [&](const std::vector<Word> &From, auto &Depths,
                          auto &Triangles, const auto &IsThere) {
    for (std::size_t I = 0; I < From.size(); ++I) {
      const Word &W = From[I];
      const bool Is = W.Triangle >= 0 && IsThere(I);
      Depths.push_back(!Is ? std::numeric_limits<float>::infinity()
                       : Options.Optics->IsParallel
                           ? -W.Depth
                           : Options.depthScale() / W.Depth);
      Triangles.push_back(Is ? W.Triangle : -1);
    }
  };
  std::vector<Word> Words(Pixels);
  Launch.read("visible triangles", Words.data(), F.Surface.Visible,
              VisibilityBytes * Pixels);
  Append(Words, V.Depth, V.Triangles, [](std::size_t) { return true; });
  if (F.Surface.MostLayers == 0)
    return V;
  std::vector<uint32_t> Counts(Pixels);
  Launch.read("numbers of layers", Counts.data(), F.Surface.LayerCounts,
              4 * Pixels);
  Words.resize(F.Surface.MostLayers * Pixels);
  Launch.read("layers", Words.data(), F.Surface.Layers,
              VisibilityBytes * Words.size());
  Append(Words, V.LayerDepths, V.LayerTriangles,
         [&](std::size_t I) { return I / Pixels < Counts[I % Pixels]; });
  return V;
}

} // namespace vorion::splat
