/// Runs tiles (testing/RasterTile.h) on the rasterizer in SystemVerilog, and
/// compares its pixels with the simulator's, bit for bit, and its cycles with
/// the clock's. A line of figures a tile goes to standard output.
///
/// usage: Bench units | Bench FILE PERCENT
/// "units" tries the arithmetic against the host's. Exit code 1: some bits
/// differ, or cycles by more than PERCENT, of a tile or of all.
#include "Vtop.h"
#include "testing/RasterTile.h"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <memory>
#include <random>

using vorion::RasterTile;

namespace {

constexpr unsigned LineBytes = 64;

/// As rasterizer.sv has them.
enum State : unsigned { Idle, Take, Clear, Blend, Empty, Write };

struct Spent {
  unsigned Begin = 0, Fetch = 0, Clip = 0, Blend = 0, Hazard = 0, Flush = 0,
           Drain = 0;
  unsigned all() const {
    return Begin + Fetch + Clip + Blend + Hazard + Flush + Drain;
  }
};

class Run {
public:
  Run(Vtop &TopIn, const RasterTile &TileIn)
      : Top(TopIn), Tile(TileIn),
        Bytes(RasterTile::Records + TileIn.Gaussians.size() * 48 + 128) {
    for (uint32_t N = 0; N != Tile.Gaussians.size(); ++N)
      std::memcpy(&Bytes[RasterTile::List + 4 * N], &N, 4);
    std::memcpy(&Bytes[RasterTile::Records], Tile.Gaussians.data(),
                Tile.Gaussians.size() * 48);
  }

  Spent run() {
    const RasterTile::Head &W = Tile.What;
    Top.origin_x = static_cast<uint16_t>(W.X);
    Top.origin_y = static_cast<uint16_t>(W.Y);
    Top.width = static_cast<uint8_t>(W.Width);
    Top.height = static_cast<uint8_t>(W.Height);
    Top.cutoff = std::bit_cast<uint32_t>(W.Cutoff);
    Top.list_at = RasterTile::List;
    Top.records = RasterTile::Records;
    Top.count = W.Gaussians;
    Top.target = RasterTile::Target;
    Top.pitch = RasterTile::Pitch;
    Top.start = 1;
    // What is under way of the last command comes to its end first.
    while (Top.state == Idle)
      cycle();
    Top.start = 0;
    Spent S;
    while (!Top.done) {
      count(S);
      cycle();
    }
    return S;
  }

  /// Pixels whose bits are not the simulator's.
  unsigned wrong() const {
    unsigned Wrong = 0;
    for (uint32_t N = 0; N != Tile.Pixels.size(); ++N)
      Wrong += std::memcmp(&Bytes[RasterTile::Target +
                                  N / Tile.What.Width * RasterTile::Pitch +
                                  N % Tile.What.Width * 16],
                           &Tile.Pixels[N], 16) != 0;
    return Wrong;
  }

private:
  struct Answer {
    uint64_t At;
    uint32_t Address;
  };

  void count(Spent &S) const {
    switch (Top.state) {
    case Take:
    case Clear:
      ++S.Begin;
      break;
    case Blend:
      ++(Top.blends   ? S.Blend
         : Top.waits  ? S.Hazard
         : Top.misses ? S.Clip
                      : S.Fetch);
      break;
    case Empty:
      ++S.Flush;
      break;
    default:
      ++S.Drain;
    }
  }

  /// Ends a cycle and begins the next one.
  void cycle() {
    if (Top.request && !Top.writes)
      Answers.push_back({Now + Tile.What.Latency, Top.address});
    for (unsigned P = 0; Top.request && Top.writes && P != 4; ++P)
      if (Top.pixels >> P & 1)
        std::memcpy(&Bytes.at(Top.address + 16 * P), &Top.data[4 * P], 16);
    Top.clk = 1;
    Top.eval();
    ++Now;
    Top.answer = !Answers.empty() && Answers.front().At == Now;
    if (Top.answer) {
      const uint32_t From = Answers.front().Address;
      Answers.pop_front();
      for (unsigned N = 0; N != LineBytes / 4; ++N)
        std::memcpy(&Top.line[N], &Bytes.at(From + 4 * N), 4);
    }
    Top.clk = 0;
    Top.eval();
  }

