#include "observe/numerics/RasterShadow.h"

#include "observe/numerics/ShadowMath.h"
#include "raster/CommandInput.h"
#include "raster/PixelRanges.h"
#include "vorion/isasim/Machine.h"

#include <algorithm>
#include <cstring>

namespace vorion::isasim {

using namespace raster;

namespace {

// docs/abi.md, "Rasterizer".
constexpr double MaxAlpha = 0.99F;
constexpr unsigned Side = TileBuffer::Stride;

/// The floats of a record in double, in its order.
struct ShadowGaussian {
  double Mean[2], Conic[3], Opacity, Color[3], Extent[2];
};
constexpr unsigned RecordFloats = sizeof(ShadowGaussian) / sizeof(double);
static_assert(offsetof(Gaussian, Tag) == RecordFloats * sizeof(float));

struct MachineMemory final : RasterMemory {
  explicit MachineMemory(Machine &M) : Device(M) {}
  std::byte *range(uint32_t Addr, uint64_t Bytes) override {
    return Device.hostPointer(Addr, Bytes);
  }
  bool isOver() override { return Device.mustStop(); }
  Machine &Device;
};

} // namespace

struct RasterShadow::Tile {
  TileBuffer Real;
  double Color[3][TileBuffer::Pixels];
  double T[TileBuffer::Pixels];
  std::optional<PixelRanges> Ranges;
  uint32_t Done = 0; ///< entries of the list, before hand-over and after it

  void reset(const Job &Task, RasterMemory &Storage) {
    Real.reset(Task.X, Task.Y, Task.Width, Task.Height);
    for (auto &Plane : Color)
      std::fill(std::begin(Plane), std::end(Plane), 0.0);
    std::fill(std::begin(T), std::end(T), 1.0);
    Ranges.emplace(Task, Storage, Real);
  }
};

/// One Gaussian after the other into a tile.
class RasterShadow::Replay {
public:
  Replay(RasterShadow &Of, const Job &What, Tile &To)
      : Out(Of.Found), Memory(Of.Memory), Lanes(Of.Lanes), Task(What), T(To) {}

  /// \p Address of the record, 0 for a pushed one.
  void blend(const Gaussian &G, uint32_t Number, uint32_t Address);
  /// So many entries of the list, or until no pixel takes more. \p Before: of
  /// the list, at its hand-over. False if the unit refuses one.
  bool blendList(RasterMemory &Storage, uint64_t Entries, uint32_t Before = 0);

private:
  struct Fragment {
    unsigned At, Column;
    size_t Row; ///< in Rows
    float Power;
    double OwnPower, Power2; ///< in double on fp32 operands; the shadow
  };
  /// A row of the box before it is blended.
  struct Row {
    std::array<float, Side> R, G, B, T;
  };

  ShadowGaussian shadowOf(const Gaussian &G, uint32_t Address) const;
  void compareBoxes(const Gaussian &G, const ShadowGaussian &S);
  void collect(const Gaussian &G, const ShadowGaussian &S, unsigned Row);
  void judge(const Gaussian &G, const ShadowGaussian &S, const Fragment &F,
             float Exp, const Row &Before);
  void count(RasterStage Which, float Is, double Own, double Total);
  void differ(RasterStage Which, uint64_t Times = 1) {
    Out.Stages[static_cast<size_t>(Which)].Differ += Times;
    Current->Differ += Times;
  }

  RasterFindings &Out;
  const ShadowMemory &Memory;
  const Datapath &Lanes;
  const Job &Task;
  Tile &T;

