#include "Renderer.h"

#include "Sorter.h"
#include "View.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <limits>

namespace vorion::splat {

namespace {

using std::uint32_t;
using std::uint64_t;

static_assert(CullReasons.size() == CULL_REASONS);

/// Work-items of a group where the kernel has no say.
constexpr uint32_t GroupSize = 64;

cl::NDRange itemsFor(uint32_t Count) {
  return {(static_cast<std::size_t>(Count) + GroupSize - 1) / GroupSize *
          GroupSize};
}

/// Planes of layout.h's GEOMETRY_PLANES.
std::vector<float> geometryPlanes(const Scene &S) {
  const std::size_t N = S.size();
  std::vector<float> Planes(GEOMETRY_PLANES * N);
  for (std::size_t I = 0; I < N; ++I) {
    for (std::size_t K = 0; K < 3; ++K) {
      Planes[(PLANE_MEAN + K) * N + I] = S.Means[3 * I + K];
      Planes[(PLANE_LOG_SCALE + K) * N + I] = S.LogScales[3 * I + K];
    }
    for (std::size_t K = 0; K < 4; ++K)
      Planes[(PLANE_QUATERNION + K) * N + I] = S.Quats[4 * I + K];
    Planes[PLANE_LOGIT * N + I] = S.OpacityLogits[I];
  }
  return Planes;
}

/// Plane 3 k + c holds coefficient k of channel c, up to \p Degree.
std::vector<float> shPlanes(const Scene &S, int Degree) {
  const std::size_t N = S.size();
  const std::size_t Planes = 3 * shCoefficients(Degree);
  const std::size_t Stride = 3 * S.coefficients();
  std::vector<float> Out(Planes * N);
  for (std::size_t I = 0; I < N; ++I)
    for (std::size_t P = 0; P < Planes; ++P)
      Out[P * N + I] = S.Sh[I * Stride + P];
  return Out;
}

/// The buffers of one picture, in the order in which they are filled.
class Pipeline {
public:
  Pipeline(Launcher &Launch, const Scene &Input, const Camera &C,
           const RenderOptions &O)
      : L(Launch), S(Input), Options(O), View(makeView(C, O)), Sort(Launch),
        Count(static_cast<uint32_t>(Input.size())) {}

  void upload(int ShDegree);
  void project();
  void sortByDepth();
  /// Counts tiles, and reads back how many pairs there will be.
  void countPairs();
  void duplicate();
  void sortByTile();
  void blend();
  void resolve(const std::array<float, 3> &Background);
  RenderResult result(bool KeepPairs);

private:
  uint32_t tiles() const { return View.tiles[0] * View.tiles[1]; }
  uint32_t pixels() const { return View.size[0] * View.size[1]; }
  cl::Buffer words(std::string_view What, uint64_t N) {
    return L.allocate(What, 4 * N);
  }
  Sorter::Pairs pairs(uint64_t N) {
    return {words("keys to sort", N), words("values to sort", N)};
  }
  splat_blend_options blendOptions() const;
  void rasterize();
  void shade();

  Launcher &L;
  const Scene &S;
  const RenderOptions &Options;
  splat_view View;
  Sorter Sort;
  uint32_t Count;

