#include "render/Pipeline.h"

#include "effects/Registry.h"
#include "picture/View.h"
#include "render/Planes.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <utility>

namespace vorion::splat {

static_assert(CullReasons.size() == CULL_REASONS);

cl::NDRange itemsFor(uint32_t Count) {
  return {(static_cast<std::size_t>(Count) + GroupSize - 1) / GroupSize *
          GroupSize};
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

GaussianBuffers upload(Launcher &L, const Scene &S,
                       const std::vector<float> &Geometry,
                       const std::vector<float> &Sh) {
  const GaussianBuffers B{
      L.allocate("Gaussians' geometry", 4 * Geometry.size()),
      L.allocate("Gaussians' colours", 4 * Sh.size()),
      static_cast<uint32_t>(S.size())};
  L.write("Gaussians", B.Geometry, Geometry.data(), 4 * Geometry.size());
  L.write("colours", B.Sh, Sh.data(), 4 * Sh.size());
  return B;
}

} // namespace

GaussianBuffers uploadGaussians(Launcher &L, const Scene &S, int ShDegree) {
  return upload(L, S, geometryPlanes(S), shPlanes(S, ShDegree));
}

GaussianBuffers uploadGaussians(Launcher &L, const Scene &S,
                                const EffectPlan &Plan) {
  return upload(L, S, geometryBlocks(S), shBlocks(S, bandPlanes(Plan)));
}

void Pipeline::draw(const GaussianBuffers &Gaussians, const Camera &C) {
  prepare(Gaussians, C);
  if (L.failure())
    return;
  L.beginStage(Stage::Blend);
  blend();
}

void Pipeline::prepare(const GaussianBuffers &Gaussians, const Camera &C) {
  F = {};
  F.View = makeView(C, Options);
  F.View.effects = Plan.flags();
  F.Gaussians = Gaussians;
  L.beginStage(Stage::Project);
  project();
  // What was read back says how much memory the rest needs.
  if (L.failure())
    return;
  L.beginStage(Stage::SortByDepth);
  sortByDepth();
  L.beginStage(Stage::CountPairs);
  countPairs();
  L.beginStage(Stage::Duplicate);
  duplicate();
  L.beginStage(Stage::SortByTile);
  sortByTile();
}

void Pipeline::project() {
  F.Camera = L.allocate("camera", sizeof(F.View));
  L.write("camera", F.Camera, &F.View, sizeof(F.View));
  const uint32_t Count = F.Gaussians.Count;
  const uint64_t Blocks = (uint64_t{Count} + LINE_WORDS - 1) / LINE_WORDS;
  F.Records = L.allocate("projected Gaussians",
                         sizeof(splat_gaussian) * LINE_WORDS * Blocks);
  F.Depths.Keys = words("depths", Count);
  F.Rectangles = words("tile rectangles", 2 * uint64_t{Count});
  const std::size_t Items = L.device().computeUnits() * Lanes;
  const cl::Buffer Seen =
      L.allocate("what is seen", sizeof(splat_seen) * Items);
  L.run(ProjectProgram, "project", Items, Lanes, F.Camera, F.Gaussians.Geometry,
        F.Gaussians.Sh, F.Records, F.Depths.Keys, F.Rectangles, Seen, Count,
        cl::Local(PROJECT_LOCAL_BYTES));
  std::vector<splat_seen> Host(Items);
  L.read("what is seen", Host.data(), Seen, sizeof(splat_seen) * Items);
  uint64_t Pairs = 0;
  F.LeastKey = ~0U;
  for (const splat_seen &One : Host) {
    F.Visible += One.gaussians;
    Pairs += One.pairs;
    F.LeastKey = std::min(F.LeastKey, One.least_key);
    F.GreatestKey = std::max(F.GreatestKey, One.greatest_key);
    for (std::size_t R = 0; R < F.Culled.size(); ++R)
      F.Culled[R] += One.culled[R];
  }
  // Too many fail where they are allocated.
  F.Pairs = static_cast<uint32_t>(std::min<uint64_t>(Pairs, ~0U));
}

void Pipeline::sortByDepth() {
  const Sorter::Pairs A{words("sorted depths", F.Visible),
                        words("sorted Gaussians", F.Visible)};
  const Sorter::Pairs B{words("sorted depths", F.Visible),
                        words("sorted Gaussians", F.Visible)};
  F.Order = Sort.sortKept(F.Depths.Keys,
                          {F.Gaussians.Count, F.Visible, F.LeastKey,
                           F.GreatestKey, 32 - Options.DepthBits},
                          A, B);
}

void Pipeline::countPairs() {
  const Sorter::Share By = Sort.share(F.Visible);
  F.Ordered = words("tile rectangles", 2 * uint64_t{F.Visible});
  F.Sums = words("sums of pairs", By.items());
  L.run(TilesProgram, "count_tiles", By.items(), By.Lanes, F.Order,
        F.Rectangles, F.Ordered, F.Sums, F.Visible, By.Chunk);
}

void Pipeline::duplicate() {
  const Sorter::Share By = Sort.share(F.Visible);
  F.ByTile = {words("tiles of pairs", F.Pairs),
              words("Gaussians of pairs", F.Pairs)};
  F.Places =
      words("places of pairs", Options.Training ? uint64_t{F.Visible} + 1 : 1);
  L.run(TilesProgram, "duplicate", By.items(), By.Lanes, F.Order, F.Ordered,
        F.Sums, F.ByTile.Keys, F.ByTile.Values, F.Places, F.Visible, By.Chunk,
        F.View.tiles[0], F.View.effects);
}

void Pipeline::sortByTile() {
  const Sorter::Pairs Other{words("tiles of pairs", F.Pairs),
                            words("Gaussians of pairs", F.Pairs)};
  const Sorter::KeyBits Bits{
      0, static_cast<unsigned>(std::bit_width(F.tiles() - 1))};
  if (Options.Training) {
    // Where a pair was is where its gradients go, beside those of its Gaussian.
    const cl::Buffer Entries = F.ByTile.Values;
    F.ByTile.Values = words("places of sorted pairs", F.Pairs);
    F.List = words("Gaussians of sorted pairs", F.Pairs);
    L.run(TilesProgram, "number", itemsFor(F.Pairs), GroupSize, F.ByTile.Values,
          F.Pairs);
    F.ByTile = Sort.sort(F.ByTile, F.ByTile, Other, F.Pairs, Bits);
    L.run(TilesProgram, "look_up", itemsFor(F.Pairs), GroupSize,
          F.ByTile.Values, Entries, F.List, F.Pairs);
  } else {
    F.ByTile = Sort.sort(F.ByTile, F.ByTile, Other, F.Pairs, Bits);
    F.List = F.ByTile.Values;
  }
  F.Ranges = words("tile ranges", 2 * uint64_t{F.tiles()});
  L.run(TilesProgram, "tile_ranges", itemsFor(F.tiles()), GroupSize,
        F.ByTile.Keys, F.Ranges, F.Pairs, F.tiles());
}

void Pipeline::blend() {
  if (Options.Blending == Path::Simt)
    return shade();
  prepareRasterizers();
  L.run(BlendProgram, "rasterize", L.device().computeUnits() * Lanes, Lanes,
        F.Records, F.List, F.Ranges, F.TileOrder, F.Parts, F.Last, F.Tails,
        F.Statuses, blendOptions());
  endBlending();
}

void Pipeline::allocatePixels() {
  F.Pixels = L.allocate("pixels", 16 * uint64_t{F.pixels()});
  F.Last = words("last contributors", Options.Training ? F.pixels() : 1);
}

cl::Buffer Pipeline::drawDepths() {
  L.run(DepthProgram, "depths_for_colors", itemsFor(F.Gaussians.Count),
        GroupSize, F.Depths.Keys, F.Records, F.Gaussians.Count);
  const cl::Buffer Picture = F.Pixels;
  blend();
  return std::exchange(F.Pixels, Picture);
}

void Pipeline::shade() {
  allocatePixels();
  const std::size_t Group = Options.SimtGroup;
  L.run(BlendProgram, "blend",
        cl::NDRange(F.View.tiles[0] * Group, F.View.tiles[1]),
        cl::NDRange(Group, 1), F.Records, F.List, F.Ranges, F.Pixels, F.Last,
        F.View.size[0], F.View.size[1], Options.Cutoff, F.View.effects);
}

splat_blend_options Pipeline::blendOptions() const {
  const TailRule &Tail = Options.PixelUnit;
  splat_blend_options O{};
  O.size[0] = F.View.size[0];
  O.size[1] = F.View.size[1];
  O.tiles_x = F.View.tiles[0];
  O.tiles = F.tiles();
  O.parts = Options.ZTiles;
  O.cutoff = Options.Cutoff;
  O.datapath =
      static_cast<unsigned>(Options.Exponential) << DATAPATH_EXP |
      static_cast<unsigned>(Options.Arithmetic) << DATAPATH_BLEND |
      static_cast<unsigned>(std::countr_zero(Options.AlphaCutoff))
          << DATAPATH_ALPHA_CUTOFF |
      (Options.Convention == Rules::Gsplat ? DATAPATH_STOP_AT_EQUAL : 0U) |
      (Options.SkipSaturated ? DATAPATH_SKIP_SATURATED : 0U);
  O.tail_count = Tail.Count;
  O.tail_last[0] = Tail.LastOver;
  O.tail_last[1] = Tail.LastUnder;
  O.tail_share = Tail.shareBits();
  O.effects = Plan.flags();
  return O;
}

void Pipeline::prepareRasterizers() {
  allocatePixels();
  F.Parts = F.Pixels;
  if (Plan.done(effects::ZTiles))
    F.Parts =
        L.allocate("depth parts", 16 * uint64_t{F.pixels()} * Options.ZTiles);
  F.TileOrder = words("tile order", F.tiles());
  F.Statuses = words("cores' statuses", L.device().computeUnits());
  F.Tails = L.allocate("hand-over records",
                       Plan.done(effects::PixelUnit)
                           ? uint64_t{TAIL_BYTES} * Options.ZTiles * F.tiles()
                           : TAIL_BYTES);
  L.run(TilesProgram, "order_tiles", itemsFor(F.tiles()), GroupSize, F.Ranges,
        F.TileOrder, F.tiles());
}

void Pipeline::startBlending() {
  L.run(BlendProgram, "rasterize_start", L.device().computeUnits() * Lanes,
        Lanes, F.Records, F.List, F.Ranges, F.TileOrder, F.Parts, F.Last,
        F.Tails, blendOptions());
}

void Pipeline::waitForBlending() {
  L.run(BlendProgram, "rasterize_wait", L.device().computeUnits() * Lanes,
        Lanes, F.Statuses);
}

void Pipeline::endBlending() {
  if (Plan.done(effects::ZTiles))
    L.run(MergeProgram, "merge", itemsFor(F.pixels()), GroupSize, F.Parts,
          F.Pixels, F.pixels(), Options.ZTiles);
  checkStatuses(F.Statuses);
}

void Pipeline::checkStatuses(const cl::Buffer &Statuses) {
  std::vector<uint32_t> Host(L.device().computeUnits(), 0);
  L.read("cores' statuses", Host.data(), Statuses, 4 * Host.size());
  for (std::size_t C = 0; C < Host.size(); ++C)
    if (Host[C] != 0)
      L.fail(
          {"",
           fmt::format("the rasterizer refused a tile of core {} with status "
                       "code {}, expected 0 (codes: docs/isa.md)",
                       C, Host[C]),
           ExitCode::Trap});
}

} // namespace vorion::splat
