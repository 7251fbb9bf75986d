#include "fuzz/Targets.h"

#include "observe/check/Checkers.h"
#include "observe/numerics/Numerics.h"
#include "raster/RasterTables.h"
#include "raster/UnitTables.h"
#include "testing/Instructions.h"
#include "vorion/isasim/Machine.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <random>

namespace vorion::isasim::fuzz {

namespace {

using raster::Csr;
using testing::encode;

// Memory is small, so that what commands write lies over what they read.
constexpr uint32_t GlobalBytes = 16 << 10;
constexpr uint32_t Records = 32, List = 0x800, Pixels = 0x1000, Tails = 0x2000,
                   Shown = 0x3000;
constexpr size_t MaxOps = 200;
constexpr uint64_t MaxInstructions = 20000;
/// Lane slots above which the numeric sanitizer would take too long.
constexpr uint64_t FewFragments = 100000;
constexpr unsigned Value = 6, LaneStep = 7, Lane = 8, Address = 9, Mask = 10;

Config shape(bool Timed) {
  Config C;
  C.Clusters = 1;
  C.SocketsPerCluster = C.CoresPerSocket = 2;
  C.GlobalBytes = GlobalBytes;
  C.LocalBytes = C.StackBytes = 4 << 10;
  C.Quantum = 256;
  C.MaxInstructions = MaxInstructions;
  C.HostThreads = 1;
  C.Timing.Enabled = Timed;
  return C;
}

/// Takes an input apart from its front; zeros at the end.
class Input {
public:
  explicit Input(std::span<const std::byte> BytesIn) : Bytes(BytesIn) {}
  bool empty() const { return Bytes.empty(); }
  template <typename T> T take() {
    T Result{};
    const size_t Size = std::min(sizeof(T), Bytes.size());
    if (Size)
      std::memcpy(&Result, Bytes.data(), Size);
    Bytes = Bytes.subspan(Size);
    return Result;
  }

private:
  std::span<const std::byte> Bytes;
};

unsigned csrOf(uint8_t Choice) {
  static const std::vector<unsigned> All = [] {
    std::vector<unsigned> Numbers;
    for (const CsrInfo &Info : CsrTable)
      if (Info.Raster)
        Numbers.push_back(Info.Number);
    return Numbers;
  }();
  return All[Choice % All.size()];
}

/// What a well-meaning program would write.
uint32_t likelyValue(unsigned Number, uint8_t Choice) {
  const uint32_t Small = Choice % 16, Where = Choice / 16;
  switch (static_cast<Csr>(Number)) {
  case Csr::Mode: {
    constexpr uint32_t Triangles =
        raster::ModePrimitive.put(raster::VR_PRIMITIVE_TRIANGLE);
    constexpr uint32_t Modes[] = {
        0,
        0,
        16,
        1,
        2,
        4,
        8,
        6,
        Triangles,
        Triangles,
        Triangles | raster::ModeFragments.put(1),
        raster::ModePrimitive.put(raster::VR_PRIMITIVE_RAY),
        raster::ModeLimited.put(1),
        raster::ModeFrom.put(1) | raster::ModeLoad.put(1),
        raster::ModeLimited.put(1) | raster::ModeKeepSaturated.put(1)};
    return Modes[Choice % std::size(Modes)];
  }
  case Csr::Index:
    return Choice % 5;
  case Csr::Word: // of depths, or an address
    return Choice % 2 ? Choice % 32 : VX_GLOBAL_BASE + Pixels + 4 * Choice;
  case Csr::Options:
    if (Choice % 4 == 0)
      return 0;
    return raster::OptionsExp.put(
               raster::ExpUnits[Choice % raster::ExpUnitCount].Option) |
           raster::OptionsBlend.put(Choice / raster::ExpUnitCount %
                                    raster::BlendUnitCount) |
           raster::OptionsSkipSaturated.put(Choice / 27 % 2) |
           raster::OptionsDegree4.put(Choice / 54 % 2) |
           raster::OptionsLowPass.put(Choice / 108 % 2);
  case Csr::Cutoff:
    return std::bit_cast<uint32_t>(static_cast<float>(Choice) / 256.0F);
  case Csr::Gaussians:
    return VX_GLOBAL_BASE + 16 * Small;
  case Csr::List:
    return VX_GLOBAL_BASE + List + 4 * Choice;
  case Csr::Count:
    return Choice;
  case Csr::TileOrigin:
    return raster::TileOriginX.put(Small * 8) |
           raster::TileOriginY.put(Where * 8);
  case Csr::TileShape:
    return raster::TileShapeWidth.put(1 + 4 * Small) |
           raster::TileShapeHeight.put(1 + 4 * Where);
  case Csr::Ztile:
    return raster::ZtileCount.put(Choice % 4) |
           raster::ZtileIndex.put(Choice / 4 % 4);
  case Csr::Output:
  case Csr::Upstream:
  case Csr::Last:
    return VX_GLOBAL_BASE + Pixels + 32 * Choice;
  case Csr::OutputPitch:
    return 16 * Small;
  case Csr::TailCount:
    return Small;
  case Csr::TailShare:
    return Choice * 256U;
  case Csr::TailRecord:
    return VX_GLOBAL_BASE + Tails + 16 * Choice;
  case Csr::Backward:
    return Choice % 32;
  case Csr::PixelIndex:
    return Choice;
  default:
    return std::bit_cast<uint32_t>(static_cast<float>(Choice) / 8.0F);
  }
}

/// The guest's program.
class Program {
public:
  Program() {
    setMask(0xFFFF);
    add(Op::RV_CSRRS, {.Rd = Lane, .Csr = CSR_THREAD_ID});
  }

