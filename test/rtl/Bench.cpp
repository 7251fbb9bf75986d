/// Runs tiles (testing/RasterTile.h) on the rasterizer in SystemVerilog, and
/// compares its pixels with the simulator's, bit for bit, and its cycles with
/// the clock's. A line of figures a tile goes to standard output.
///
/// usage: Bench units | Bench triangles | Bench FILE PERCENT
/// "units" tries the arithmetic against the host's, "triangles" lanes alone
/// with edges in integers and in fp32. Exit code 1: some bits differ, or cycles
/// by more than PERCENT, of a tile or of all.
#include "Vtop.h"
#include "testing/RasterTile.h"

#include <algorithm>
#include <array>
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

/// What memory has been asked for. Answers to a command that stopped early come
/// in the next one.
struct Answers {
  struct One {
    uint64_t At;
    std::array<uint32_t, LineBytes / 4> Line;
  };
  std::deque<One> Queue;
  uint64_t Now = 0;
};

class Run {
public:
  Run(Vtop &TopIn, Answers &AnswersIn, const RasterTile &TileIn)
      : Top(TopIn), Memory(AnswersIn), Tile(TileIn),
        Bytes(RasterTile::Records + TileIn.Input.size() * 4 + 128) {
    for (uint32_t N = 0; N != Tile.What.Gaussians; ++N)
      std::memcpy(&Bytes[RasterTile::List + 4 * N], &N, 4);
    std::memcpy(&Bytes[RasterTile::Records], Tile.Input.data(),
                Tile.Input.size() * 4);
  }

