/// What the rasterizer's tests share: a memory, one agent with its rasterizer,
/// and a way to set the CSRs.
#pragma once

#include "raster/Rasterizer.h"

#include <array>
#include <bit>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <span>
#include <vector>

namespace vorion::raster {

/// Global memory from Base on.
class TestMemory : public RasterMemory {
public:
  static constexpr uint32_t Base = 0x10000;

  explicit TestMemory(std::size_t Bytes) : Storage(Bytes / sizeof(Line)) {}

  std::byte *range(uint32_t Addr, uint64_t Bytes) override {
    const uint64_t Size = Storage.size() * sizeof(Line);
    if (Addr < Base || Addr - Base + Bytes > Size)
      return nullptr;
    return reinterpret_cast<std::byte *>(Storage.data()) + (Addr - Base);
  }

  template <typename T> void put(uint32_t Addr, std::span<const T> Values) {
    if (!Values.empty())
      std::memcpy(range(Addr, Values.size_bytes()), Values.data(),
                  Values.size_bytes());
  }

  template <typename T> std::vector<T> get(uint32_t Addr, std::size_t N) {
    std::vector<T> Values(N);
    std::memcpy(Values.data(), range(Addr, N * sizeof(T)), N * sizeof(T));
    return Values;
  }

private:
  struct alignas(64) Line {
    std::array<std::byte, 64> Bytes;
  };
  std::vector<Line> Storage;
};

/// A tile command as a test writes it down.
struct TileCommand {
  float Cutoff = 1e-4F;
  uint32_t Mode = 0;
  uint32_t Options = 0;
  unsigned X = 0, Y = 0, Width = 64, Height = 64;
};

/// One agent, its rasterizer and 8 MiB of memory: records from Records on, the
/// list from List on, pixels from Pixels on with a pitch of a whole tile.
class RasterTest : public testing::Test {
protected:
  static constexpr uint32_t Records = TestMemory::Base;
  static constexpr uint32_t List = Records + 0x400000;
  static constexpr uint32_t Pixels = Records + 0x600000;
  static constexpr uint32_t Pitch = VR_MAX_TILE * sizeof(Pixel);

  TestMemory Memory{8 << 20};
  RasterAgent Agent;
  Rasterizer Unit{Memory, {&Agent}};

  /// Writes \p C by lane 0.
  void set(Csr C, uint32_t Value) { Agent.write(C, std::span(&Value, 1), 1); }
  void set(Csr C, float Value) { set(C, std::bit_cast<uint32_t>(Value)); }

  /// Puts \p Scene in memory and sets the bank, without starting.
  void configure(std::span<const Gaussian> Scene, const TileCommand &T = {}) {
    Memory.put(Records, Scene);
    std::vector<uint32_t> Order(Scene.size());
    for (uint32_t I = 0; I != Order.size(); ++I)
      Order[I] = I;
    Memory.put(List, std::span<const uint32_t>(Order));
    set(Csr::Mode, T.Mode);
    set(Csr::Options, T.Options);
    set(Csr::Cutoff, T.Cutoff);
    set(Csr::Gaussians, Records);
    set(Csr::List, List);
    set(Csr::Count, static_cast<uint32_t>(Scene.size()));
    set(Csr::TileOrigin, TileOriginX.put(T.X) | TileOriginY.put(T.Y));
    set(Csr::TileShape,
        TileShapeWidth.put(T.Width) | TileShapeHeight.put(T.Height));
    set(Csr::Ztile, 0U);
    set(Csr::Output, Pixels);
    set(Csr::OutputPitch, Pitch);
  }

  /// Starts the bank and waits: the status code.
  uint32_t start() {
    set(Csr::Start, 1U);
    Unit.finish(Agent);
    return Agent.read(Csr::Wait, 0);
  }

  /// The pixels of the last command with output to memory, row by row.
  std::vector<Pixel> pixels(unsigned Width = 64, unsigned Height = 64) {
    std::vector<Pixel> All;
    for (unsigned Row = 0; Row != Height; ++Row)
      for (const Pixel &P : Memory.get<Pixel>(Pixels + Row * Pitch, Width))
        All.push_back(P);
    return All;
  }

  /// All in one: a tile of \p Scene, which must succeed.
  std::vector<Pixel> render(std::span<const Gaussian> Scene,
                            const TileCommand &T = {}) {
    configure(Scene, T);
    EXPECT_EQ(start(), VR_OK);
    return pixels(T.Width, T.Height);
  }
};

/// A log that keeps what it is told, as the clock does.
struct KeptWork : WorkLog {
  void command(CommandWork &&Work) override {
    Fetched += Work.Gaussians.size();
    Commands.push_back(std::move(Work));
  }
  void tail(TailWork &&) override {}
  bool wantsFetches() const override { return true; }
  void part(const CommandWork &Begun,
            std::vector<GaussianWork> &&Gaussians) override {
    Entries = Begun.Entries;
    Fetched += Gaussians.size();
    ++Parts;
  }

  std::vector<CommandWork> Commands;
  std::size_t Fetched = 0, Parts = 0;
  uint32_t Entries = 0; ///< of the command that is in the works
};

inline constexpr float Inf = std::numeric_limits<float>::infinity();
inline constexpr float NotANumber = std::numeric_limits<float>::quiet_NaN();

inline std::span<const Gaussian> only(const Gaussian &G) { return {&G, 1}; }

/// Of constant alpha \p Opacity over its box.
inline Gaussian flatGaussian(float X, float Y, float ExtentX, float ExtentY,
                             float Opacity, float Red = 1) {
  return {{X, Y}, {0, 0, 0}, Opacity, {Red, 2, 3}, {ExtentX, ExtentY}, 0};
}

/// A round Gaussian of standard deviation \p Sigma with a box of 3 sigma.
inline Gaussian roundGaussian(float X, float Y, float Sigma, float Opacity,
                              float Red = 1, float Green = 0.5F,
                              float Blue = 0.25F) {
  const float Inverse = 1 / (Sigma * Sigma);
  return {{X, Y},
          {Inverse, 0, Inverse},
          Opacity,
          {Red, Green, Blue},
          {3 * Sigma, 3 * Sigma},
          0};
}

} // namespace vorion::raster