  void add(Op O, const testing::Fields &F) { Code.push_back(encode(O, F)); }
  void load(unsigned Rd, uint32_t V) { testing::loadConstant(Code, Rd, V); }
  void setMask(uint32_t Lanes) {
    load(Mask, Lanes);
    add(Op::VX_TMC, {.Rs1 = Mask});
  }
  /// \p Step more in each lane than in the one before.
  void write(unsigned Number, uint32_t V, uint32_t Step, Op How) {
    load(Value, V);
    if (Step) {
      load(LaneStep, Step);
      add(Op::RV_MUL, {.Rd = LaneStep, .Rs1 = LaneStep, .Rs2 = Lane});
      add(Op::RV_ADD, {.Rd = Value, .Rs1 = Value, .Rs2 = LaneStep});
    }
    add(How, {.Rs1 = Value, .Csr = Number});
  }
  /// Into memory, a place for each core and lane, so that it is compared.
  void read(unsigned Number) {
    add(Op::RV_CSRRS, {.Rd = Value, .Csr = Number});
    add(Op::RV_CSRRS, {.Rd = Address, .Csr = CSR_MHARTID});
    load(LaneStep, VX_GLOBAL_BASE + Shown);
    add(Op::RV_SH2ADD, {.Rd = Address, .Rs1 = Address, .Rs2 = LaneStep});
    add(Op::RV_SW, {.Rs1 = Address, .Rs2 = Value});
  }
  void store(uint32_t At, uint32_t V) {
    load(Address, VX_GLOBAL_BASE + At);
    load(Value, V);
    add(Op::RV_SW, {.Rs1 = Address, .Rs2 = Value});
  }