  Spent run() {
    const RasterTile::Head &W = Tile.What;
    Top.draws_triangles = W.Primitive != 0;
    Top.compare = W.Depth & 7; // VR_WORD_DEPTH: function, write
    Top.writes_depth = W.Depth >> 3 & 1;
    Top.clear_depth = std::bit_cast<uint32_t>(W.ClearDepth);
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
    const uint32_t Size = Tile.pixelBytes();
    unsigned Wrong = 0;
    for (uint32_t N = 0; N != Tile.What.Pixels; ++N)
      Wrong += std::memcmp(&Bytes[RasterTile::Target +
                                  N / Tile.What.Width * RasterTile::Pitch +
                                  N % Tile.What.Width * Size],
                           &Tile.Output[size_t{N} * Size / 4], Size) != 0;
    return Wrong;
  }

private:
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
    if (Top.request && !Top.writes) {
      auto &Asked = Memory.Queue.emplace_back();
      Asked.At = Memory.Now + Tile.What.Latency;
      std::memcpy(Asked.Line.data(), &Bytes.at(Top.address), LineBytes);
    }
    for (unsigned P = 0; Top.request && Top.writes && P != 8; ++P)
      if (Top.parts >> P & 1)
        std::memcpy(&Bytes.at(Top.address + 8 * P), &Top.data[2 * P], 8);
    Top.clk = 1;
    Top.eval();
    ++Memory.Now;
    Top.answer = !Memory.Queue.empty() && Memory.Queue.front().At == Memory.Now;
    if (Top.answer) {
      std::ranges::copy(Memory.Queue.front().Line, &Top.line[0]);
      Memory.Queue.pop_front();
    }
    Top.clk = 0;
    Top.eval();
  }

  Vtop &Top;
  Answers &Memory;
  const RasterTile &Tile;
  std::vector<unsigned char> Bytes;
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
  std::puts("| tile | pixels | primitives | fragments | clock | RTL | error, % "
            "| begin | fetch | clip | blend | hazard | flush | drain |");
  std::puts("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
  int Code = 0;
  unsigned Count = 0, WrongPixels = 0;
  uint64_t Clock = 0, Rtl = 0;
  double Worst = 0;
  Answers Memory;
  for (RasterTile T; T.read(File); ++Count) {
    if (T.What.Depth >> 4 != 0) { // VR_WORD_DEPTH: load, integer
      std::fprintf(stderr,
                   "Bench: error: %s: tile %s loads pixels or has integer "
                   "depths, expected neither, which the circuit does not do\n",
                   Name, T.What.Name.data());
      return 3;
    }
    Run R(Top, Memory, T);
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

/// Pixels of triangles on a lane of each design of edges, against the host's
/// integers and floats. In fp32 edges are exact up to a largest step.
int triangles(Vtop &Top) {
  std::mt19937_64 Random(2);
  constexpr unsigned Tries = 30000;
  constexpr int64_t LargestStep = (1 << 24) / 126;
  // Of all sizes, about evenly by their digits.
  const auto Number = [&](unsigned Bits) {
    return static_cast<int64_t>(Random()) >> (63 - Random() % Bits);
  };
  const auto Depth = [&] {
    return static_cast<float>(Number(20)) /
           static_cast<float>(1 << Random() % 20);
  };
  const auto Step = [&](bool IsSmall) {
    if (!IsSmall)
      return Number(32);
    return Random() % 8   ? std::clamp(Number(19), -LargestStep, LargestStep)
           : Random() % 2 ? LargestStep
                          : -LargestStep;
  };
  unsigned Wrong = 0, Covered = 0, Passed = 0, InFp = 0;
  Top.writes_depth = 1;
  for (unsigned N = 0; N != Tries; ++N) {
    Top.x = Random() % 64;
    Top.y = Random() % 64;
    Top.origin_x = static_cast<uint16_t>(Random());
    Top.origin_y = static_cast<uint16_t>(Random());
    const bool IsSmall = Random() % 2;
    bool IsCovered = true;
    for (unsigned K = 0; K != 3; ++K) {
      const int64_t A = Step(IsSmall), B = Step(IsSmall);
      // At the tile's first pixel; often near 0 at the pixel.
      const int64_t Corner =
          Random() % 4 ? Number(48) : Number(2) - A * Top.x - B * Top.y;
      const auto C =
          static_cast<uint64_t>(Corner - A * Top.origin_x - B * Top.origin_y);
      Top.record[K] = static_cast<uint32_t>(A);
      Top.record[3 + K] = static_cast<uint32_t>(B);
      Top.record[6 + K] = static_cast<uint32_t>(C);
      Top.record[9 + K] = static_cast<uint32_t>(C >> 32);
      IsCovered = IsCovered && Corner + A * Top.x + B * Top.y >= 0;
    }
    const float D = Depth(), X = Depth(), Y = Depth();
    const uint32_t First = static_cast<uint32_t>(Random()), Tag = Random();
    const auto Along = [](uint32_t To, uint32_t From) {
      return static_cast<float>(static_cast<int>(To) - static_cast<int>(From));
    };
    const float There = (D + X * Along(Top.origin_x, First & 0xffff)) +
                        Y * Along(Top.origin_y, First >> 16);
    const float Right = (There + X * Top.x) + Y * Top.y;
    const float Stored = Random() % 3 ? Depth() : Right;
    Top.record[12] = std::bit_cast<uint32_t>(D);
    Top.record[13] = std::bit_cast<uint32_t>(X);
    Top.record[14] = std::bit_cast<uint32_t>(Y);
    Top.record[15] = First;
    Top.record[17] = Tag;
    Top.stored = std::bit_cast<uint32_t>(Stored);
    Top.compare = Random() % 8;
    // Two cycles to the lane, and two in it.
    for (unsigned Cycle = 0; Cycle != 4; ++Cycle) {
      Top.tries = Cycle == 0;
      for (const int Clock : {1, 0}) {
        Top.clk = static_cast<uint8_t>(Clock);
        Top.eval();
      }
    }
    const bool Holds = (Top.compare & 1 && Right < Stored) ||
                       (Top.compare & 2 && Right == Stored) ||
                       (Top.compare & 4 && Right > Stored);
    const bool Passes = IsCovered && Holds;
    const uint64_t Pixel = std::bit_cast<uint32_t>(Right) | uint64_t{Tag} << 32;
    Covered += IsCovered;
    Passed += Passes;
    InFp += IsSmall;
    Wrong += Top.writes_integer != Passes || Top.integer_pixel != Pixel ||
             (IsSmall && (Top.writes_fp != Passes || Top.fp_pixel != Pixel));
  }
  std::printf("triangles: %u pixels, %u covered, %u in front, %u also with "
              "edges in fp32, %u wrong\n",
              Tries, Covered, Passed, InFp, Wrong);
  return Wrong != 0;
}

} // namespace

int main(int Count, char **Arguments) {
  const auto Top = std::make_unique<Vtop>();
  reset(*Top);
  if (Count == 2 && std::strcmp(Arguments[1], "units") == 0)
    return units(*Top);
  if (Count == 2 && std::strcmp(Arguments[1], "triangles") == 0)
    return triangles(*Top);
  if (Count == 3)
    return tiles(*Top, Arguments[1], std::strtod(Arguments[2], nullptr));
  std::fprintf(stderr,
               "usage: Bench units | Bench triangles | Bench FILE PERCENT\n");
  return 2;
}
