/// Writes tiles for test/rtl to standard output, with the pixels that the
/// simulator makes of them (exponential unit "table", fp32) and the cycles that
/// its clock gives them, where memory answers after a fixed time: those of the
/// tests, or of a file that the plugin tile-writer wrote.
#include "raster/Backward.h"
#include "raster/RandomScene.h"
#include "raster/Surfaces.h"
#include "testing/LoneRasterizer.h"
#include "testing/RasterTile.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Tool.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

using namespace vorion;
using namespace vorion::isasim;
using raster::columnOf, raster::rowOf;

namespace {

/// The memory of a tile.
LoneMemory memoryOf(const RasterTile &T) {
  const size_t Bytes = T.Input.size() * sizeof(T.Input[0]);
  LoneMemory M(RasterTile::Records + Bytes);
  for (uint32_t N = 0; N != T.What.Gaussians; ++N)
    std::memcpy(M.range(RasterTile::List + 4 * N, 4), &N, 4);
  if (Bytes != 0)
    std::memcpy(M.range(RasterTile::Records, Bytes), T.Input.data(), Bytes);
  return M;
}

/// The simulator's pixels; returns what the rasterizer did.
raster::CommandWork render(RasterTile &T) {
  using raster::Csr, raster::OptionsExp, raster::TileOriginX,
      raster::TileOriginY, raster::TileShapeHeight, raster::TileShapeWidth;
  LoneMemory M = memoryOf(T);
  LoneRasterizer Unit(M);
  const RasterTile::Head &W = T.What;
  if (W.Primitive == raster::VR_PRIMITIVE_TRIANGLE) {
    Unit.set(Csr::Mode, raster::ModePrimitive.put(W.Primitive));
    Unit.set(Csr::Index, raster::VR_WORD_DEPTH);
    Unit.set(Csr::Word, W.Depth);
    Unit.set(Csr::Index, raster::VR_WORD_DEPTH_CLEAR);
    Unit.set(Csr::Word, std::bit_cast<uint32_t>(W.ClearDepth));
  } else {
    Unit.set(Csr::Options, OptionsExp.put(raster::VR_EXP_TABLE));
  }
  Unit.set(Csr::Cutoff, std::bit_cast<uint32_t>(W.Cutoff));
  Unit.set(Csr::Gaussians, RasterTile::Records);
  Unit.set(Csr::List, RasterTile::List);
  Unit.set(Csr::Count, W.Gaussians);
  Unit.set(Csr::TileOrigin, TileOriginX.put(W.X) | TileOriginY.put(W.Y));
  Unit.set(Csr::TileShape,
           TileShapeWidth.put(W.Width) | TileShapeHeight.put(W.Height));
  Unit.set(Csr::Output, RasterTile::Target);
  Unit.set(Csr::OutputPitch, RasterTile::Pitch);
  raster::CommandWork Work = Unit.run();
  const uint32_t RowBytes = W.Width * T.pixelBytes();
  T.Output.resize(size_t{W.Height} * RowBytes / 4);
  for (uint32_t Row = 0; Row != W.Height; ++Row)
    std::memcpy(&T.Output[size_t{Row} * RowBytes / 4],
                M.range(RasterTile::Target + Row * RasterTile::Pitch, RowBytes),
                RowBytes);
  return Work;
}

/// False if it is no tile that a rasterizer takes.
bool judge(RasterTile &T, uint32_t Latency) {
  RasterTile::Head &W = T.What;
  raster::CommandWork Work = render(T);
  if (Work.hasFailed())
    return false;
  W.Pixels = W.Width * W.Height;
  W.Latency = Latency;
  W.Fragments = static_cast<uint32_t>(Work.Counts.Fragments);
  W.Blends = static_cast<uint32_t>(Work.Counts.Blends);
  const RasterTime Time = timeAlone(std::move(Work), Latency);
  const auto Of = [&](RasterCycle C) {
    W.Cycles += static_cast<uint32_t>(Time.Cycles[size_t(C)]);
    return static_cast<uint32_t>(Time.Cycles[size_t(C)]);
  };
  W.Cycles = 0;
  W.Begin = Of(RasterCycle::Begin);
  W.Fetch = Of(RasterCycle::Fetch);
  W.Clip = Of(RasterCycle::Clip);
  W.Blend = Of(RasterCycle::Blend);
  W.Hazard = Of(RasterCycle::Hazard);
  W.Flush = Of(RasterCycle::Flush);
  W.Drain = Of(RasterCycle::Drain);
  return true;
}

template <typename Record>
RasterTile tileOf(const char *Name, const std::vector<Record> &All, unsigned X,
                  unsigned Y, unsigned Width, unsigned Height, float Cutoff) {
  RasterTile T;
  std::snprintf(T.What.Name.data(), T.What.Name.size(), "%s", Name);
  T.What.X = X;
  T.What.Y = Y;
  T.What.Width = Width;
  T.What.Height = Height;
  T.What.Cutoff = Cutoff;
  T.What.Gaussians = static_cast<uint32_t>(All.size());
  if constexpr (std::is_same_v<Record, raster::Triangle>)
    T.What.Primitive = raster::VR_PRIMITIVE_TRIANGLE;
  const size_t Bytes = All.size() * sizeof(Record);
  T.Input.resize(Bytes / 4);
  if (Bytes != 0)
    std::memcpy(T.Input.data(), All.data(), Bytes);
  return T;
}

/// \p Count Gaussians whose boxes have \p Width x \p Height pixels, each \p
/// Step columns on from the last.
std::vector<raster::Gaussian> boxes(unsigned Count, float Width, float Height,
                                    unsigned Step) {
  std::vector<raster::Gaussian> All;
  for (unsigned N = 0; N != Count; ++N)
    All.push_back(
        {{static_cast<float>(N * Step % 64) + Width / 2, Height / 2 + 8},
         {0.05F, 0.01F, 0.04F},
         0.02F,
         {0.9F, 0.5F, 0.1F},
         {(Width - 1) / 2, (Height - 1) / 2},
         0});
  return All;
}

/// Triangles whose box has \p Width x \p Height pixels, each \p Step columns on
/// from the last, and which cover half of it.
std::vector<raster::Triangle> halves(unsigned Count, unsigned Width,
                                     unsigned Height, unsigned Step) {
  std::vector<raster::Triangle> All;
  for (uint32_t N = 0; N != Count; ++N) {
    const uint32_t X = N * Step % 64;
    raster::Triangle T{};
    // Above the diagonal that begins at the box's first pixel.
    T.A[0] = static_cast<int32_t>(Height);
    T.B[0] = -static_cast<int32_t>(Width);
    T.CLow[0] = 0U - Height * X;
    T.CHigh[0] = T.CLow[0] == 0 ? 0 : -1;
    T.Depth = static_cast<float>(N % 7);
    T.DepthStep[0] = 0.25F;
    T.First = X;
    T.Last = (X + Width - 1) | (Height - 1) << 16;
    T.Tag = N;
    All.push_back(T);
  }
  return All;
}

/// A tile of any shape and edges of any size through it; some miss it.
RasterTile randomTriangles(uint32_t Seed) {
  std::mt19937_64 Engine(Seed);
  const auto Below = [&](uint64_t End) {
    return static_cast<unsigned>(Engine() % End);
  };
  // As many small ones as large ones.
  const auto Number = [&](unsigned Bits) {
    return static_cast<int64_t>(Engine()) >> (63 - Below(Bits));
  };
  const unsigned X = Below(2000), Y = Below(2000), Width = 1 + Below(64),
                 Height = 1 + Below(64);
  const auto Depth = [&] {
    return static_cast<float>(Number(20)) / static_cast<float>(1U << Below(20));
  };
  std::vector<raster::Triangle> All(Below(300));
  for (raster::Triangle &T : All) {
    const unsigned Bits = Below(2) ? 18 : 32;
    for (unsigned Edge = 0; Edge != 3; ++Edge) {
      const int64_t A = Number(Bits), B = Number(Bits);
      const int64_t C = Below(8) ? Number(16) - A * (X + Below(Width)) -
                                       B * (Y + Below(Height))
                                 : Number(60);
      T.A[Edge] = static_cast<int32_t>(A);
      T.B[Edge] = static_cast<int32_t>(B);
      T.CLow[Edge] = static_cast<uint32_t>(C);
      T.CHigh[Edge] = static_cast<int32_t>(C >> 32);
    }
    T.Depth = Depth();
    T.DepthStep[0] = Depth();
    T.DepthStep[1] = Depth();
    const unsigned Left = X + Below(80), Top = Y + Below(80),
                   Side = 1 + Below(Below(4) ? 8 : 70);
    T.First = (Left < 16 ? 0 : Left - 16) | (Top < 16 ? 0 : Top - 16) << 16;
    T.Last = (columnOf(T.First) + Below(Side)) | (rowOf(T.First) + Below(Side))
                                                     << 16;
    T.Tag = Below(1 << 20);
  }
  std::array<char, 32> Name{};
  std::snprintf(Name.data(), Name.size(), "random triangles %u", Seed);
  RasterTile T = tileOf(Name.data(), All, X, Y, Width, Height, 0);
  T.What.Depth = raster::DepthFunction.put(Seed % 8) |
                 raster::DepthWrite.put(Seed % 7 != 3);
  T.What.ClearDepth = Seed % 3 ? 0 : Depth();
  return T;
}

/// Closed forms of RasterClock_test.cpp, and random scenes of Scenes_test.cpp.
/// Commands of triangles stand among those of Gaussians.
std::vector<RasterTile> testTiles() {
  std::vector<RasterTile> All;
  const auto Whole = [&](const char *Name,
                         const std::vector<raster::Gaussian> &G) {
    All.push_back(tileOf(Name, G, 0, 0, 64, 64, 1e-4F));
  };
  Whole("nothing", {});
  Whole("one of 64 x 56", boxes(1, 64, 56, 0));
  Whole("one pixel 300 times", boxes(300, 1, 1, 0));
  Whole("300 pixels", boxes(300, 1, 1, 1));
  Whole("300 of 5 x 10", boxes(300, 5, 10, 3));
  Whole("300 of 7 x 3", boxes(300, 7, 3, 2));
  Whole("300 of 2 x 2 at one place", boxes(300, 2, 2, 0));
  std::vector<raster::Gaussian> Missing = boxes(300, 4, 4, 1);
  for (raster::Gaussian &G : Missing)
    G.Mean[1] = 200;
  Whole("300 that miss", Missing);
  std::vector<raster::Gaussian> Opaque = boxes(40, 64, 64, 0);
  for (raster::Gaussian &G : Opaque) {
    G.Mean[1] = 32;
    G.Conic[0] = G.Conic[1] = G.Conic[2] = 0;
    G.Opacity = 0.9F;
  }
  Whole("40 that close it", Opaque);
  // Boxes of a few pixels that overlap in part.
  std::mt19937 Engine(1);
  const auto From = [&](unsigned Low, unsigned High) {
    return static_cast<float>(Low + Engine() % (High - Low));
  };
  std::vector<raster::Gaussian> Small = boxes(600, 1, 1, 0);
  for (raster::Gaussian &G : Small) {
    G.Mean[0] = From(20, 32);
    G.Mean[1] = From(20, 32);
    G.Extent[0] = From(0, 4);
    G.Extent[1] = From(0, 3);
  }
  Whole("600 small ones", Small);
  const auto Triangles = [&](const char *Name,
                             const std::vector<raster::Triangle> &T) {
    All.push_back(tileOf(Name, T, 0, 0, 64, 64, 0));
    // Nearer ones are larger.
    All.back().What.Depth =
        raster::DepthFunction.put(raster::VR_DEPTH_GREATER) |
        raster::DepthWrite.put(1);
  };
  Triangles("no triangle", {});
  Triangles("a triangle of 64 x 64", halves(1, 64, 64, 0));
  Triangles("a triangle's pixel 300 times", halves(300, 1, 1, 0));
  Triangles("300 triangles' pixels", halves(300, 1, 1, 1));
  Triangles("300 triangles of 5 x 10", halves(300, 5, 10, 3));
  Triangles("300 triangles of 2 x 2", halves(300, 2, 2, 0));
  for (uint32_t Seed = 0; Seed != 24; ++Seed) {
    All.push_back(randomTriangles(Seed));
    const raster::Scene S = raster::randomScene(Seed);
    std::array<char, 32> Name{};
    std::snprintf(Name.data(), Name.size(), "random %u", Seed);
    All.push_back(
        tileOf(Name.data(), S.Gaussians, S.X, S.Y, S.Width, S.Height,
               S.StopAtEqual ? std::nextafter(S.Cutoff, 1.0F) : S.Cutoff));
  }
  return All;
}

/// A tile of at most 2048 pixels of a random scene, whose pixels are at any
/// place of the list, with any gradient.
BackwardTile backwardTile(uint32_t Seed) {
  using namespace raster;
  Scene S = randomScene(Seed);
  S.Height = std::min(S.Height, VR_MAX_BACKWARD / VR_MAX_TILE);
  S.Gaussians.resize(std::min<size_t>(S.Gaussians.size(), 40));
  std::mt19937 Engine(Seed);
  const auto Uniform = [&](double Low, double High) {
    return static_cast<float>(Low + (High - Low) * Engine() / 0x1p32);
  };
  BackwardTile T;
  T.What = {S.X,
            S.Y,
            S.Width,
            S.Height,
            static_cast<uint32_t>(S.Gaussians.size()),
            Seed % 2};
  const auto Buffer = std::make_unique<BackwardBuffer>();
  Buffer->reset(S.X, S.Y, S.Width, S.Height);
  const auto Each = [&](auto &&Do) {
    for (unsigned Y = 0; Y != S.Height; ++Y)
      for (unsigned X = 0; X != S.Width; ++X)
        Do(Y * BackwardBuffer::Stride + X, Y);
  };
  Each([&](unsigned At, unsigned Row) {
    Buffer->R[At] = Uniform(-1, 1);
    Buffer->G[At] = Uniform(-1, 1);
    Buffer->B[At] = Uniform(-1, 1);
    Buffer->T[At] = std::exp2(Uniform(-140, 0));
    Buffer->Behind[At] = Uniform(-1, 1);
    Buffer->Last[At] = Engine() % (T.What.Gaussians + 1);
    Buffer->RowLast[Row] = std::max(Buffer->RowLast[Row], Buffer->Last[At]);
    const auto Bits = [](float F) { return std::bit_cast<uint32_t>(F); };
    T.Pixels.push_back({Bits(Buffer->R[At]), Bits(Buffer->G[At]),
                        Bits(Buffer->B[At]), Bits(Buffer->T[At]),
                        Bits(Buffer->Behind[At]), Buffer->Last[At]});
  });
  T.Sums.resize(S.Gaussians.size());
  BackwardOptions Options;
  Options.ClampStops = T.What.ClampStops;
  for (uint32_t Entry = T.What.Gaussians; Entry-- != 0;) {
    Options.Entry = Entry;
    GradientSums Sums;
    backwardDatapaths().front()->Conics[expRow(VR_EXP_TABLE)](
        S.Gaussians[Entry], Options, *Buffer, Sums);
    std::ranges::transform(
        std::span(Sums.Sums).first<9>(), T.Sums[Entry].begin(),
        [](float Sum) { return std::bit_cast<uint32_t>(Sum); });
  }
  Each([&](unsigned At, unsigned) {
    T.After.push_back({std::bit_cast<uint32_t>(Buffer->T[At]),
                       std::bit_cast<uint32_t>(Buffer->Behind[At])});
  });
  T.Gaussians.resize(S.Gaussians.size());
  if (!S.Gaussians.empty())
    std::memcpy(T.Gaussians.data(), S.Gaussians.data(),
                S.Gaussians.size() * sizeof(S.Gaussians[0]));
  return T;
}

int writeBackward(uint32_t Count) {
  for (uint32_t Seed = 0; Seed != Count; ++Seed)
    if (!backwardTile(Seed).write(stdout))
      return reportError("isasim-raster-tiles", {"", "cannot be written"});
  return 0;
}

struct Arguments {
  uint32_t Latency = 10;
  std::string File;
  uint64_t Random = 0, Seed = 1;
  uint32_t Backward = 0;
};

/// The tiles of \p A's file, those that it asks for.
std::vector<RasterTile> readTiles(const Arguments &A) {
  std::vector<RasterTile> Chosen;
  std::FILE *File = std::fopen(A.File.c_str(), "rb");
  std::mt19937_64 Engine(A.Seed);
  RasterTile T;
  for (uint64_t N = 0; File && T.read(File); ++N) {
    if (A.Random == 0 || Chosen.size() < A.Random) {
      Chosen.push_back(T);
      // Each of those so far with the same odds.
    } else if (const uint64_t Place = Engine() % (N + 1); Place < A.Random) {
      Chosen[Place] = T;
    }
  }
  if (File)
    std::fclose(File);
  return Chosen;
}

int run(const Arguments &A) {
  std::vector<RasterTile> All = A.File.empty() ? testTiles() : readTiles(A);
  if (All.empty())
    return reportError(
        "isasim-raster-tiles",
        {A.File,
         "has no tiles, expected output of the plugin isasim-tile-writer"});
  for (RasterTile &T : All)
    if (!judge(T, A.Latency) || !T.write(stdout))
      return reportError("isasim-raster-tiles",
                         {T.What.Name.data(),
                          "cannot be rendered or written, expected a tile "
                          "of the plugin isasim-tile-writer"});
  return 0;
}

} // namespace

