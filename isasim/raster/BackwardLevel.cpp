// The backward datapath for one vector level, as DatapathLevel.cpp.
#include "raster/Backward.h"
#include "raster/Blended.h"
#include "raster/ReciprocalVector.h"

namespace vorion::raster {
namespace {

using Conic = BlendedBody<VR_PRIMITIVE_CONIC>;

constexpr unsigned SumCount = 9;

/// Of each sum, one part for every column modulo 16.
struct Columns16 {
  Float16 Sum[SumCount];
};

VORION_INLINE Columns16 zeroColumns() {
  Columns16 C;
  for (Float16 &S : C.Sum)
    S = 0.0F;
  return C;
}

VORION_INLINE void add(Columns16 &To, const Columns16 &From) {
  for (unsigned K = 0; K != SumCount; ++K)
    To.Sum[K] += From.Sum[K];
}

/// Adds rows up as a binary tree over the tile's rows: node n of a level is the
/// sum of nodes 2 n and 2 n + 1 of the one below, rows outside the box being 0.
class RowTree {
public:
  /// Takes the rows of a box, none left out, from the first to the last.
  VORION_INLINE void add(unsigned Row, const Columns16 &Part) {
    Columns16 Node = Part;
    unsigned L = 0;
    for (; Row >> L & 1; ++L)
      if (Full >> L & 1) {
        raster::add(Level[L], Node);
        Node = Level[L];
        Full &= ~(1U << L);
      }
    Level[L] = Node;
    Full |= 1U << L;
  }

  VORION_INLINE Columns16 sum() const {
    Columns16 Node = zeroColumns();
    for (unsigned L = 0; L != Levels; ++L)
      if (Full >> L & 1) {
        Columns16 Left = Level[L];
        raster::add(Left, Node);
        Node = Left;
      }
    return Node;
  }

private:
  static constexpr unsigned Levels = 7; ///< of 64 rows
  Columns16 Level[Levels];
  uint32_t Full = 0;
};

/// The 16 columns' tree: halves onto halves.
VORION_INLINE float acrossColumns(Float16 V) {
  const Float8 E = V.lo + V.hi;
  const auto F = E.lo + E.hi;
  const auto T = F.lo + F.hi;
  return T.x + T.y;
}

/// One block of pixels of one row.
struct Block {
  const Conic::Columns &C;
  unsigned At;
  float Dy;
  Float16 Wanted; ///< opacity times falloff
  Int16 Counts;
};

VORION_INLINE void through(const Block &P, const Gaussian &G,
                           const BackwardOptions &Options, BackwardBuffer &Tile,
                           Columns16 &Row) {
  const Float16 Alpha = P.Wanted < MaxAlpha ? P.Wanted : Float16(MaxAlpha);
  const Float16 Behind = load(Tile.Behind + P.At);
  const Float16 Before = load(Tile.T + P.At);
  // Dividing rounds once, and for equal alphas not always the same way: a
  // stack of thousands keeps its transmittance.
  const Float16 T = Options.Unit == Reciprocal::Exact
                        ? Before / (1.0F - Alpha)
                        : Before * reciprocal(Options.Unit, Alpha);
  const Float16 Red = load(Tile.R + P.At);
  const Float16 Green = load(Tile.G + P.At);
  const Float16 Blue = load(Tile.B + P.At);
  const Float16 Light =
      G.Color[0] * Red + G.Color[1] * Green + G.Color[2] * Blue;
  const Float16 Gain = Light - Behind;
  const Float16 Weight = Alpha * T;
  Float16 S = P.Wanted * (T * Gain);
  if (Options.ClampStops)
    S = P.Wanted > MaxAlpha ? Float16(0.0F) : S;
  store(Tile.T + P.At, P.Counts ? T : Before);
  store(Tile.Behind + P.At, P.Counts ? Behind + Alpha * Gain : Behind);

  const Float16 Sx = S * -P.C.Dx;
  const Float16 Sy = S * -P.Dy;
  const Float16 Parts[SumCount] = {
      Weight * Red, Weight * Green, Weight * Blue, S,         Sx,
      Sy,           Sx * -P.C.Dx,   Sx * -P.Dy,    Sy * -P.Dy};
  for (unsigned K = 0; K != SumCount; ++K)
    Row.Sum[K] += P.Counts ? Parts[K] : Float16(0.0F);
}

template <typename Exp>
BoxWork back(const Gaussian &G, const BackwardOptions &Options,
             BackwardBuffer &Tile, GradientSums &Out) {
  Out = {G.Tag, {}};
  const CutBox Box = Conic::box(G, Tile.CentreX, Tile.CentreY);
  if (Box.Missed)
    return missed();

  // Aligned, since a column's place decides where the gather adds it.
  const unsigned FirstBlock = Box.FirstX / LaneCount;
  const unsigned Used = Box.LastX / LaneCount - FirstBlock + 1;
  Conic::Columns Column[Blocks];
  for (unsigned I = 0; I != Used; ++I)
    Column[I] = Conic::columns((FirstBlock + I) * LaneCount, G, Tile.CentreX);

  const float Bound = powerBound(G.Opacity, Options.MinAlpha, Exp::Margin);
  const auto Entry = static_cast<int32_t>(Options.Entry);
  unsigned Blends = 0, LiveInBox = 0;
  RowTree Tree;
  Columns16 Sum = zeroColumns();
  for (unsigned Y = Box.FirstY; Y <= Box.LastY; ++Y) {
    Columns16 Row = zeroColumns();
    const unsigned Skipped = Tile.RowLast[Y] <= Options.Entry ? Used : 0;
    const Conic::Row Terms = Conic::row(G, Tile.CentreY[Y]);
    for (unsigned I = Skipped; I != Used; ++I) {
      const Conic::Columns &C = Column[I];
      const unsigned At = Y * BackwardBuffer::Stride + C.First;
      const Int16 Live = C.Inside & (load(Tile.Last + At) > Entry);
      if (Options.SkipSaturated)
        LiveInBox += countBits(bits(Live));
      const auto [Counts, Wanted] =
          reach<Exp>(Conic::power(G, C, Terms, false), G.Opacity, Live, Bound,
                     Options.MinAlpha);
      if (bits(Counts) == 0)
        continue;
      through({C, At, Terms.Dy, Wanted, Counts}, G, Options, Tile, Row);
      Blends += countBits(bits(Counts));
    }
    if (Options.InRows)
      add(Sum, Row);
    else
      Tree.add(Y, Row);
  }
  if (!Options.InRows)
    Sum = Tree.sum();
  for (unsigned K = 0; K != SumCount; ++K)
    Out.Sums[K] = acrossColumns(Sum.Sum[K]);
  return workOf(Box,
                Options.SkipSaturated ? LiveInBox : Box.width() * Box.height(),
                Blends);
}

void evaluateReciprocals(Reciprocal Unit, float *Values, std::size_t Count) {
  for (std::size_t I = 0; I != Count; I += LaneCount)
    store(Values + I, reciprocal(Unit, load(Values + I)));
}

template <typename... Es>
constexpr BackwardDatapath makeDatapath(const char *Name,
                                        bool (*HostSupports)(), List<Es...>) {
  return {Name, HostSupports, {back<Es>...}, evaluateReciprocals};
}

} // namespace

extern const BackwardDatapath VORION_JOIN(BackwardDatapath_, VORION_LEVEL);
constexpr BackwardDatapath VORION_JOIN(BackwardDatapath_, VORION_LEVEL) =
    makeDatapath(VORION_STRING(VORION_LEVEL), hostHasLevel, Exps());

} // namespace vorion::raster