  uint32_t Number = 0;
  GaussianCounts *Current = nullptr;
  std::array<bool, Side> InX{}, InY{}; ///< the box
  unsigned X = 0, Y = 0;               ///< the fragment's, in the tile
  std::vector<Row> Rows;               ///< of the box, before
  std::vector<Fragment> Fragments;
  std::vector<float> Exps; ///< of the fragments
};

ShadowGaussian RasterShadow::Replay::shadowOf(const Gaussian &G,
                                              uint32_t Address) const {
  std::array<uint32_t, RecordFloats> Words;
  std::array<double, RecordFloats> Values;
  std::memcpy(Words.data(), &G, sizeof(Words));
  for (unsigned N = 0; N != RecordFloats; ++N) {
    const ShadowMemory::Word *W =
        Address ? Memory.find(0, Address + 4 * N, Words[N]) : nullptr;
    Values[N] = W ? W->Value : std::bit_cast<float>(Words[N]);
  }
  return std::bit_cast<ShadowGaussian>(Values);
}

void RasterShadow::Replay::count(RasterStage Which, float Is, double Own,
                                 double Total) {
  StageCounts &To = Out.Stages[static_cast<size_t>(Which)];
  ++To.Results;
  if (!std::isfinite(Is)) {
    ++To.NotFinite;
    return;
  }
  To.Subnormal += Is != 0 && std::fabs(Is) < 0x1p-126F;
  // An error of the power is what it makes of the exponential: absolute.
  const auto ErrorFrom = [&](double Should) {
    return Which == RasterStage::Power ? std::min(std::fabs(Is - Should), 1.0)
                                       : relativeError(Is, Should);
  };
  const double OwnError = ErrorFrom(Own), TotalError = ErrorFrom(Total);
  To.OwnSum += OwnError;
  To.TotalSum += TotalError;
  To.TotalMax = std::max(To.TotalMax, TotalError);
  if (OwnError <= To.OwnMax)
    return;
  To.OwnMax = OwnError;
  To.Gaussian = Number;
  To.X = Task.X + X;
  To.Y = Task.Y + Y;
  To.Actual = Is;
  To.Reference = Own;
}

/// Finds the box, and the pixels that the shadow's box has more or less.
void RasterShadow::Replay::compareBoxes(const Gaussian &G,
                                        const ShadowGaussian &S) {
  std::array<uint64_t, 2> Is{}, Should{}, Both{};
  for (unsigned Axis = 0; Axis != 2; ++Axis) {
    const float *Centres = Axis == 0 ? T.Real.CentreX : T.Real.CentreY;
    std::array<bool, Side> &In = Axis == 0 ? InX : InY;
    for (unsigned I = 0; I != Side; ++I) {
      In[I] = std::fabs(Centres[I] - G.Mean[Axis]) <= G.Extent[Axis];
      const bool Shadows =
          std::fabs(Centres[I] - S.Mean[Axis]) <= S.Extent[Axis];
      Is[Axis] += In[I];
      Should[Axis] += Shadows;
      Both[Axis] += In[I] && Shadows;
    }
  }
  if (const uint64_t Pixels =
          Is[0] * Is[1] + Should[0] * Should[1] - 2 * Both[0] * Both[1])
    differ(RasterStage::Offset, Pixels);
}

/// The open pixels of a row of the box whose alpha may count.
void RasterShadow::Replay::collect(const Gaussian &G, const ShadowGaussian &S,
                                   unsigned AtRow) {
  // By more than any unit's error.
  const double Bound = std::log(Task.Blend.MinAlpha / G.Opacity) - 0.25;
  const float Dy = G.Mean[1] - T.Real.CentreY[AtRow];
  const double Dy2 = S.Mean[1] - T.Real.CentreY[AtRow];
  for (unsigned Column = 0; Column != Side; ++Column) {
    const unsigned At = AtRow * Side + Column;
    if (!InX[Column] || std::signbit(T.Real.T[At]))
      continue;
    const float Dx = G.Mean[0] - T.Real.CentreX[Column];
    const double Dx2 = S.Mean[0] - T.Real.CentreX[Column];
    const auto PowerOf = [](const auto &Conic, auto U, auto V) {
      using Number = decltype(U);
      return Number(-0.5) * (Conic[0] * U * U + Conic[2] * V * V) -
             Conic[1] * U * V;
    };
    const float Power = PowerOf(G.Conic, Dx, Dy);
    const double Conic[] = {G.Conic[0], G.Conic[1], G.Conic[2]};
    const double Power2 = PowerOf(S.Conic, Dx2, Dy2);
    if ((Power <= 0) != (Power2 <= 0))
      differ(RasterStage::Power);
    if (!(Power <= 0) || Power < Bound)
      continue;
    Fragments.push_back({At, Column, Rows.size(), Power,
                         PowerOf(Conic, double{Dx}, double{Dy}), Power2});
    X = Column;
    count(RasterStage::Offset, Dx, double{G.Mean[0]} - T.Real.CentreX[Column],
          Dx2);
    count(RasterStage::Offset, Dy, double{G.Mean[1]} - T.Real.CentreY[AtRow],
          Dy2);
  }
}

/// A fragment after the datapath has blended it, or not.
void RasterShadow::Replay::judge(const Gaussian &G, const ShadowGaussian &S,
                                 const Fragment &F, float Exp,
                                 const Row &Before) {
  const unsigned At = F.At;
  const float Wanted = G.Opacity * Exp;
  const double Exp2 = std::exp(F.Power2), Wanted2 = S.Opacity * Exp2;
  const bool Counts = Wanted >= Task.Blend.MinAlpha;
  if (Counts != (Wanted2 >= Task.Blend.MinAlpha))
    differ(RasterStage::Alpha);
  if (!Counts && !(Wanted2 >= Task.Blend.MinAlpha))
    return;
  count(RasterStage::Power, F.Power, F.OwnPower, F.Power2);
  count(RasterStage::Exp, Exp, std::exp(double{F.Power}), Exp2);
  if ((Wanted < static_cast<float>(MaxAlpha)) != (Wanted2 < MaxAlpha))
    differ(RasterStage::Alpha);
  const float Alpha = std::min(Wanted, static_cast<float>(MaxAlpha));
  const double Alpha2 = std::min(Wanted2, MaxAlpha);
  count(RasterStage::Alpha, Alpha, std::min(double{G.Opacity} * Exp, MaxAlpha),
        Alpha2);
  if (!Counts)
    return;
  Current->AlphaMax = std::max(Current->AlphaMax, relativeError(Alpha, Alpha2));

  const double NextT2 = T.T[At] * (1 - Alpha2);
  const bool Stops = std::signbit(T.Real.T[At]);
  if (Stops != (NextT2 < Task.Blend.StopBelow))
    differ(RasterStage::Transmittance);
  if (Stops)
    return;
  ++Current->Fragments;
  const double OldT = Before.T[F.Column], OldT2 = T.T[At];
  count(RasterStage::Transmittance, T.Real.T[At], OldT * (1 - double{Alpha}),
        NextT2);
  T.T[At] = NextT2;
  const float *Planes[] = {T.Real.R, T.Real.G, T.Real.B};
  const float Old[] = {Before.R[F.Column], Before.G[F.Column],
                       Before.B[F.Column]};
  double Off = 0;
  for (unsigned N = 0; N != 3; ++N) {
    const double Shadow = T.Color[N][At] + S.Color[N] * (Alpha2 * OldT2);
    count(RasterStage::Colour, Planes[N][At],
          Old[N] + double{G.Color[N]} * (double{Alpha} * OldT), Shadow);
    Off = std::max(Off, std::fabs((double{Planes[N][At]} - Old[N]) -
                                  (Shadow - T.Color[N][At])));
    T.Color[N][At] = Shadow;
  }
  Current->Colour += Off;
}

void RasterShadow::Replay::blend(const Gaussian &G, uint32_t GaussianNumber,
                                 uint32_t Address) {
  Number = GaussianNumber;
  Current = &Out.Gaussians[Number];
  const ShadowGaussian S = shadowOf(G, Address);
  compareBoxes(G, S);
  // The rows as they are, then all of them blended.
  Rows.clear();
  Fragments.clear();
  for (Y = 0; Y != Side; ++Y) {
    if (!InY[Y] || T.Real.RowLive[Y] == 0)
      continue;
    collect(G, S, Y);
    Row &R = Rows.emplace_back();
    std::copy_n(T.Real.R + Y * Side, Side, R.R.begin());
    std::copy_n(T.Real.G + Y * Side, Side, R.G.begin());
    std::copy_n(T.Real.B + Y * Side, Side, R.B.begin());
    std::copy_n(T.Real.T + Y * Side, Side, R.T.begin());
  }
  constexpr size_t Lanes16 = 16; // what the units take at a time
  Exps.assign((Fragments.size() + Lanes16 - 1) / Lanes16 * Lanes16, 0.0F);
  for (size_t N = 0; N != Fragments.size(); ++N)
    Exps[N] = Fragments[N].Power;
  Lanes.Exp[raster::expRow(Task.Units.Exp)](Exps.data(), Exps.size());
  blendFunction<Gaussian>(Task, Lanes)(G, Task.Blend, T.Real);
  for (size_t N = 0; N != Fragments.size(); ++N) {
    X = Fragments[N].Column;
    Y = Fragments[N].At / Side;
    judge(G, S, Fragments[N], Exps[N], Rows[Fragments[N].Row]);
  }
}

bool RasterShadow::Replay::blendList(RasterMemory &Storage, uint64_t Entries,
                                     uint32_t Before) {
  const GaussianList List(Task, Storage);
  Fetched Entry;
  for (uint64_t N = 0; N != Entries && T.Ranges->goTo(T.Done); ++N, ++T.Done) {
    if (List.fetch(T.Done - Before, Entry) != VR_OK)
      return false;
    blend(Entry.Record,
          (Entry.Address - Task.Gaussians) / uint32_t{sizeof(Gaussian)},
          Entry.Address);
  }
  return true;
}

RasterShadow::RasterShadow(NumericSites &Sites, ShadowMemory &MemoryIn,
                           const Datapath &LanesIn)
    : Memory(MemoryIn), Lanes(LanesIn),
      Site(Sites.unitNumber("the rasterizer")) {}

RasterShadow::~RasterShadow() = default;

void RasterShadow::runBegins(const RunStart &R) {
  HandedOver.clear(); // of a run that did not end well
  Machines = std::make_unique<MachineMemory>(*R.Device);
  Global = Machines.get();
}

/// The pixels as the units wrote them get their shadows.
void RasterShadow::finish(const Job &Task, const Tile &T) {
  for (unsigned Y = 0; Y != Task.Height; ++Y) {
    const std::byte *Row = Task.Drains ? nullptr : outputRow(Task, *Global, Y);
    for (unsigned X = 0; X != Task.Width; ++X) {
      const unsigned At = Y * Side + X;
      const Pixel Written = T.Ranges->written(Y, X);
      PixelFinding F{Task.X + X,
                     Task.Y + Y,
                     Written,
                     {T.Color[0][At], T.Color[1][At], T.Color[2][At],
                      std::copysign(T.T[At], double{Written.T})},
                     0};
      const float Is[] = {F.Actual.R, F.Actual.G, F.Actual.B};
      for (unsigned N = 0; N != 3; ++N)
        F.Off = std::max(F.Off, std::fabs(Is[N] - F.Reference[N]));
      ++Found.Pixels;
      Found.OffSum += F.Off;
      std::vector<PixelFinding> &Worst = Found.WorstPixels;
      if (Worst.size() < RasterFindings::WorstKept ||
          F.Off > Worst.back().Off) {
        Worst.insert(std::upper_bound(Worst.begin(), Worst.end(), F,
                                      [](const auto &A, const auto &B) {
                                        return A.Off > B.Off;
                                      }),
                     F);
        Worst.resize(std::min(Worst.size(), RasterFindings::WorstKept));
      }
      if (!Row)
        continue;
      std::array<uint32_t, 4> Words;
      std::memcpy(Words.data(), Row + X * sizeof(Pixel), sizeof(Words));
      Found.NotReplayed += Words != std::bit_cast<decltype(Words)>(F.Actual);
      const uint32_t Address =
          Task.Output + Y * Task.OutputPitch + X * uint32_t{sizeof(Pixel)};
      for (unsigned N = 0; N != 4; ++N)
        Memory.set(0, Address + 4 * N,
                   {F.Reference[N], Words[N], Origin::site(Site).word()});
    }
  }
}

void RasterShadow::rasterCommand(const raster::CommandWork &W) {
  const Job &Task = W.What;
  // Gradients go to the core, which follows them no further. What a tile has
  // loaded is not there any more. Other kinds than conics have no shadow.
  if (Task.Refusal || Task.IsBackward || !Task.Units.isConic() ||
      Task.LoadsPixels)
    return;
  auto T = std::make_unique<Tile>();
  T->reset(Task, *Global);
  T->Done = W.First;
  Replay R(*this, Task, *T);
  // The unit says how far it went; what it refused has no result.
  const uint64_t Fetched = W.Counts.Gaussians;
  if (Task.TakesPushed) {
    for (uint64_t N = 0; N != Fetched; ++N, ++T->Done) {
      const Gaussian &G = W.Pushed[T->Done];
      T->Ranges->goTo(T->Done);
      if (checkRecord(G) != VR_OK)
        return;
      R.blend(G, G.Tag & ~VR_INTERSECT, 0);
    }
  } else {
    if (!R.blendList(*Global, Fetched))
      return;
    if (T->Done != Task.Count && T->Ranges->left() != 0) {
      if (!Task.mayHandOver())
        return; // the next record is not there
      HandedOver[{W.Core, Task.Output}] = std::move(T);
      return;
    }
  }
  ++Found.Commands;
  finish(Task, *T);
}

void RasterShadow::tail(const raster::TailWork &W) {
  const auto Handed = HandedOver.find({W.Core, W.What.Output});
  if (Handed == HandedOver.end())
    return;
  const std::unique_ptr<Tile> T = std::move(Handed->second);
  HandedOver.erase(Handed);
  if (W.What.Refusal)
    return;
  Replay R(*this, W.What, *T);
  if (!R.blendList(*Global, W.What.Count, T->Done))
    return;
  ++Found.Commands;
  ++Found.Tails;
  finish(W.What, *T);
}

} // namespace vorion::isasim