  cl::Buffer ViewBuffer, Geometry, Sh, Records, Rectangles;
  cl::Buffer TileCounts, Places;
  Sorter::Pairs Depths; ///< of every Gaussian, as projected
  Sorter::Pairs ByDepth;
  Sorter::Pairs ByTile;
  uint32_t Visible = 0, Pairs = 0;
  std::array<uint64_t, CullReasons.size()> Culled{};
  cl::Buffer Ranges, Pixels, Picture;
};

void Pipeline::upload(int ShDegree) {
  const std::vector<float> GeometryData = geometryPlanes(S);
  const std::vector<float> ShData = shPlanes(S, ShDegree);
  ViewBuffer = L.allocate("camera", sizeof(View));
  Geometry = words("Gaussians' geometry", GeometryData.size());
  Sh = words("Gaussians' colours", ShData.size());
  L.write("camera", ViewBuffer, &View, sizeof(View));
  L.write("Gaussians", Geometry, GeometryData.data(), 4 * GeometryData.size());
  L.write("colours", Sh, ShData.data(), 4 * ShData.size());
}

void Pipeline::project() {
  Records = L.allocate("projected Gaussians",
                       sizeof(splat_gaussian) * uint64_t{Count});
  Depths = {words("depths", Count), words("Gaussian numbers", Count)};
  Rectangles = words("tile rectangles", 2 * uint64_t{Count});
  L.run(ProjectProgram, "project", itemsFor(Count), GroupSize, ViewBuffer,
        Geometry, Sh, Records, Depths.Keys, Depths.Values, Rectangles, Count);
}

void Pipeline::sortByDepth() {
  const Sorter::Pairs A{words("sorted depths", Count),
                        words("sorted Gaussians", Count)};
  const Sorter::Pairs B{words("sorted depths", Count),
                        words("sorted Gaussians", Count)};
  // The highest bits: CULLED has the sign bit set and must end up last.
  ByDepth = Sort.sort(Depths, A, B, Count, {32 - Options.DepthBits, 32});
}

void Pipeline::countPairs() {
  TileCounts = words("tile counts", Count);
  Places = words("places of pairs", uint64_t{Count} + 1);
  std::array<uint32_t, 2 + CULL_REASONS> Host{};
  const cl::Buffer Totals = words("totals", Host.size());
  L.run(TilesProgram, "count_tiles", itemsFor(Count), GroupSize, ByDepth.Values,
        Rectangles, TileCounts, Count);
  Sort.scan(TileCounts, Places, Count);
  L.run(TilesProgram, "totals", 1, 1, ByDepth.Keys, Places, Totals, Count);
  L.read("totals", Host.data(), Totals, sizeof(Host));
  Visible = Host[0];
  Pairs = Host[1];
  std::copy(Host.begin() + 2, Host.end(), Culled.begin());
}

void Pipeline::duplicate() {
  ByTile = {words("tiles of pairs", Pairs), words("Gaussians of pairs", Pairs)};
  L.run(TilesProgram, "duplicate", itemsFor(Count), GroupSize, ByDepth.Values,
        Rectangles, Places, ByTile.Keys, ByTile.Values, Count, View.tiles[0]);
}

void Pipeline::sortByTile() {
  const Sorter::Pairs Other{words("tiles of pairs", Pairs),
                            words("Gaussians of pairs", Pairs)};
  ByTile = Sort.sort(ByTile, ByTile, Other, Pairs,
                     {0, static_cast<unsigned>(std::bit_width(tiles() - 1))});
  Ranges = words("tile ranges", 2 * uint64_t{tiles()});
  L.run(TilesProgram, "tile_ranges", itemsFor(tiles()), GroupSize, ByTile.Keys,
        Ranges, Pairs, tiles());
}

void Pipeline::blend() {
  Pixels = L.allocate("pixels", 16 * uint64_t{pixels()});
  if (Options.Blending == Path::Raster)
    rasterize();
  else
    shade();
}

void Pipeline::shade() {
  const std::size_t Group = Options.SimtGroup;
  L.run(BlendProgram, "blend",
        cl::NDRange(View.tiles[0] * Group, View.tiles[1]),
        cl::NDRange(Group, 1), Records, ByTile.Values, Ranges, Pixels,
        View.size[0], View.size[1], Options.Cutoff);
}

splat_blend_options Pipeline::blendOptions() const {
  const TailRule &Tail = Options.PixelUnit;
  splat_blend_options O{};
  O.size[0] = View.size[0];
  O.size[1] = View.size[1];
  O.tiles_x = View.tiles[0];
  O.tiles = tiles();
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
  return O;
}

void Pipeline::rasterize() {
  constexpr std::size_t Lanes = 16;
  const splat_blend_options O = blendOptions();
  const std::size_t Cores = L.device().computeUnits();
  const cl::Buffer TileOrder = words("tile order", tiles());
  const cl::Buffer Statuses = words("cores' statuses", Cores);
  const cl::Buffer Tails = L.allocate(
      "hand-over records", Options.PixelUnit.any()
                               ? uint64_t{TAIL_BYTES} * O.parts * O.tiles
                               : TAIL_BYTES);
  cl::Buffer Parts = Pixels;
  if (O.parts > 1)
    Parts = L.allocate("depth parts", 16 * uint64_t{pixels()} * O.parts);
  L.run(TilesProgram, "order_tiles", itemsFor(tiles()), GroupSize, Ranges,
        TileOrder, tiles());
  L.run(BlendProgram, "rasterize", Cores * Lanes, Lanes, Records, ByTile.Values,
        Ranges, TileOrder, Parts, Tails, Statuses, O);
  if (O.parts > 1)
    L.run(MergeProgram, "merge", itemsFor(pixels()), GroupSize, Parts, Pixels,
          pixels(), O.parts);
  std::vector<uint32_t> Host(Cores, 0);
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

void Pipeline::resolve(const std::array<float, 3> &Background) {
  Picture = L.allocate("picture", 16 * uint64_t{pixels()});
  L.run(ResolveProgram, "resolve", itemsFor(pixels()), GroupSize, Pixels,
        Picture, pixels(), Background[0], Background[1], Background[2]);
}

RenderResult Pipeline::result(bool KeepPairs) {
  RenderResult R;
  R.Visible = Visible;
  R.Pairs = Pairs;
  R.Culled = Culled;
  R.Picture.Width = static_cast<int>(View.size[0]);
  R.Picture.Height = static_cast<int>(View.size[1]);
  std::vector<float> Rgba(4 * std::size_t{pixels()});
  L.read("picture", Rgba.data(), Picture, 4 * Rgba.size());
  R.Picture.Render.resize(3 * std::size_t{pixels()});
  R.Picture.Alpha.resize(pixels());
  for (std::size_t I = 0; I < pixels(); ++I) {
    for (std::size_t K = 0; K < 3; ++K)
      R.Picture.Render[3 * I + K] = Rgba[4 * I + K];
    R.Picture.Alpha[I] = Rgba[4 * I + 3];
  }
  if (KeepPairs) {
    SortedPairs P;
    P.Tiles.resize(Pairs);
    P.Gaussians.resize(Pairs);
    std::vector<uint32_t> Bits(Count);
    L.read("tiles of pairs", P.Tiles.data(), ByTile.Keys, 4 * uint64_t{Pairs});
    L.read("Gaussians of pairs", P.Gaussians.data(), ByTile.Values,
           4 * uint64_t{Pairs});
    L.read("depths", Bits.data(), Depths.Keys, 4 * uint64_t{Count});
    P.DepthBits.reserve(Pairs);
    for (uint32_t &G : P.Gaussians) {
      G &= ~SPANS_TILES;
      P.DepthBits.push_back(Bits[G]);
    }
    R.Sorted = std::move(P);
  }
  return R;
}

} // namespace

Expected<RenderResult> render(Launcher &L, const RenderPlan &Plan,
                              const Scene &S, const Camera &C,
                              const RenderOptions &Options, bool KeepPairs) {
  if (S.size() > std::numeric_limits<std::int32_t>::max())
    return Error{"", "more than 2^31 - 1 Gaussians, whose numbers have 31 bits",
                 ExitCode::LimitReached};
  L.beginStage("build");
  for (const ProgramSpec &Program : Plan.Programs)
    L.build(Program);

  L.beginStage("upload");
  Pipeline P(L, S, C, Options);
  P.upload(Plan.ShDegree);
  L.beginStage("project");
  P.project();
  L.beginStage("sort by depth");
  P.sortByDepth();
  L.beginStage("count pairs");
  P.countPairs();
  if (L.failure())
    return *L.failure();
  L.beginStage("duplicate");
  P.duplicate();
  L.beginStage("sort by tile");
  P.sortByTile();
  L.beginStage("blend");
  P.blend();
  L.beginStage("resolve");
  P.resolve(Options.Background);
  L.beginStage("read back");
  RenderResult R = P.result(KeepPairs);
  if (L.failure())
    return *L.failure();
  R.DeviceBytes = L.allocatedBytes();
  R.Stages = L.takeStages();
  return R;
}

} // namespace vorion::splat
