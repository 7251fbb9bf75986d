#include "render/Pipeline.h"

#include "effects/Registry.h"
#include "kernels/blend.cl.h"
#include "kernels/blend_by_ray.cl.h"
#include "kernels/cull_blocks.cl.h"
#include "kernels/depth.cl.h"
#include "kernels/merge.cl.h"
#include "kernels/normals.cl.h"
#include "kernels/project.cl.h"
#include "kernels/rasterize.cl.h"
#include "kernels/ray_frames.cl.h"
#include "kernels/tiles.cl.h"
#include "kernels/windows.cl.h"
#include "picture/View.h"
#include "render/Planes.h"
#include "vorion/support/HostMemory.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace vorion::splat {

static_assert(CullReasons.size() == CULL_REASONS);
static_assert(MaxImageSize / 8 <= 4096,
              "kernels/rectangle.cl has 12 bits for tiles of 8 pixels");

cl::NDRange itemsFor(uint32_t Count) {
  return {(static_cast<std::size_t>(Count) + GroupSize - 1) / GroupSize *
          GroupSize};
}

uint32_t Frame::seen() const {
  if (Copies == 1)
    return Visible;
  const uint64_t Unseen =
      std::accumulate(Culled.begin(), Culled.end(), uint64_t{0});
  return Gaussians.Count - static_cast<uint32_t>(Unseen);
}

namespace {

/// The planes of \p S that \p Plan evaluates, those of channels 0, 1, 2 of each
/// coefficient.
std::vector<std::size_t> bandPlanes(const EffectPlan &Plan) {
  const Effect *const Bands[] = {&effects::Sh1, &effects::Sh2, &effects::Sh3};
  std::vector<std::size_t> Planes{0, 1, 2};
  for (int Band = 1; Band <= MaxShDegree; ++Band)
    if (Plan.done(*Bands[Band - 1]))
      for (std::size_t P = 3 * shCoefficients(Band - 1);
           P < 3 * shCoefficients(Band); ++P)
        Planes.push_back(P);
  return Planes;
}

/// Frees the memory of vectors, which an empty list would keep.
template <typename... Vector> void release(Vector &...Values) {
  ((Values = Vector()), ...);
}

/// Buffers for \p Geometry and \p Sh words of the Gaussians of \p S.
GaussianBuffers allocate(Launcher &Launch, const Scene &S, std::size_t Geometry,
                         std::size_t Sh) {
  return {Launch.allocate("Gaussians' geometry", 4 * Geometry),
          Launch.allocate("Gaussians' colours", 4 * Sh),
          static_cast<uint32_t>(S.size()),
          {},
          {},
          S.Origin};
}

} // namespace

GaussianBuffers uploadGaussians(Launcher &Launch, const Scene &S,
                                int ShDegree) {
  const std::vector<float> Geometry = geometryPlanes(S),
                           Sh = shPlanes(S, ShDegree);
  GaussianBuffers B = allocate(Launch, S, Geometry.size(), Sh.size());
  Launch.write("Gaussians", B.Geometry, Geometry.data(), 4 * Geometry.size());
  Launch.write("colours", B.Sh, Sh.data(), 4 * Sh.size());
  Launch.settle();
  return B;
}

GaussianBuffers uploadGaussians(Launcher &Launch, SceneSource From,
                                const EffectPlan &Plan) {
  const Scene &S = From.scene();
  Scene *const Given = From.given();
  const std::vector<std::size_t> Planes = bandPlanes(Plan);
  std::vector<float> Bounds;
  if (Plan.done(effects::CullBlocks))
    Bounds = blockBounds(S);
  const std::size_t Geometry = blockWords(S.size(), GEOMETRY_PLANES),
                    Sh = blockWords(S.size(), Planes.size());
  GaussianBuffers B = allocate(Launch, S, Geometry, Sh);
  Launch.writeInPlace("Gaussians", B.Geometry, Geometry,
                      [&](auto To) { writeGeometryBlocks(S, To); });
  if (Given)
    release(Given->Means, Given->LogScales, Given->Quats, Given->OpacityLogits,
            Given->MeanRests);
  const std::size_t Stride = 3 * S.coefficients();
  Launch.writeInPlace("colours", B.Sh, Sh, [&](auto To) {
    writeShBlocks(S, Planes, To, [&](std::size_t First, std::size_t End) {
      if (Given)
        releasePages(std::as_bytes(
            std::span(S.Sh).subspan(First * Stride, (End - First) * Stride)));
    });
  });
  if (Given)
    release(Given->Sh);
  if (!Bounds.empty()) {
    B.Bounds = Launch.allocate("bounds of blocks", 4 * Bounds.size());
    Launch.write("bounds of blocks", B.Bounds, Bounds.data(),
                 4 * Bounds.size());
  }
  Launch.settle();
  return B;
}

