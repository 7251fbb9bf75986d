// Wall time of whole frames on one core of the host, through the CSRs as a
// kernel would drive them.
#include "raster/Datapath.h"
#include "raster/Rasterizer.h"

#include <benchmark/benchmark.h>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <span>
#include <string>

namespace {

using namespace vorion::raster;

constexpr unsigned FrameWidth = 960;
constexpr unsigned FrameHeight = 544;
constexpr unsigned TileSize = VR_MAX_TILE;
constexpr unsigned Across = (FrameWidth + TileSize - 1) / TileSize;
constexpr unsigned Down = (FrameHeight + TileSize - 1) / TileSize;

class FrameMemory : public RasterMemory {
public:
  explicit FrameMemory(std::size_t Bytes) : Storage(Bytes / sizeof(Line)) {}
  std::byte *range(uint32_t Addr, uint64_t Bytes) override {
    return Addr + Bytes <= Storage.size() * sizeof(Line)
               ? reinterpret_cast<std::byte *>(Storage.data()) + Addr
               : nullptr;
  }

private:
  struct alignas(64) Line {
    std::byte Bytes[64];
  };
  std::vector<Line> Storage;
};

/// \p Fragments in boxes of 3 sigma, sigma around \p Sigma pixels.
std::vector<Gaussian> makeScene(double Sigma, double Fragments) {
  std::mt19937 Engine(1);
  const auto Uniform = [&](double Low, double High) {
    return Low + (High - Low) * Engine() / 0x1p32;
  };
  std::vector<Gaussian> Scene;
  for (double Sum = 0; Sum < Fragments;) {
    const double S = Sigma * std::exp(Uniform(-0.7, 0.7));
    const auto Inverse = static_cast<float>(1 / (S * S));
    const auto Extent = static_cast<float>(3 * S);
    Scene.push_back({{static_cast<float>(Uniform(0, FrameWidth)),
                      static_cast<float>(Uniform(0, FrameHeight))},
                     {Inverse, 0.3F * Inverse, Inverse},
                     static_cast<float>(Uniform(0.01, 0.2)),
                     {0.5F, 0.4F, 0.3F},
                     {Extent, Extent},
                     0});
    Sum += 36 * S * S;
  }
  return Scene;
}

/// Arguments: sigma in tenths of a pixel, exponential unit.
void frame(benchmark::State &State) {
  const std::vector<Gaussian> Scene =
      makeScene(static_cast<double>(State.range(0)) / 10, 20e6);
  constexpr uint32_t Pixels = 0;
  constexpr uint32_t Records = FrameWidth * FrameHeight * sizeof(Pixel);
  const auto Lists =
      Records + static_cast<uint32_t>(Scene.size() * sizeof(Gaussian));

  std::vector<std::vector<uint32_t>> TileLists(Across * Down);
  std::size_t Pairs = 0;
  for (uint32_t I = 0; I != Scene.size(); ++I) {
    const auto Range = [&](unsigned Axis, unsigned Tiles) {
      const float Low = Scene[I].Mean[Axis] - Scene[I].Extent[Axis];
      const float High = Scene[I].Mean[Axis] + Scene[I].Extent[Axis];
      const int First =
          std::max(0, static_cast<int>(Low) / static_cast<int>(TileSize));
      const int Last =
          std::min(static_cast<int>(Tiles) - 1,
                   static_cast<int>(High) / static_cast<int>(TileSize));
      return std::pair(static_cast<unsigned>(First),
                       static_cast<unsigned>(Last));
    };
    const auto [X0, X1] = Range(0, Across);
    const auto [Y0, Y1] = Range(1, Down);
    for (unsigned Y = Y0; Y <= Y1; ++Y)
      for (unsigned X = X0; X <= X1; ++X, ++Pairs)
        TileLists[Y * Across + X].push_back(I);
  }
  FrameMemory Memory(Lists + 4 * Pairs + 4096);
  std::memcpy(Memory.range(Records, 1), Scene.data(),
              Scene.size() * sizeof(Gaussian));

  RasterAgent Agent;
  Rasterizer Unit(Memory, {&Agent});
  const auto Set = [&](Csr C, uint32_t Value) {
    Agent.write(C, std::span(&Value, 1), 1);
  };
  Set(Csr::Options, OptionsExp.put(static_cast<uint32_t>(State.range(1))));
  Set(Csr::Cutoff, std::bit_cast<uint32_t>(1e-4F));
  Set(Csr::Gaussians, Records);
  Set(Csr::OutputPitch, FrameWidth * sizeof(Pixel));

  uint64_t Fragments = 0;
  for (auto _ : State) {
    const Counters Before = Agent.counters();
    uint32_t List = Lists;
    for (unsigned T = 0; T != Across * Down; ++T) {
      const unsigned X = T % Across * TileSize;
      const unsigned Y = T / Across * TileSize;
      const std::size_t Bytes = 4 * TileLists[T].size();
      std::memcpy(Memory.range(List, Bytes), TileLists[T].data(), Bytes);
      Set(Csr::List, List);
      Set(Csr::Count, static_cast<uint32_t>(TileLists[T].size()));
      Set(Csr::TileOrigin, TileOriginX.put(X) | TileOriginY.put(Y));
      Set(Csr::TileShape,
          TileShapeWidth.put(std::min(TileSize, FrameWidth - X)) |
              TileShapeHeight.put(std::min(TileSize, FrameHeight - Y)));
      Set(Csr::Output, Pixels + (Y * FrameWidth + X) * sizeof(Pixel));
      Unit.makeRoom(Agent);
      Set(Csr::Start, 1);
      List += static_cast<uint32_t>(Bytes);
    }
    Unit.finish(Agent);
    if (Agent.read(Csr::Wait, 0) != VR_OK)
      State.SkipWithError("a command failed");
    Fragments = Agent.counters().Fragments - Before.Fragments;
    State.counters["fragments"] = static_cast<double>(Fragments);
    State.counters["blends"] =
        static_cast<double>(Agent.counters().Blends - Before.Blends);
    State.counters["fetched"] =
        static_cast<double>(Agent.counters().Gaussians - Before.Gaussians);
  }
  State.SetItemsProcessed(static_cast<int64_t>(Fragments) * State.iterations());
}
BENCHMARK(frame)
    ->ArgNames({"sigma10", "exp"})
    ->ArgsProduct({{10, 30, 100}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

void exponentials(benchmark::State &State, const Datapath *Level,
                  std::size_t Unit) {
  std::vector<float> In(4096);
  for (std::size_t I = 0; I != In.size(); ++I)
    In[I] = -6.0F * static_cast<float>(I) / 4096.0F;
  std::vector<float> Out(In.size());
  for (auto _ : State) {
    Out = In;
    Level->Exp[Unit](Out.data(), Out.size());
    benchmark::DoNotOptimize(Out.data());
  }
  State.SetItemsProcessed(static_cast<int64_t>(In.size()) * State.iterations());
}

const bool Registered = [] {
  for (const Datapath *Level : datapaths())
    for (std::size_t Row = 0; Row != ExpUnitCount; ++Row)
      benchmark::RegisterBenchmark(("exponentials/" + std::string(Level->Name) +
                                    "/" + std::string(ExpUnits[Row].Name))
                                       .c_str(),
                                   exponentials, Level, Row);
  return true;
}();

} // namespace