  Vtop &Top;
  const RasterTile &Tile;
  std::vector<unsigned char> Bytes;
  std::deque<Answer> Answers;
  uint64_t Now = 0;
};

void reset(Vtop &Top) {
  Top.reset = 1;
  for (const int Clock : {0, 1, 0}) {
    Top.clk = static_cast<uint8_t>(Clock);
    Top.eval();
  }
  Top.reset = 0;
  Top.eval();
}

int tiles(Vtop &Top, const char *Name, double Percent) {
  std::FILE *File = std::fopen(Name, "rb");
  if (!File) {
    std::fprintf(stderr, "Bench: error: %s: cannot be read\n", Name);
    return 3;
  }
  std::puts("| tile | pixels | Gaussians | fragments | clock | RTL | error, % "
            "| begin | fetch | clip | blend | hazard | flush | drain |");
  std::puts("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
  int Code = 0;
  unsigned Count = 0, WrongPixels = 0;
  uint64_t Clock = 0, Rtl = 0;
  double Worst = 0;
  for (RasterTile T; T.read(File); ++Count) {
    reset(Top);
    Run R(Top, T);
    const Spent S = R.run();
    const RasterTile::Head &W = T.What;
    const unsigned Wrong = R.wrong();
    const double Error =
        100.0 * (double(W.Cycles) - double(S.all())) / double(S.all());
    std::printf("| %s | %ux%u | %u | %u | %u | %u | %+.2f | %+d | %+d | %+d | "
                "%+d | %+d | %+d | %+d |",
                W.Name.data(), W.Width, W.Height, W.Gaussians, W.Fragments,
                W.Cycles, S.all(), Error, int(W.Begin - S.Begin),
                int(W.Fetch - S.Fetch), int(W.Clip - S.Clip),
                int(W.Blend - S.Blend), int(W.Hazard - S.Hazard),
                int(W.Flush - S.Flush), int(W.Drain - S.Drain));
    std::puts(Wrong ? " wrong pixels" : "");
    WrongPixels += Wrong;
    Clock += W.Cycles;
    Rtl += S.all();
    Worst = std::max(Worst, std::fabs(Error));
    Code |= Wrong != 0;
  }
  std::fclose(File);
  const double Error = 100.0 * (double(Clock) - double(Rtl)) / double(Rtl);
  std::printf("\n%u tiles, %u wrong pixels; clock %llu cycles, RTL %llu, error "
              "%+.2f %%, of a tile at most %.2f %%\n",
              Count, WrongPixels, (unsigned long long)Clock,
              (unsigned long long)Rtl, Error, Worst);
  return Count == 0 ? 3 : Code || std::max(std::fabs(Error), Worst) > Percent;
}

float asFloat(uint32_t Bits) { return std::bit_cast<float>(Bits); }

/// Operands near each other in exponent, and those where rules change.
int units(Vtop &Top) {
  std::mt19937 Random(1);
  const uint32_t Edges[] = {0,          1,          0x007fffff, 0x00800000,
                            0x00800001, 0x3f7fffff, 0x3f800000, 0x3f800001,
                            0x7f7fffff, 0x7f800000, 0x7fc00000};
  constexpr unsigned Tries = 100000;
  const auto Operand = [&](uint32_t Other) -> uint32_t {
    const uint32_t Bits = Random();
    switch (Random() % 8) {
    case 0:
      return Edges[Random() % std::size(Edges)] | (Bits & 0x80000000);
    case 1:
      return Bits & 0x80ffffff; // subnormal, or nearly
    case 2:
    case 3:
    case 4: // within 32 exponents of the other
      return (Bits & 0x807fffff) | ((Other >> 23) + Bits % 64 - 32 & 0xff)
                                       << 23;
    default:
      return Bits;
    }
  };
  const auto Same = [](uint32_t Is, float Right) {
    return std::isnan(Right) ? Is == 0x7fc00000
                             : Is == std::bit_cast<uint32_t>(Right);
  };
  unsigned Wrong = 0;
  for (unsigned N = 0; N != Tries; ++N) {
    Top.a = Operand(0x3f800000);
    Top.b = Operand(Top.a);
    Top.eval();
    const float A = asFloat(Top.a), B = asFloat(Top.b);
    const bool IsRight = Same(Top.product, A * B) && Same(Top.sum, A + B) &&
                         (std::isnan(A) || Same(Top.half, -0.5F * A)) &&
                         Top.less == (A < B) && Top.less_equal == (A <= B);
    if (!IsRight && ++Wrong < 10)
      std::printf("%08x %08x: product %08x, sum %08x, half %08x\n", Top.a,
                  Top.b, Top.product, Top.sum, Top.half);
  }
  std::printf("units: %u pairs of operands, %u wrong\n", Tries, Wrong);
  return Wrong != 0;
}

} // namespace

int main(int Count, char **Arguments) {
  const auto Top = std::make_unique<Vtop>();
  reset(*Top);
  if (Count == 2 && std::strcmp(Arguments[1], "units") == 0)
    return units(*Top);
  if (Count == 3)
    return tiles(*Top, Arguments[1], std::strtod(Arguments[2], nullptr));
  std::fprintf(stderr, "usage: Bench units | Bench FILE PERCENT\n");
  return 2;
}