void Pipeline::draw(const GaussianBuffers &Gaussians, const Camera &C) {
  if (Options.Kind == RendererKind::Trace)
    return trace(begin(Gaussians, C));
  prepare(Gaussians, C);
  if (Division)
    Division->keepOwn(Current, Options.tileHeight());
  if (Launch.failure())
    return;
  Launch.beginStage(Stage::Blend);
  if (Plan.done(effects::RayOrder))
    prepareRays();
  blend();
}

Camera Pipeline::begin(const GaussianBuffers &Gaussians, const Camera &Given) {
  Camera C = relativeTo(Given, Gaussians.Origin);
  Current = {};
  Current.View = makeView(C, Options);
  Current.View.effects = Plan.flags();
  Current.Gaussians = Gaussians;
  if (!isDrawnBy(*Options.Optics, C))
    Launch.fail({"", fmt::format("a camera of model {}, expected {}",
                                 C.Optics.Model->Name, Options.Optics->Name)});
  if (C.Optics.Shutter && !Options.Rolling)
    Launch.fail(
        {"", "a camera with a rolling shutter, expected a global shutter"});
  return C;
}

void Pipeline::prepare(const GaussianBuffers &Gaussians, const Camera &Given) {
  const Camera C = begin(Gaussians, Given);
  if (Launch.failure())
    return;
  const bool IsPinhole = Options.Optics->isPinhole() && !Options.Rolling;
  const auto FailWithout = [&](std::string_view Option, std::string_view Why) {
    Launch.fail(
        {"",
         fmt::format("{}: a camera of model {}{}, expected a pinhole, {}",
                     Option, C.Optics.Model->Name,
                     Options.Rolling ? " with a rolling shutter" : "", Why)});
  };
  if (Plan.done(effects::RayOrder) && !IsPinhole)
    return FailWithout("--order ray", "whose rays come from one point");
  if (Plan.done(effects::Mesh) && !Launch.device().isVorion())
    return Launch.fail({"", "--mesh: a device without Vorion's headers, "
                            "expected a Vorion"});
  if (Plan.done(effects::CullBlocks) && !IsPinhole)
    return FailWithout("--cull-blocks", "which sees between planes");
  Current.Copies = Options.Optics->CoversSphere ? 3 : 1;
  Launch.beginStage(Stage::Project);
  project(C);
  // What was read back says how much memory the rest needs.
  if (Launch.failure())
    return;
  Launch.beginStage(Stage::SortByDepth);
  sortByDepth();
  Launch.beginStage(Stage::CountPairs);
  countPairs();
  Launch.beginStage(Stage::Duplicate);
  duplicate();
  Launch.beginStage(Stage::SortByTile);
  sortByTile();
  if (!Plan.done(effects::Mesh))
    return;
  Launch.beginStage(Stage::Mesh);
  drawMesh();
}

/// What the blending kernels take with the effect Mesh.
std::optional<cl::Buffer> Pipeline::limits() const {
  return Plan.done(effects::Mesh) ? std::optional(Current.Surface.Limits)
                                  : std::nullopt;
}

std::optional<cl::Buffer> Pipeline::visibleMesh() const {
  return Plan.done(effects::Mesh) ? std::optional(Current.Surface.Visible)
                                  : std::nullopt;
}

/// And with the effect Layers.
std::optional<cl::Buffer> Pipeline::withLayers(const cl::Buffer &Own) const {
  return Plan.done(effects::Layers) ? std::optional(Own) : std::nullopt;
}

