// The datapath for one vector level: compiled once for each, with the level's
// flags and VORION_LEVEL naming it. Includes nothing that defines functions
// which other files could share (see Vector.h).
#include "raster/BlendVector.h"
#include "raster/Datapath.h"
#include "raster/DatapathParts.h"

namespace vorion::raster {
namespace {

/// What of a Gaussian is the same in all rows, for the 16 columns from First.
struct Columns {
  unsigned First;
  Int16 Inside;
  Float16 AX2; ///< a * dx * dx
  Float16 BX;  ///< b * dx
};

template <typename Exp, typename Arithmetic>
BlendWork blend(const Gaussian &G, const BlendOptions &Options,
                TileBuffer &Tile) {
  const CutBox Box = cutBox(G, Tile.CentreX, Tile.CentreY);
  if (Box.Missed)
    return {0, 0, true, 0, 0, 0, 0};

  const unsigned Groups = (Box.LastX - Box.FirstX) / LaneCount + 1;
  // As few vectors as the width allows, none beyond the row's end.
  const unsigned Latest = TileBuffer::Stride - Groups * LaneCount;
  const unsigned Start = Box.FirstX < Latest ? Box.FirstX : Latest;

  Columns Column[Blocks];
  for (unsigned I = 0; I != Groups; ++I) {
    Columns &C = Column[I];
    C.First = Start + I * LaneCount;
    const Float16 Dx = G.Mean[0] - load(Tile.CentreX + C.First);
    C.Inside = __builtin_elementwise_abs(Dx) <= G.Extent[0];
    C.AX2 = G.Conic[0] * Dx * Dx;
    C.BX = G.Conic[1] * Dx;
  }

  const float Bound = powerBound(G.Opacity, Options.MinAlpha, Exp::Margin);
  const float MinAlpha = Options.MinAlpha;
  const Float16 OfRed = Arithmetic::operand(G.Color[0]);
  const Float16 OfGreen = Arithmetic::operand(G.Color[1]);
  const Float16 OfBlue = Arithmetic::operand(G.Color[2]);
  const auto SignBit = Int16(static_cast<std::int32_t>(0x80000000U));
  unsigned Blends = 0;
  unsigned LiveInBox = 0;
  for (unsigned Row = Box.FirstY; Row <= Box.LastY; ++Row) {
    if (Tile.RowLive[Row] == 0)
      continue;
    const float Dy = G.Mean[1] - Tile.CentreY[Row];
    const float CY2 = G.Conic[2] * Dy * Dy;
    for (unsigned I = 0; I != Groups; ++I) {
      const Columns &C = Column[I];
      const unsigned At = Row * TileBuffer::Stride + C.First;
      const Float16 T = load(Tile.T + At);
      const Int16 Open = C.Inside & (__builtin_bit_cast(Int16, T) >= 0);
      if (Options.SkipSaturated)
        LiveInBox += countBits(bits(Open));

      const Float16 Power = -0.5F * (C.AX2 + CY2) - C.BX * Dy;
      const Int16 Near = Open & (Power <= 0.0F) & ~(Power < Bound);
      if (bits(Near) == 0)
        continue;
      const Float16 Wanted = G.Opacity * Exp::evaluate(Power);
      const Int16 Counts = Near & (Wanted >= MinAlpha);
      if (bits(Counts) == 0)
        continue;
      const Float16 Alpha = Wanted < MaxAlpha ? Wanted : Float16(MaxAlpha);
      const auto [NextT, Weight] = Arithmetic::step(Alpha, T);
      const Int16 Stops = Counts & (NextT < Options.StopBelow);
      const Int16 Blended = Counts & ~Stops;

      const Float16 Red = load(Tile.R + At);
      const Float16 Green = load(Tile.G + At);
      const Float16 Blue = load(Tile.B + At);
      store(Tile.R + At, Blended ? Red + OfRed * Weight : Red);
      store(Tile.G + At, Blended ? Green + OfGreen * Weight : Green);
      store(Tile.B + At, Blended ? Blue + OfBlue * Weight : Blue);
      const Float16 KeptT = Blended ? NextT : T;
      store(Tile.T + At,
            __builtin_bit_cast(Float16, __builtin_bit_cast(Int16, KeptT) |
                                            (Stops & SignBit)));
      if (Options.KeepLast) {
        std::uint32_t *Last = Tile.Last + At;
        store(Last, Blended
                        ? Int16(static_cast<std::int32_t>(Options.Entry + 1))
                        : load(Last));
      }
      Blends += countBits(bits(Blended));
      if (const std::uint32_t Stopped = bits(Stops)) {
        Tile.RowLive[Row] -= countBits(Stopped);
        Tile.Live -= countBits(Stopped);
      }
    }
  }
  return {Options.SkipSaturated ? LiveInBox : Box.width() * Box.height(),
          Blends,
          false,
          static_cast<std::uint8_t>(Box.FirstX),
          static_cast<std::uint8_t>(Box.FirstY),
          static_cast<std::uint8_t>(Box.width()),
          static_cast<std::uint8_t>(Box.height())};
}

template <typename Exp> void evaluate(float *Values, std::size_t Count) {
  for (std::size_t I = 0; I != Count; I += LaneCount)
    store(Values + I, Exp::evaluate(load(Values + I)));
}

template <typename Arithmetic>
void roundOperands(float *Values, std::size_t Count) {
  for (std::size_t I = 0; I != Count; I += LaneCount)
    store(Values + I, Arithmetic::operand(load(Values + I)));
}

/// In the order of their options.
using Arithmetics = List<Fp32Blend, NarrowBlend<Bf16>, NarrowBlend<Fp16>>;

template <typename Exp, typename... As>
constexpr void setBlends(Datapath::BlendFunction *To, List<As...>) {
  ((*To++ = blend<Exp, As>), ...);
}

template <typename... Es, typename... As>
constexpr Datapath makeDatapath(const char *Name, bool (*HostHasIt)(),
                                List<Es...>, List<As...> All) {
  static_assert(sizeof...(Es) == ExpUnitCount);
  static_assert(sizeof...(As) == BlendUnitCount);
  Datapath D{Name, HostHasIt, {}, {evaluate<Es>...}, {roundOperands<As>...}};
  std::size_t Unit = 0;
  (setBlends<Es>(D.Blend[Unit++], All), ...);
  return D;
}

} // namespace

extern const Datapath VORION_JOIN(Datapath_, VORION_LEVEL);
constexpr Datapath VORION_JOIN(Datapath_, VORION_LEVEL) = makeDatapath(
    VORION_STRING(VORION_LEVEL), hostHasLevel, Exps(), Arithmetics());

} // namespace vorion::raster