  std::shared_ptr<const Image> image() {
    add(Op::VX_TMC, {.Rs1 = 0});
    Image::Segment S;
    S.Address = VX_IMAGE_BASE;
    S.MemBytes = static_cast<uint32_t>(Code.size() * 4);
    const auto Raw = std::as_bytes(std::span(Code));
    S.Bytes.assign(Raw.begin(), Raw.end());
    S.Executable = true;
    return Image::raw(std::move(S), "fuzz");
  }

private:
  std::vector<uint32_t> Code;
};

enum Action : uint8_t { Likely, Any, Read, Store, Lanes, Command, NumActions };

std::shared_ptr<const Image> programOf(Input &In) {
  Program P;
  for (size_t N = 0; N != MaxOps && !In.empty(); ++N)
    switch (static_cast<Action>(In.take<uint8_t>() % NumActions)) {
    case Likely: {
      const unsigned Number = csrOf(In.take<uint8_t>());
      P.write(Number, likelyValue(Number, In.take<uint8_t>()), 0, Op::RV_CSRRW);
      break;
    }
    case Any: {
      const unsigned Number = csrOf(In.take<uint8_t>());
      constexpr Op How[] = {Op::RV_CSRRW, Op::RV_CSRRS, Op::RV_CSRRC};
      const auto Kind = In.take<uint8_t>();
      const auto V = In.take<uint32_t>();
      P.write(Number, V, Kind / 3, How[Kind % 3]);
      break;
    }
    case Read:
      P.read(csrOf(In.take<uint8_t>()));
      break;
    case Store: {
      const uint32_t At = In.take<uint16_t>() % GlobalBytes & ~3U;
      P.store(At, In.take<uint32_t>());
      break;
    }
    case Lanes: {
      const auto Some = In.take<uint16_t>();
      P.setMask(Some ? Some : 0xFFFF);
      break;
    }
    default: // a whole command
      for (unsigned Number = static_cast<unsigned>(Csr::Mode);
           Number <= static_cast<unsigned>(Csr::Upstream); ++Number)
        P.write(Number, likelyValue(Number, In.take<uint8_t>()), 0,
                Op::RV_CSRRW);
      P.write(static_cast<unsigned>(Csr::Start), 0, 0, Op::RV_CSRRW);
    }
  P.read(static_cast<unsigned>(Csr::Status));
  return P.image();
}

/// Records in front of a list of them, and noise.
std::vector<std::byte> memoryOf(uint32_t Seed) {
  std::mt19937 Random(Seed);
  const auto Uniform = [&](float Most) {
    return Most * static_cast<float>(Random() % 1024) / 1024.0F;
  };
  std::vector<std::byte> Bytes(GlobalBytes);
  for (uint32_t N = 0; N != Records; ++N) {
    raster::Gaussian G{};
    for (unsigned Axis = 0; Axis != 2; ++Axis) {
      G.Mean[Axis] = Uniform(64);
      G.Extent[Axis] = Uniform(40);
    }
    G.Conic[0] = 0.01F + Uniform(0.2F);
    G.Conic[1] = Uniform(0.01F);
    G.Conic[2] = 0.01F + Uniform(0.2F);
    G.Opacity = Uniform(1);
    for (float &C : G.Color)
      C = Uniform(1);
    G.Tag = N;
    std::memcpy(Bytes.data() + N * sizeof(G), &G, sizeof(G));
  }
  for (uint32_t N = 0; N != (Pixels - List) / 4; ++N) {
    const uint32_t Entry = static_cast<uint32_t>(Random() % Records) |
                           (Random() % 4 ? 0U : raster::VR_INTERSECT);
    std::memcpy(Bytes.data() + List + 4 * N, &Entry, sizeof(Entry));
  }
  return Bytes;
}

struct Outcomes {
  RunResult Result;
  std::vector<std::byte> Global;
};

Outcomes run(const std::shared_ptr<const Image> &Of,
             std::span<const std::byte> Memory, bool Timed,
             std::vector<Observer *> Watchers = {}) {
  auto M = Machine::create(shape(Timed));
  if (!M) // the host has no memory for it
    std::abort();
  (*M)->setObservers(std::move(Watchers));
  (*M)->load(Of);
  (*M)->write(VX_GLOBAL_BASE, Memory);
  Outcomes O;
  O.Result = (*M)->run();
  O.Global.resize(GlobalBytes);
  (*M)->read(VX_GLOBAL_BASE, O.Global);
  return O;
}

void requireSame(const Outcomes &A, const Outcomes &B, const char *With) {
  const char *What = nullptr;
  if (A.Result.End != B.Result.End || A.Result.Report != B.Result.Report)
    What = "outcome";
  else if (!(A.Result.Raster == B.Result.Raster))
    What = "counters";
  else if (A.Global != B.Global)
    What = "memory";
  if (!What)
    return;
  std::fprintf(stderr, "with %s the run differs in its %s\n", With, What);
  std::abort();
}

} // namespace

void rasterize(std::span<const std::byte> Bytes) {
  Input In(Bytes);
  const std::vector<std::byte> Memory = memoryOf(In.take<uint8_t>());
  const auto Guest = programOf(In);
  const Outcomes Plain = run(Guest, Memory, false);
  requireSame(Plain, run(Guest, Memory, true), "the clock");
  Observer Nothing;
  requireSame(Plain, run(Guest, Memory, true, {&Nothing}), "an observer");
  if (Plain.Result.Raster.Fragments + Plain.Result.Raster.TailVisits >
      FewFragments)
    return;
  const auto Checks = Checkers::create("all", [](std::string_view) {});
  Numerics Shadow{NumericOptions()};
  std::vector<Observer *> Watchers = (*Checks)->observers();
  Watchers.push_back(&Shadow);
  requireSame(Plain, run(Guest, Memory, false, Watchers),
              "checkers and numerics");
}

std::vector<std::vector<std::byte>> rasterSeeds(unsigned Count, unsigned Seed) {
  std::mt19937 Random(Seed);
  std::vector<std::vector<std::byte>> Seeds;
  for (unsigned N = 0; N != Count; ++N) {
    std::vector<std::byte> Bytes;
    const auto Put = [&](auto Number) {
      Bytes.push_back(static_cast<std::byte>(Number));
    };
    Put(Random());
    for (auto Left = Random() % 12 + 1; Left; --Left) {
      if (Random() % 3 != 0) {
        Put(static_cast<unsigned>(Command));
        for (unsigned Number = static_cast<unsigned>(Csr::Mode);
             Number <= static_cast<unsigned>(Csr::Upstream); ++Number)
          Put(Random() % 4 ? Random() % 64 : Random());
      }
      for (auto More = Random() % 4; More; --More) {
        Put(Random() % Command);
        for (auto Rest = Random() % 6; Rest; --Rest)
          Put(Random());
      }
    }
    Seeds.push_back(std::move(Bytes));
  }
  return Seeds;
}

} // namespace vorion::isasim::fuzz