std::optional<cl_uint> Pipeline::numberOf(uint32_t Range) const {
  return Plan.done(effects::Layers) ? std::optional(cl_uint{Range})
                                    : std::nullopt;
}

void Pipeline::project(const Camera &C) {
  writeCamera(C);
  const uint32_t Count = Current.drawn();
  const std::size_t RecordBytes = Plan.done(effects::Rays)
                                      ? sizeof(splat_ray_gaussian)
                                      : sizeof(splat_gaussian);
  Current.Records =
      Launch.allocate("projected Gaussians",
                      RecordBytes * LINE_WORDS * uint64_t{blocksOf(Count)});
  Current.Depths.Keys = words("depths", Count);
  Current.Rectangles = words("tile rectangles", 2 * uint64_t{Count});
  const std::size_t Items = Launch.device().groupsAtOnce() * Lanes;
  const cl::Buffer Seen =
      Launch.allocate("what is seen", sizeof(splat_seen) * Items);
  std::optional<cl::Buffer> Verdicts;
  if (Plan.done(effects::CullBlocks))
    Verdicts = cullBlocks();
  Launch.run(Items, Lanes,
             kernels::project::project{
                 .camera = Current.Camera,
                 .geometry = Current.Gaussians.Geometry,
                 .sh = Current.Gaussians.Sh,
                 .records = Current.Records,
                 .depths = Current.Depths.Keys,
                 .rectangles = Current.Rectangles,
                 .items = Seen,
                 .count = Current.Gaussians.Count,
                 .verdicts = Verdicts,
                 .w = cl::Local(Plan.done(effects::Rays) ? RAYS_LOCAL_BYTES
                                : hasMoreThanView()      ? LENS_LOCAL_BYTES
                                                    : PROJECT_LOCAL_BYTES)});
  std::vector<splat_seen> Host(Items);
  Launch.read("what is seen", Host.data(), Seen, sizeof(splat_seen) * Items);
  uint64_t Pairs = 0;
  Current.LeastKey = ~0U;
  for (const splat_seen &One : Host) {
    Current.Visible += One.gaussians;
    Pairs += One.pairs;
    Current.LeastKey = std::min(Current.LeastKey, One.least_key);
    Current.GreatestKey = std::max(Current.GreatestKey, One.greatest_key);
    for (std::size_t R = 0; R < Current.Culled.size(); ++R)
      Current.Culled[R] += One.culled[R];
  }
  // Too many fail where they are allocated.
  Current.Pairs = static_cast<uint32_t>(std::min<uint64_t>(Pairs, ~0U));
}

/// A verdict of each block.
cl::Buffer Pipeline::cullBlocks() {
  const uint32_t Blocks = blocksOf(Current.Gaussians.Count);
  cl::Buffer Verdicts = words("verdicts of blocks", Blocks);
  Launch.run(
      itemsFor(Blocks), GroupSize,
      kernels::cull_blocks::cull_blocks{.view = Current.Camera,
                                        .bounds = Current.Gaussians.Bounds,
                                        .verdicts = Verdicts,
                                        .blocks = Blocks});
  return Verdicts;
}

/// HAS_LENS of the kernels.
static bool hasLens(const RenderOptions &O) {
  return !O.Optics->isPinhole() || O.Through == Spread::Unscented || O.Rolling;
}

bool Pipeline::hasMoreThanView() const {
  return hasLens(Options) || Plan.done(effects::Crop);
}

void Pipeline::writeCamera(const Camera &C) {
  std::vector<uint32_t> Words;
  const auto Append = [&](const auto &Part) {
    static_assert(sizeof(Part) % sizeof(uint32_t) == 0);
    const std::size_t At = Words.size();
    Words.resize(At + sizeof(Part) / sizeof(uint32_t));
    std::memcpy(&Words[At], &Part, sizeof(Part));
  };
  Append(Current.View);
  if (hasLens(Options))
    Append(makeLens(C));
  if (Plan.done(effects::Crop))
    Append(makeCrop(C));
  if (Options.Rolling)
    Append(makeShutter(C));
  const std::size_t Bytes = Words.size() * sizeof(uint32_t);
  Current.Camera = Launch.allocate("camera", Bytes);
  Launch.write("camera", Current.Camera, Words.data(), Bytes);
  if (Plan.done(effects::Windows))
    divide(C);
}