int main(int Count, char **Values) {
  CLI::App App("Writes tiles with their pixels and cycles to standard output, "
               "as test vectors of the SystemVerilog rasterizer (docs/rtl.md): "
               "those of its tests, or those of a run.",
               "isasim-raster-tiles");
  App.footer(std::string(ExitCodeHelp));
  Arguments A;
  takesFile(App.add_option("file", A.File,
                           "Output of the plugin isasim-tile-writer (default: "
                           "the tiles of the tests)"));
  App.add_option("--latency", A.Latency,
                 "Memory latency in cycles (default 10)")
      ->check(isBetween(uint64_t{0}, uint64_t{1} << 20));
  App.add_option(
         "--random", A.Random,
         "Write N tiles of the file, sampled at random; all if it has fewer")
      ->check(isBetween(uint64_t{1}, uint64_t{1} << 20));
  App.add_option("--backward", A.Backward,
                 "Write N random tiles of the backward mode instead")
      ->check(isBetween(uint64_t{1}, uint64_t{1} << 20));
  App.add_option("--seed", A.Seed, "Seed of --random (default 1)")
      ->check(isBetween(uint64_t{0}, MostSeed));
  return runTool("isasim-raster-tiles", [&] {
    if (const auto Ended = parseCommandLine(App, {Values + 1, Values + Count}))
      return *Ended;
    return A.Backward ? writeBackward(A.Backward) : run(A);
  });
}
