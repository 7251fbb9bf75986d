// The datapath for one vector level: compiled once for each, with the level's
// flags and VORION_LEVEL naming it. Includes nothing that defines functions
// which other files could share (see Vector.h).
#include "raster/BlendVector.h"
#include "raster/Blended.h"
#include "raster/Datapath.h"

namespace vorion::raster {
namespace {

template <typename Body, typename Exp, typename Arithmetic>
BoxWork blend(const typename Body::Record &G, const BlendOptions &Options,
              TileBuffer &Tile) {
  const CutBox Box = Body::box(G, Tile.CentreX, Tile.CentreY);
  if (Box.Missed)
    return missed();

  const unsigned Groups = (Box.LastX - Box.FirstX) / LaneCount + 1;
  // As few vectors as the width allows, none beyond the row's end.
  const unsigned Latest = TileBuffer::Stride - Groups * LaneCount;
  const unsigned Start = Box.FirstX < Latest ? Box.FirstX : Latest;

  typename Body::Columns Column[Blocks];
  for (unsigned I = 0; I != Groups; ++I)
    Column[I] = Body::columns(Start + I * LaneCount, G, Tile.CentreX);

  const float Bound = powerBound(G.Opacity, Options.MinAlpha, Exp::Margin);
  const Float16 OfRed = Arithmetic::operand(G.Color[0]);
  const Float16 OfGreen = Arithmetic::operand(G.Color[1]);
  const Float16 OfBlue = Arithmetic::operand(G.Color[2]);
  const auto SignBit = Int16(static_cast<int32_t>(0x80000000U));
  unsigned Blends = 0;
  unsigned LiveInBox = 0;
  for (unsigned Row = Box.FirstY; Row <= Box.LastY; ++Row) {
    if (Tile.RowLive[Row] == 0)
      continue;
    const typename Body::Row Terms = Body::row(G, Tile.CentreY[Row]);
    for (unsigned I = 0; I != Groups; ++I) {
      const typename Body::Columns &C = Column[I];
      const unsigned At = Row * TileBuffer::Stride + C.First;
      const Float16 T = load(Tile.T + At);
      const Int16 Open = C.Inside & (__builtin_bit_cast(Int16, T) >= 0);
      if (Options.SkipSaturated)
        LiveInBox += countBits(bits(Open));

      const auto [Counts, Wanted] =
          reach<Exp>(Body::power(G, C, Terms, Options.Falloff), G.Opacity, Open,
                     Bound, Options.MinAlpha);
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
        uint32_t *Last = Tile.Last + At;
        store(Last, Blended ? Int16(static_cast<int32_t>(Options.Entry + 1))
                            : load(Last));
      }
      Blends += countBits(bits(Blended));
      if (const uint32_t Stopped = bits(Stops)) {
        Tile.RowLive[Row] -= countBits(Stopped);
        Tile.Live -= countBits(Stopped);
      }
    }
  }
  return workOf(Box,
                Options.SkipSaturated ? LiveInBox : Box.width() * Box.height(),
                Blends);
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

using Arithmetics = Bodies<BlendBody, BlendUnitCount>;

template <typename Body, typename Exp, typename... As>
constexpr void setBlends(BlendFunction<typename Body::Record> *To,
                         List<As...>) {
  ((*To++ = blend<Body, Exp, As>), ...);
}

template <typename Body, typename... Es>
constexpr BlendTable<typename Body::Record> makeBlends(List<Es...>) {
  BlendTable<typename Body::Record> T{};
  std::size_t Unit = 0;
  (setBlends<Body, Es>(T.Of[Unit++], Arithmetics()), ...);
  return T;
}

template <typename... Es, typename... As>
constexpr Datapath makeDatapath(const char *Name, bool (*HostSupports)(),
                                List<Es...> All, List<As...>) {
  return {Name,
          HostSupports,
          makeBlends<BlendedBody<VR_PRIMITIVE_CONIC>>(All),
          makeBlends<BlendedBody<VR_PRIMITIVE_RAY>>(All),
          {evaluate<Es>...},
          {roundOperands<As>...}};
}

} // namespace

extern const Datapath VORION_JOIN(Datapath_, VORION_LEVEL);
constexpr Datapath VORION_JOIN(Datapath_, VORION_LEVEL) = makeDatapath(
    VORION_STRING(VORION_LEVEL), hostHasLevel, Exps(), Arithmetics());

} // namespace vorion::raster