/// Into the smallest windows of whose records there is room.
void Pipeline::divide(const Camera &C) {
  constexpr unsigned Least = 8, Most = 15;
  constexpr uint64_t Room = uint64_t{1} << 29; // bytes
  const uint32_t Stride = LINE_WORDS * blocksOf(Current.drawn());
  for (unsigned Bits = Least; Bits <= Most; ++Bits) {
    const auto Along = [&](int A) {
      return ((Current.View.size[A] - 1) >> Bits) + 1;
    };
    Current.WindowCount = Along(0) * Along(1);
    Current.Windows = {Bits, Along(0), Stride};
    if (sizeof(splat_gaussian) * uint64_t{Stride} * Current.WindowCount <= Room)
      break;
  }
  const std::vector<splat_crop> Rays = makeWindows(C, Current.Windows.bits);
  const std::size_t Bytes = sizeof(splat_crop) * Rays.size();
  Current.WindowRays = Launch.allocate("rays of windows", Bytes);
  Launch.write("rays of windows", Current.WindowRays, Rays.data(), Bytes);
}

void Pipeline::sortByDepth() {
  Current.Order = Sort.sortKept(
      Current.Depths.Keys, {Current.drawn(), Current.Visible, Current.LeastKey,
                            Current.GreatestKey, 32 - Options.DepthBits});
}

void Pipeline::countPairs() {
  const Sorter::Share By = Sort.share(Current.Visible);
  Current.Ordered = words("tile rectangles", 2 * uint64_t{Current.Visible});
  Current.Sums = words("sums of pairs", By.items());
  Launch.run(By.items(), By.Lanes,
             kernels::tiles::count_tiles{.order = Current.Order,
                                         .rectangles = Current.Rectangles,
                                         .stride = Current.drawn(),
                                         .ordered = Current.Ordered,
                                         .sums = Current.Sums,
                                         .count = Current.Visible,
                                         .chunk = By.Chunk,
                                         .tiles_x = Current.View.tiles[0]});
}

void Pipeline::duplicate() {
  const Sorter::Share By = Sort.share(Current.Visible);
  Current.ByTile = {words("tiles of pairs", Current.Pairs),
                    words("Gaussians of pairs", Current.Pairs)};
  Current.Places = words("places of pairs",
                         Options.Training ? uint64_t{Current.Visible} + 1 : 1);
  Launch.run(By.items(), By.Lanes,
             kernels::tiles::duplicate{.order = Current.Order,
                                       .ordered = Current.Ordered,
                                       .sums = Current.Sums,
                                       .pair_tiles = Current.ByTile.Keys,
                                       .pair_gaussians = Current.ByTile.Values,
                                       .places = Current.Places,
                                       .count = Current.Visible,
                                       .chunk = By.Chunk,
                                       .tiles_x = Current.View.tiles[0],
                                       .effects = Current.View.effects});
}

void Pipeline::sortByTile() {
  const Sorter::KeyBits Bits{
      0, static_cast<unsigned>(std::bit_width(Current.tiles() - 1))};
  // Of one pass the totals say where lists are, else the sorted keys do.
  const bool OnePass = Current.Pairs != 0 && Sorter::inOnePass(Bits);
  const Sorter::Keys Wanted =
      OnePass ? Sorter::Keys::Lost : Sorter::Keys::Sorted;
  const Sorter::Pairs Other{OnePass ? cl::Buffer()
                                    : words("tiles of pairs", Current.Pairs),
                            words("Gaussians of pairs", Current.Pairs)};
  if (Options.Training) {
    // Where a pair was is where its gradients go, beside those of its Gaussian.
    const cl::Buffer Entries = Current.ByTile.Values;
    Current.ByTile.Values = words("places of sorted pairs", Current.Pairs);
    Current.List = words("Gaussians of sorted pairs", Current.Pairs);
    Launch.run(itemsFor(Current.Pairs), GroupSize,
               kernels::tiles::number{.values = Current.ByTile.Values,
                                      .count = Current.Pairs});
    Current.ByTile = Sort.sort(Current.ByTile, Current.ByTile, Other,
                               Current.Pairs, Bits, Wanted);
    Launch.run(itemsFor(Current.Pairs), GroupSize,
               kernels::tiles::look_up{.places = Current.ByTile.Values,
                                       .values = Entries,
                                       .found = Current.List,
                                       .count = Current.Pairs});
  } else {
    Current.ByTile = Sort.sort(Current.ByTile, Current.ByTile, Other,
                               Current.Pairs, Bits, Wanted);
    Current.List = Current.ByTile.Values;
  }
  Current.Ranges = words("tile ranges", 2 * uint64_t{Current.tiles()});
  if (OnePass)
    return Sort.rangesOfKeys(Current.Ranges, Current.tiles());
  Launch.run(itemsFor(Current.tiles()), GroupSize,
             kernels::tiles::tile_ranges{.pair_tiles = Current.ByTile.Keys,
                                         .ranges = Current.Ranges,
                                         .pairs = Current.Pairs,
                                         .tiles = Current.tiles()});
}

