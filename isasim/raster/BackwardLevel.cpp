// The backward datapath for one vector level, as DatapathLevel.cpp.
#include "raster/Backward.h"
#include "raster/Blended.h"
#include "raster/ReciprocalVector.h"

namespace vorion::raster {
namespace {

/// Of each of \p Count sums, one part for every column modulo 16.
template <unsigned Count> struct Columns16 {
  Float16 Sum[Count];
};

/// Three of the colour, s, and the front end's moments.
template <typename Body> using SumsOf = Columns16<4 + Body::MomentCount>;

template <unsigned Count> VORION_INLINE Columns16<Count> zeroColumns() {
  Columns16<Count> C;
  for (Float16 &S : C.Sum)
    S = 0.0F;
  return C;
}

template <unsigned Count>
VORION_INLINE void add(Columns16<Count> &To, const Columns16<Count> &From) {
  for (unsigned K = 0; K != Count; ++K)
    To.Sum[K] += From.Sum[K];
}

/// Adds rows up as a binary tree over the tile's rows: node n of a level is the
/// sum of nodes 2 n and 2 n + 1 of the one below, rows outside the box being 0.
template <unsigned Count> class RowTree {
public:
  /// Takes the rows of a box, none left out, from the first to the last.
  VORION_INLINE void add(unsigned Row, const Columns16<Count> &Part) {
    Columns16<Count> Node = Part;
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

  VORION_INLINE Columns16<Count> sum() const {
    Columns16<Count> Node = zeroColumns<Count>();
    for (unsigned L = 0; L != Levels; ++L)
      if (Full >> L & 1) {
        Columns16<Count> Left = Level[L];
        raster::add(Left, Node);
        Node = Left;
      }
    return Node;
  }

private:
  static constexpr unsigned Levels = 7; ///< of 64 rows
  Columns16<Count> Level[Levels];
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
template <typename Body> struct Block {
  const typename Body::Columns &C;
  const typename Body::Row &R;
  unsigned At;
  Float16 Wanted; ///< opacity times falloff
  Int16 Counts;
};

template <typename Body>
VORION_INLINE void through(const Block<Body> &P, const typename Body::Record &G,
                           const BackwardOptions &Options, BackwardBuffer &Tile,
                           SumsOf<Body> &Row) {
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

  SumsOf<Body> Parts{{Weight * Red, Weight * Green, Weight * Blue, S}};
  Body::moments(G, P.C, P.R, Options.Falloff, S, Parts.Sum + 4);
  for (unsigned K = 0; K != 4 + Body::MomentCount; ++K)
    Row.Sum[K] += P.Counts ? Parts.Sum[K] : Float16(0.0F);
}

template <typename Body, typename Exp>
BoxWork back(const typename Body::Record &G, const BackwardOptions &Options,
             BackwardBuffer &Tile, GradientSums &Out) {
  constexpr unsigned Count = 4 + Body::MomentCount;
  Out = {G.Tag, {}};
  const CutBox Box = Body::box(G, Tile.CentreX, Tile.CentreY);
  if (Box.Missed)
    return missed();

  // Aligned, since a column's place decides where the gather adds it.
  const unsigned FirstBlock = Box.FirstX / LaneCount;
  const unsigned Used = Box.LastX / LaneCount - FirstBlock + 1;
  typename Body::Columns Column[Blocks];
  for (unsigned I = 0; I != Used; ++I)
    Column[I] = Body::columns((FirstBlock + I) * LaneCount, G, Tile.CentreX);

  const float Bound = powerBound(G.Opacity, Options.MinAlpha, Exp::Margin);
  const auto Entry = static_cast<int32_t>(Options.Entry);
  unsigned Blends = 0, LiveInBox = 0;
  RowTree<Count> Tree;
  Columns16<Count> Sum = zeroColumns<Count>();
  for (unsigned Y = Box.FirstY; Y <= Box.LastY; ++Y) {
    Columns16<Count> Row = zeroColumns<Count>();
    const unsigned Skipped = Tile.RowLast[Y] <= Options.Entry ? Used : 0;
    const typename Body::Row Terms = Body::row(G, Tile.CentreY[Y]);
    for (unsigned I = Skipped; I != Used; ++I) {
      const typename Body::Columns &C = Column[I];
      const unsigned At = Y * BackwardBuffer::Stride + C.First;
      const Int16 Live = C.Inside & (load(Tile.Last + At) > Entry);
      if (Options.SkipSaturated)
        LiveInBox += countBits(bits(Live));
      const auto [Counts, Wanted] =
          reach<Exp>(Body::power(G, C, Terms, Options.Falloff), G.Opacity, Live,
                     Bound, Options.MinAlpha);
      if (bits(Counts) == 0)
        continue;
      through<Body>({C, Terms, At, Wanted, Counts}, G, Options, Tile, Row);
      Blends += countBits(bits(Counts));
    }
    if (Options.InRows)
      add(Sum, Row);
    else
      Tree.add(Y, Row);
  }
  if (!Options.InRows)
    Sum = Tree.sum();
  for (unsigned K = 0; K != Count; ++K)
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
  return {Name,
          HostSupports,
          {back<BlendedBody<VR_PRIMITIVE_CONIC>, Es>...},
          {back<BlendedBody<VR_PRIMITIVE_RAY>, Es>...},
          {back<SurfelBody, Es>...},
          evaluateReciprocals};
}

} // namespace

extern const BackwardDatapath VORION_JOIN(BackwardDatapath_, VORION_LEVEL);
constexpr BackwardDatapath VORION_JOIN(BackwardDatapath_, VORION_LEVEL) =
    makeDatapath(VORION_STRING(VORION_LEVEL), hostHasLevel, Exps());

} // namespace vorion::raster
