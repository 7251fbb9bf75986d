/// Writes tiles for test/rtl to standard output, with the pixels that the
/// simulator makes of them (exponential unit "table", fp32) and the cycles that
/// its clock gives them, where memory answers after a fixed time: those of the
/// tests, or of a file that the plugin tile-writer wrote.
#include "raster/RandomScene.h"
#include "raster/Rasterizer.h"
#include "testing/RasterTile.h"
#include "timing/raster/RasterClock.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Tool.h"

#include <bit>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

using namespace vorion;
using namespace vorion::isasim;

namespace {

/// All of a tile's memory, from address 0.
class Memory : public raster::RasterMemory {
public:
  explicit Memory(const RasterTile &T) : Words(bytesOf(T) / sizeof(Word)) {
    for (uint32_t N = 0; N != T.Gaussians.size(); ++N) {
      std::memcpy(range(RasterTile::List + 4 * N, 4), &N, 4);
      std::memcpy(range(RasterTile::Records + sizeof(T.Gaussians[N]) * N,
                        sizeof(T.Gaussians[N])),
                  &T.Gaussians[N], sizeof(T.Gaussians[N]));
    }
  }
  std::byte *range(uint32_t Address, uint64_t Bytes) override {
    return Address + Bytes > Words.size() * sizeof(Word)
               ? nullptr
               : reinterpret_cast<std::byte *>(Words.data()) + Address;
  }

private:
  struct alignas(64) Word {
    std::array<std::byte, 64> Bytes;
  };
  static size_t bytesOf(const RasterTile &T) {
    return RasterTile::Records + T.Gaussians.size() * 48 + 64;
  }
  std::vector<Word> Words;
};

class Log : public raster::WorkLog {
public:
  void command(raster::CommandWork &&Done) override {
    Earlier.insert(Earlier.end(), Done.Gaussians.begin(), Done.Gaussians.end());
    Done.Gaussians = std::move(Earlier);
    Work = std::move(Done);
  }
  void tail(raster::TailWork &&) override {}
  bool wantsFetches() const override { return true; }
  void part(const raster::CommandWork &,
            std::vector<raster::GaussianWork> &&Fetched) override {
    Earlier.insert(Earlier.end(), Fetched.begin(), Fetched.end());
  }
  raster::CommandWork Work; ///< the last, with all of its Gaussians

private:
  std::vector<raster::GaussianWork> Earlier;
};

/// The simulator's pixels; returns what the rasterizer did.
raster::CommandWork render(RasterTile &T) {
  using raster::Csr, raster::OptionsExp, raster::TileOriginX,
      raster::TileOriginY, raster::TileShapeHeight, raster::TileShapeWidth;
  Memory M(T);
  raster::RasterAgent Agent;
  raster::Rasterizer Unit(M, {&Agent});
  Log Told;
  Unit.setLog(&Told);
  const auto Set = [&](Csr C, uint32_t Value) {
    Agent.write(C, std::span(&Value, 1), 1);
  };
  const RasterTile::Head &W = T.What;
  Set(Csr::Options, OptionsExp.put(raster::VR_EXP_TABLE));
  Set(Csr::Cutoff, std::bit_cast<uint32_t>(W.Cutoff));
  Set(Csr::Gaussians, RasterTile::Records);
  Set(Csr::List, RasterTile::List);
  Set(Csr::Count, W.Gaussians);
  Set(Csr::TileOrigin, TileOriginX.put(W.X) | TileOriginY.put(W.Y));
  Set(Csr::TileShape,
      TileShapeWidth.put(W.Width) | TileShapeHeight.put(W.Height));
  Set(Csr::Output, RasterTile::Target);
  Set(Csr::OutputPitch, RasterTile::Pitch);
  Set(Csr::Start, 1);
  Unit.finish(Agent);
  for (uint32_t Row = 0; Row != W.Height; ++Row)
    for (uint32_t Column = 0; Column != W.Width; ++Column)
      std::memcpy(
          &T.Pixels.emplace_back(),
          M.range(RasterTile::Target + Row * RasterTile::Pitch + Column * 16,
                  16),
          16);
  return Told.Work;
}

RasterTime timeOf(raster::CommandWork &&Work, uint32_t Latency) {
  TimingConfig P;
  P.L2.FixedCycles = Latency;
  MemorySystem M(P, 1);
  RasterClock Clock(P, MemoryPort(), 1, 4);
  Clock.begin(0);
  Clock.expect(0, std::move(Work));
  Clock.start(0, 0);
  while (Clock.turn().At != Turn::Never)
    Clock.step(M);
  Clock.end(Clock.freeAt());
  return Clock.time();
}

/// False if it is no tile that a rasterizer takes.
bool judge(RasterTile &T, uint32_t Latency) {
  RasterTile::Head &W = T.What;
  T.Pixels.clear();
  raster::CommandWork Work = render(T);
  if (Work.hasFailed())
    return false;
  W.Gaussians = static_cast<uint32_t>(T.Gaussians.size());
  W.Pixels = static_cast<uint32_t>(T.Pixels.size());
  W.Latency = Latency;
  W.Fragments = static_cast<uint32_t>(Work.Counts.Fragments);
  W.Blends = static_cast<uint32_t>(Work.Counts.Blends);
  const RasterTime Time = timeOf(std::move(Work), Latency);
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

RasterTile tileOf(const char *Name, const std::vector<raster::Gaussian> &All,
                  unsigned X, unsigned Y, unsigned Width, unsigned Height,
                  float Cutoff) {
  RasterTile T;
  std::snprintf(T.What.Name.data(), T.What.Name.size(), "%s", Name);
  T.What.X = X;
  T.What.Y = Y;
  T.What.Width = Width;
  T.What.Height = Height;
  T.What.Cutoff = Cutoff;
  T.What.Gaussians = static_cast<uint32_t>(All.size());
  static_assert(sizeof(raster::Gaussian) == sizeof(T.Gaussians[0]));
  T.Gaussians.resize(All.size());
  if (!All.empty())
    std::memcpy(T.Gaussians.data(), All.data(),
                All.size() * sizeof(raster::Gaussian));
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

/// Closed forms of RasterClock_test.cpp, and random scenes of Scenes_test.cpp.
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
  for (uint32_t Seed = 0; Seed != 24; ++Seed) {
    const raster::Scene S = raster::randomScene(Seed);
    std::array<char, 32> Name{};
    std::snprintf(Name.data(), Name.size(), "random %u", Seed);
    All.push_back(
        tileOf(Name.data(), S.Gaussians, S.X, S.Y, S.Width, S.Height,
               S.StopAtEqual ? std::nextafter(S.Cutoff, 1.0F) : S.Cutoff));
  }
  return All;
}

struct Arguments {
  uint32_t Latency = 0;
  std::string File;
  uint64_t Every = 1, Random = 0, Seed = 1;
};

/// The tiles of \p A's file, those that it asks for.
std::vector<RasterTile> readTiles(const Arguments &A) {
  std::vector<RasterTile> Chosen;
  std::FILE *File = std::fopen(A.File.c_str(), "rb");
  std::mt19937_64 Engine(A.Seed);
  RasterTile T;
  for (uint64_t N = 0; File && T.read(File); ++N) {
    if (A.Random == 0) {
      if (N % A.Every == 0)
        Chosen.push_back(T);
    } else if (Chosen.size() < A.Random) {
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
  App.add_option("cycles", A.Latency, "Memory latency in cycles")->required();
  takesFile(App.add_option("file", A.File,
                           "Output of the plugin isasim-tile-writer (default: "
                           "the tiles of the tests)"));
  App.add_option("every", A.Every,
                 "Write one of N tiles of the file (default 1)")
      ->check(isBetween(uint64_t{1}, uint64_t{1} << 32));
  App.add_option(
         "--random", A.Random,
         "Write N tiles of the file, sampled at random; all if it has fewer")
      ->check(isBetween(uint64_t{1}, uint64_t{1} << 20));
  App.add_option("--seed", A.Seed, "Seed of --random (default 1)")
      ->check(isBetween(uint64_t{0}, MostSeed));
  return runTool("isasim-raster-tiles", [&] {
    if (const auto Ended = parseCommandLine(App, {Values + 1, Values + Count}))
      return *Ended;
    return run(A);
  });
}