/// Gives the windows what has become of the records.
void Pipeline::placeInWindows() {
  Current.Blended = Current.Records;
  if (!Plan.done(effects::Windows))
    return;
  Current.Blended = Launch.allocate(
      "Gaussians of windows",
      sizeof(splat_gaussian) *
          (1 + uint64_t{Current.WindowCount} * Current.Windows.stride));
  Launch.run(itemsFor(Current.drawn()), GroupSize,
             kernels::windows::records_of_windows{
                 .view = Current.Camera,
                 .geometries = Current.Gaussians.Geometry,
                 .records = Current.Records,
                 .depths = Current.Depths.Keys,
                 .rectangles = Current.Rectangles,
                 .crops = Current.WindowRays,
                 .to = Current.Blended,
                 .count = Current.Gaussians.Count,
                 .drawn = Current.drawn(),
                 .apart = Current.stride(),
                 .windows = Current.Windows});
}

/// The ranges of the lists, and the layers between them.
void Pipeline::blend() {
  const bool OnCores = Options.Blending == Path::Simt;
  if (OnCores) {
    placeInWindows();
    allocatePixels();
  } else {
    prepareRasterizers();
  }
  for (uint32_t Range = 0; Range <= Current.Surface.MostLayers; ++Range) {
    if (Range != 0)
      composeLayer(Range - 1);
    if (OnCores)
      shade(Range);
    else
      rasterize(Range);
  }
  if (Division)
    Division->completePixels(Current);
}

void Pipeline::rasterize(uint32_t Range) {
  Launch.run(Launch.device().computeUnits() * Lanes, Lanes,
             kernels::rasterize::rasterize{
                 .records = Current.Blended,
                 .list = Current.List,
                 .ranges = Current.Ranges,
                 .tile_order = Current.TileOrder,
                 .pixels = Current.Parts,
                 .last = Current.Last,
                 .tails = Current.Tails,
                 .limits = limits(),
                 .tile_layers = withLayers(Current.Surface.TileLayers),
                 .layer = numberOf(Range),
                 .statuses = Current.Statuses,
                 .options = blendOptions()});
  endBlending();
}

void Pipeline::allocatePixels() {
  Current.Pixels = Launch.allocate("pixels", 16 * uint64_t{Current.pixels()});
  if (Options.Deal == Dealing::LastFrame)
    Current.Last = countsOfTiles();
  else
    Current.Last =
        words("last contributors", Options.Training ? Current.pixels() : 1);
}

cl::Buffer Pipeline::countsOfTiles() {
  if (!Counts()) {
    const std::vector<uint32_t> None(2 * std::size_t{Current.tiles()}, 0);
    Counts = words("tiles' counts", None.size());
    Launch.write("tiles' counts", Counts, None.data(), 4 * None.size());
  }
  return Counts;
}

cl::Buffer Pipeline::drawDepths() {
  Launch.run(itemsFor(Current.drawn()), GroupSize,
             kernels::depth::depths_for_colors{.depths = Current.Depths.Keys,
                                               .records = Current.Records,
                                               .count = Current.drawn()});
  return blendAgain();
}

