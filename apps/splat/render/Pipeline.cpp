#include "Pipeline.h"

#include "../effects/Registry.h"
#include "Planes.h"
#include "View.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace vorion::splat {

using std::uint32_t;
using std::uint64_t;

static_assert(CullReasons.size() == CULL_REASONS);

cl::NDRange itemsFor(uint32_t Count) {
  return {(static_cast<std::size_t>(Count) + GroupSize - 1) / GroupSize *
          GroupSize};
}

namespace {

/// The coefficients of \p S that \p Plan evaluates, a plane each for channel 0,
/// 1, 2 of each coefficient; zeros where the scene has no such band.
std::vector<float> bandPlanes(const Scene &S, const EffectPlan &Plan) {
  const Effect *const Bands[] = {&effects::Sh1, &effects::Sh2, &effects::Sh3};
  std::vector<std::size_t> Sources{0, 1, 2};
  for (int Band = 1; Band <= MaxShDegree; ++Band)
    if (Plan.done(*Bands[Band - 1]))
      for (std::size_t P = 3 * shCoefficients(Band - 1);
           P < 3 * shCoefficients(Band); ++P)
        Sources.push_back(P);
  const std::size_t N = S.size();
  const std::size_t Stride = 3 * S.coefficients();
  std::vector<float> Out(Sources.size() * N);
  for (std::size_t I = 0; I < N; ++I)
    for (std::size_t P = 0; P < Sources.size(); ++P)
      if (Sources[P] < Stride)
        Out[P * N + I] = S.Sh[I * Stride + Sources[P]];
  return Out;
}

GaussianBuffers upload(Launcher &L, const Scene &S,
                       const std::vector<float> &Sh) {
  const std::vector<float> Geometry = geometryPlanes(S);
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
  return upload(L, S, shPlanes(S, ShDegree));
}

GaussianBuffers uploadGaussians(Launcher &L, const Scene &S,
                                const EffectPlan &Plan) {
  return upload(L, S, bandPlanes(S, Plan));
}

void Pipeline::draw(const GaussianBuffers &Gaussians, const Camera &C) {
  F = {};
  F.View = makeView(C, Options);
  F.View.effects = Plan.flags();
  F.Gaussians = Gaussians;
  L.beginStage("project");
  project();
  L.beginStage("sort by depth");
  sortByDepth();
  L.beginStage("count pairs");
  countPairs();
  L.beginStage("duplicate");
  duplicate();
  L.beginStage("sort by tile");
  sortByTile();
  L.beginStage("blend");
  blend();
}

void Pipeline::project() {
  F.Camera = L.allocate("camera", sizeof(F.View));
  L.write("camera", F.Camera, &F.View, sizeof(F.View));
  F.Records = L.allocate("projected Gaussians",
                         sizeof(splat_gaussian) * uint64_t{F.Gaussians.Count});
  F.Depths = {words("depths", F.Gaussians.Count),
              words("Gaussian numbers", F.Gaussians.Count)};
  F.Rectangles = words("tile rectangles", 2 * uint64_t{F.Gaussians.Count});
  L.run(ProjectProgram, "project", itemsFor(F.Gaussians.Count), GroupSize,
        F.Camera, F.Gaussians.Geometry, F.Gaussians.Sh, F.Records,
        F.Depths.Keys, F.Depths.Values, F.Rectangles, F.Gaussians.Count);
}

void Pipeline::sortByDepth() {
  const Sorter::Pairs A{words("sorted depths", F.Gaussians.Count),
                        words("sorted Gaussians", F.Gaussians.Count)};
  const Sorter::Pairs B{words("sorted depths", F.Gaussians.Count),
                        words("sorted Gaussians", F.Gaussians.Count)};
  // The highest bits: CULLED has the sign bit set and must end up last.
  F.ByDepth = Sort.sort(F.Depths, A, B, F.Gaussians.Count,
                        {32 - Options.DepthBits, 32});
}

void Pipeline::countPairs() {
  F.TileCounts = words("tile counts", F.Gaussians.Count);
  F.Places = words("places of pairs", uint64_t{F.Gaussians.Count} + 1);
  std::array<uint32_t, 2 + CULL_REASONS> Host{};
  const cl::Buffer Totals = words("totals", Host.size());
  L.run(TilesProgram, "count_tiles", itemsFor(F.Gaussians.Count), GroupSize,
        F.ByDepth.Values, F.Rectangles, F.TileCounts, F.Gaussians.Count);
  Sort.scan(F.TileCounts, F.Places, F.Gaussians.Count);
  L.run(TilesProgram, "totals", 1, 1, F.ByDepth.Keys, F.Places, Totals,
        F.Gaussians.Count);
  L.read("totals", Host.data(), Totals, sizeof(Host));
  F.Visible = Host[0];
  F.Pairs = Host[1];
  std::copy(Host.begin() + 2, Host.end(), F.Culled.begin());
}

void Pipeline::duplicate() {
  F.ByTile = {words("tiles of pairs", F.Pairs),
              words("Gaussians of pairs", F.Pairs)};
  L.run(TilesProgram, "duplicate", itemsFor(F.Gaussians.Count), GroupSize,
        F.ByDepth.Values, F.Rectangles, F.Places, F.ByTile.Keys,
        F.ByTile.Values, F.Gaussians.Count, F.View.tiles[0], F.View.effects);
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
  F.Pixels = L.allocate("pixels", 16 * uint64_t{F.pixels()});
  F.Last = words("last contributors", Options.Training ? F.pixels() : 1);
  if (Options.Blending == Path::Raster)
    rasterize();
  else
    shade();
}

void Pipeline::shade() {
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

void Pipeline::rasterize() {
  constexpr std::size_t Lanes = 16;
  const splat_blend_options O = blendOptions();
  const std::size_t Cores = L.device().computeUnits();
  F.TileOrder = words("tile order", F.tiles());
  const cl::Buffer Statuses = words("cores' statuses", Cores);
  const cl::Buffer Tails = L.allocate(
      "hand-over records", Plan.done(effects::PixelUnit)
                               ? uint64_t{TAIL_BYTES} * O.parts * O.tiles
                               : TAIL_BYTES);
  cl::Buffer Parts = F.Pixels;
  const bool Merged = Plan.done(effects::ZTiles);
  if (Merged)
    Parts = L.allocate("depth parts", 16 * uint64_t{F.pixels()} * O.parts);
  L.run(TilesProgram, "order_tiles", itemsFor(F.tiles()), GroupSize, F.Ranges,
        F.TileOrder, F.tiles());
  L.run(BlendProgram, "rasterize", Cores * Lanes, Lanes, F.Records, F.List,
        F.Ranges, F.TileOrder, Parts, F.Last, Tails, Statuses, O);
  if (Merged)
    L.run(MergeProgram, "merge", itemsFor(F.pixels()), GroupSize, Parts,
          F.Pixels, F.pixels(), O.parts);
  checkStatuses(Statuses);
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
