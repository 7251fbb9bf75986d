/// Runs tiles of the backward mode (testing/RasterTile.h) through a pair of
/// lanes and a gather in SystemVerilog, and compares the sums of each Gaussian
/// and the pixels' last words with the simulator's, bit for bit.
///
/// usage: Bench FILE. Exit code 1: some bits differ.
#include "Vbackward_top.h"
#include "testing/RasterTile.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <deque>
#include <memory>

using vorion::BackwardTile;

namespace {

struct Place {
  unsigned X, Y; ///< in the tile
};

class Run {
public:
  Run(Vbackward_top &TopIn, BackwardTile &TileIn) : Top(TopIn), Tile(TileIn) {}

  /// Words that differ.
  unsigned run() {
    unsigned Wrong = 0;
    for (uint32_t Entry = Tile.What.Gaussians; Entry-- != 0;) {
      through(Entry);
      Wrong += std::memcmp(&Top.sums[0], Tile.Sums[Entry].data(), 36) != 0;
    }
    for (size_t N = 0; N != Tile.Pixels.size(); ++N)
      Wrong += std::memcmp(&Tile.Pixels[N][3], Tile.After[N].data(), 8) != 0;
    return Wrong;
  }
  uint64_t cycles() const { return Cycles; }

private:
  static constexpr unsigned ToPixel = 4, ToWrite = 5, ToTerms = 6;

  void through(uint32_t Entry) {
    const auto &G = Tile.Gaussians[Entry];
    std::memcpy(&Top.shape[0], G.data(), 36);
    Top.entry = Entry;
    Top.clamp_stops = Tile.What.ClampStops;
    Top.valid = Top.ends = Top.gathers = 0;
    Top.reset = 1;
    cycle();
    Top.reset = 0;
    std::deque<Place> In = box(G);
    std::deque<std::array<uint32_t, 12>> Terms[8]; // and the place
    // By cycle behind the first.
    std::array<Place, ToTerms + 1> Inside{};
    unsigned Flushed = 0;
    while (Flushed <= ToTerms || !Top.done) {
      for (unsigned N = ToTerms; N != 0; --N)
        Inside[N] = Inside[N - 1];
      Top.valid = !In.empty();
      Flushed += In.empty();
      if (!In.empty()) {
        Inside[0] = In.front();
        In.pop_front();
      }
      Top.column = Tile.What.X + Inside[0].X;
      Top.row = Tile.What.Y + Inside[0].Y;
      Top.column_5 = Tile.What.X + Inside[ToPixel].X;
      Top.row_5 = Tile.What.Y + Inside[ToPixel].Y;
      std::memcpy(&Top.pixel[0], pixel(Inside[ToPixel]).data(), 24);
      bool IsLeft = false;
      Top.gathers = Top.half = 0;
      Top.rows = 0;
      for (unsigned U = 0; U != 8; ++U)
        if (!Terms[U].empty()) {
          const auto &T = Terms[U].front();
          IsLeft = true;
          Top.gathers |= 1U << U;
          Top.half |= (T[9] / 8 & 1) << U;
          Top.rows |= uint64_t{T[10]} << (6 * U);
          std::memcpy(&Top.terms[9 * U], T.data(), 36);
        }
      Top.ends = Flushed > ToTerms && !IsLeft;
      Top.eval();
      for (unsigned U = 0; U != 8; ++U)
        if (Top.takes >> U & 1)
          Terms[U].pop_front();
      // Outputs of registers, of pixels that came in before.
      if (Top.writes)
        std::memcpy(&pixel(Inside[ToWrite])[3], &Top.updated, 8);
      if (Top.gives) {
        auto &T = Terms[Inside[ToTerms].X % 8].emplace_back();
        std::memcpy(T.data(), &Top.given[0], 36);
        T[9] = Inside[ToTerms].X;
        T[10] = Inside[ToTerms].Y;
      }
      cycle();
    }
  }

  std::array<uint32_t, 6> &pixel(Place P) {
    return Tile.Pixels[size_t{P.Y} * Tile.What.Width + P.X];
  }

  /// The pixels of a box, by its definition.
  std::deque<Place> box(const std::array<uint32_t, 12> &G) const {
    const auto Inside = [&](unsigned Axis, uint32_t Pixel) {
      return std::fabs(static_cast<float>(Pixel) + 0.5F -
                       std::bit_cast<float>(G[Axis])) <=
             std::bit_cast<float>(G[9 + Axis]);
    };
    std::deque<Place> All;
    for (unsigned Y = 0; Y != Tile.What.Height; ++Y)
      for (unsigned X = 0; X != Tile.What.Width; ++X)
        if (Inside(0, Tile.What.X + X) && Inside(1, Tile.What.Y + Y))
          All.push_back({X, Y});
    return All;
  }

  void cycle() {
    for (const int Clock : {1, 0}) {
      Top.clk = static_cast<uint8_t>(Clock);
      Top.eval();
    }
    ++Cycles;
  }

  Vbackward_top &Top;
  BackwardTile &Tile;
  uint64_t Cycles = 0;
};

} // namespace

int main(int Count, char **Arguments) {
  std::FILE *File = Count == 2 ? std::fopen(Arguments[1], "rb") : nullptr;
  if (!File) {
    std::fprintf(stderr,
                 Count == 2 ? "Bench: error: %s: cannot be read\n"
                            : "usage: Bench FILE\n",
                 Arguments[Count - 1]);
    return Count == 2 ? 3 : 2;
  }
  const auto Top = std::make_unique<Vbackward_top>();
  unsigned Tiles = 0, Wrong = 0, Gaussians = 0;
  uint64_t Cycles = 0;
  for (BackwardTile T; T.read(File); ++Tiles) {
    Run R(*Top, T);
    Wrong += R.run();
    Gaussians += T.What.Gaussians;
    Cycles += R.cycles();
  }
  std::fclose(File);
  std::printf("%u backward tiles, %u Gaussians, %llu cycles of a pair, %u "
              "wrong sums or pixels\n",
              Tiles, Gaussians, (unsigned long long)Cycles, Wrong);
  return Tiles == 0 ? 3 : Wrong != 0;
}