cl::Buffer Pipeline::drawNormals() {
  Launch.run(itemsFor(Current.drawn()), GroupSize,
             kernels::normals::normals_for_colors{
                 .view = Current.Camera,
                 .geometry = Current.Gaussians.Geometry,
                 .depths = Current.Depths.Keys,
                 .records = Current.Records,
                 .count = Current.drawn(),
                 .stride = Current.stride()});
  return blendAgain();
}

/// What the records' colours have become; the frame's own pixels stay.
cl::Buffer Pipeline::blendAgain() {
  const cl::Buffer Picture = Current.Pixels;
  blend();
  return std::exchange(Current.Pixels, Picture);
}

Frame Pipeline::drawBeside(const cl::Buffer &Records) {
  const Frame Own = Current;
  Current.Records = Records;
  blend();
  return std::exchange(Current, Own);
}

void Pipeline::shade(uint32_t Range) {
  const std::size_t Group = Options.SimtGroup;
  const cl::NDRange Items(Current.View.tiles[0] * Group, Current.View.tiles[1]);
  const cl::NDRange GroupItems(Group, 1);
  if (Plan.done(effects::RayOrder))
    return Launch.run(
        Items, GroupItems,
        kernels::blend_by_ray::blend_by_ray{
            .view = Current.Camera,
            .records = Current.Blended,
            .frames = Current.RayFrames,
            .list = Current.List,
            .ranges = Current.Ranges,
            .pixels = Current.Pixels,
            .visible = visibleMesh(),
            .layers = withLayers(Current.Surface.Layers),
            .layer_counts = withLayers(Current.Surface.LayerCounts),
            .tile_layers = withLayers(Current.Surface.TileLayers),
            .layer = numberOf(Range),
            .cutoff = Options.Cutoff,
            .effects = Current.View.effects});
  Launch.run(Items, GroupItems,
             kernels::blend::blend{.records = Current.Blended,
                                   .list = Current.List,
                                   .ranges = Current.Ranges,
                                   .pixels = Current.Pixels,
                                   .last = Current.Last,
                                   .limits = limits(),
                                   .tile_layers =
                                       withLayers(Current.Surface.TileLayers),
                                   .layer = numberOf(Range),
                                   .width = Current.View.size[0],
                                   .height = Current.View.size[1],
                                   .cutoff = Options.Cutoff,
                                   .effects = Current.View.effects});
}

void Pipeline::prepareRays() {
  Current.RayFrames =
      Launch.allocate("Gaussians for rays",
                      sizeof(splat_ray_frame) * uint64_t{Current.drawn()});
  Launch.run(
      itemsFor(Current.drawn()), GroupSize,
      kernels::ray_frames::ray_frames{.view = Current.Camera,
                                      .geometries = Current.Gaussians.Geometry,
                                      .depths = Current.Depths.Keys,
                                      .frames = Current.RayFrames,
                                      .count = Current.drawn()});
}

splat_blend_options Pipeline::blendOptions() const {
  const TailRule &Tail = Options.PixelUnit;
  splat_blend_options O{};
  O.size[0] = Current.View.size[0];
  O.size[1] = Current.View.size[1];
  O.tiles_x = Current.View.tiles[0];
  O.tiles = Current.tiles();
  O.parts = Options.ZTiles;
  O.cutoff = Options.Cutoff;
  O.datapath =
      static_cast<unsigned>(Options.Exponential) << DATAPATH_EXP |
      static_cast<unsigned>(Options.Arithmetic) << DATAPATH_BLEND |
      static_cast<unsigned>(std::countr_zero(Options.AlphaCutoff))
          << DATAPATH_ALPHA_CUTOFF |
      (Options.Convention == Rules::Gsplat ? DATAPATH_STOP_AT_EQUAL : 0U) |
      (Options.SkipSaturated ? DATAPATH_SKIP_SATURATED : 0U) |
      (Options.FalloffDegree == 4 ? DATAPATH_DEGREE4 : 0U) |
      (Options.Kind == RendererKind::Surfel ? DATAPATH_LOW_PASS : 0U);
  O.tail_count = Tail.Count;
  O.tail_last[0] = Tail.LastOver;
  O.tail_last[1] = Tail.LastUnder;
  O.tail_share = Tail.shareBits();
  O.effects = Plan.flags();
  return O;
}

void Pipeline::prepareRasterizers() {
  placeInWindows();
  allocatePixels();
  Current.Parts = Current.Pixels;
  if (Plan.done(effects::ZTiles))
    Current.Parts = Launch.allocate(
        "depth parts", 16 * uint64_t{Current.pixels()} * Options.ZTiles);
  Current.TileOrder = words("tile order", wordsOfOrder());
  Current.Statuses = words("cores' statuses", Launch.device().computeUnits());
  const uint64_t Tail =
      TAIL_BYTES + (Plan.done(effects::Mesh) ? TAIL_RANGE_BYTES : 0);
  Current.Tails = Launch.allocate("hand-over records",
                                  Plan.done(effects::PixelUnit)
                                      ? Tail * Options.ZTiles * Current.tiles()
                                      : Tail);
  if (Options.Deal == Dealing::LastFrame)
    return dealByLastFrame();
  Launch.run(itemsFor(Current.tiles()), GroupSize,
             kernels::tiles::order_tiles{.ranges = Current.Ranges,
                                         .order = Current.TileOrder,
                                         .tiles = Current.tiles()});
}

uint64_t Pipeline::wordsOfOrder() const {
  const uint64_t Tiles = Current.tiles();
  if (Options.Deal == Dealing::Lists)
    return Tiles;
  // There are no more rasterizers than cores, and none beyond the lanes of a
  // warp gets a tile.
  return (Tiles + 1) *
         std::min<uint64_t>(Launch.device().computeUnits(), Lanes);
}

void Pipeline::dealByLastFrame() {
  const uint32_t Tiles = Current.tiles();
  const cl::Buffer Ranked = words("ranks of tiles", 2 * uint64_t{Tiles});
  Launch.run((Tiles + Lanes - 1) / Lanes * Lanes, Lanes,
             kernels::rasterize::rank_tiles{
                 .ranges = Current.Ranges,
                 .last_ranges = LastRanges() ? LastRanges : Current.Ranges,
                 .counts = Current.Last,
                 .ranked = Ranked,
                 .tiles = Tiles});
  Launch.run(Lanes, Lanes,
             kernels::rasterize::deal_tiles{
                 .ranked = Ranked, .dealt = Current.TileOrder, .tiles = Tiles});
  LastRanges = Current.Ranges;
}

void Pipeline::startBlending() {
  Launch.run(Launch.device().computeUnits() * Lanes, Lanes,
             kernels::rasterize::rasterize_start{
                 .records = Current.Blended,
                 .list = Current.List,
                 .ranges = Current.Ranges,
                 .tile_order = Current.TileOrder,
                 .pixels = Current.Parts,
                 .last = Current.Last,
                 .tails = Current.Tails,
                 .limits = limits(),
                 .tile_layers = withLayers(Current.Surface.TileLayers),
                 .layer = numberOf(0),
                 .options = blendOptions()});
}

void Pipeline::waitForBlending() {
  Launch.run(Launch.device().computeUnits() * Lanes, Lanes,
             kernels::rasterize::rasterize_wait{.statuses = Current.Statuses});
}

void Pipeline::endBlending() {
  if (Plan.done(effects::ZTiles))
    Launch.run(itemsFor(Current.pixels()), GroupSize,
               kernels::merge::merge{.parts = Current.Parts,
                                     .pixels = Current.Pixels,
                                     .count = Current.pixels(),
                                     .num_parts = Options.ZTiles});
  checkStatuses(Current.Statuses);
}

void Pipeline::checkStatuses(const cl::Buffer &Statuses) {
  std::vector<uint32_t> Host(Launch.device().computeUnits(), 0);
  Launch.read("cores' statuses", Host.data(), Statuses, 4 * Host.size());
  for (std::size_t C = 0; C < Host.size(); ++C)
    if (Host[C] != 0)
      Launch.fail(
          {"",
           fmt::format("the rasterizer refused a tile of core {} with status "
                       "code {}, expected 0 (codes: docs/isa.md)",
                       C, Host[C]),
           ExitCode::Trap});
}

} // namespace vorion::splat
