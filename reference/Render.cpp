#include "Render.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

namespace vorion::reference {
namespace {

/// What is added up over a tile.
struct Counts {
  std::uint64_t Blends = 0, Walked = 0, Saturated = 0;
};

/// The support's border as pixels may see it: everything inside \c Inner is
/// surely in the support, everything outside \c Outer is surely not.
struct Border {
  double InnerX0, InnerX1, InnerY0, InnerY1;
  double OuterX0, OuterX1, OuterY0, OuterY1;

  bool doubtful(double X, double Y) const {
    const bool Inside =
        InnerX0 <= X && X <= InnerX1 && InnerY0 <= Y && Y <= InnerY1;
    const bool Outside =
        X < OuterX0 || OuterX1 < X || Y < OuterY0 || OuterY1 < Y;
    return !Inside && !Outside;
  }
};

/// A splat as the pixels of a tile read it.
template <typename Real> struct Candidate {
  glm::vec<2, Real> Mean, Extent;
  glm::vec<3, Real> Conic, Color;
  Real Opacity;
  std::uint32_t NearestKey, FarthestKey; ///< that z may be rounded to
  Rect Official;                         ///< pixels, for Official16
  Border Edge;                           ///< for supports with a border
  std::int32_t Index;
  bool Listed; ///< in the tile's list, and not only doubtfully so
};

/// Watches the sort keys of the Gaussians that a pixel sees, front to back.
class DepthOrder {
public:
  /// Takes the next one; true if it may belong before an earlier one. Equal
  /// keys are in the order of the indices on every machine.
  bool doubtful(std::uint32_t NearestKey, std::uint32_t FarthestKey,
                std::int32_t Index) {
    const bool Doubtful = std::pair(NearestKey, Index) < Farthest;
    Farthest = std::max(Farthest, std::pair(FarthestKey, Index));
    return Doubtful;
  }

private:
  /// The last place that an earlier one may have.
  std::pair<std::uint32_t, std::int32_t> Farthest{0, -1};
};

bool near(double Value, double Threshold) {
  return std::abs(Value - Threshold) <= DoubtBand * Threshold;
}

/// For the exact support the border is where alpha is 1/255, which \c near
/// judges; the outer side then only says which tiles to look at.
template <typename Real>
Border borderOf(const Splat<Real> &S, Support Reach, int Width, int Height) {
  const double Mx = S.Mean.x, My = S.Mean.y;
  if (Reach == Support::Box3 || Reach == Support::Exact) {
    const double In = 1 - DoubtBand, Out = 1 + DoubtBand;
    double Ex = S.Extent.x, Ey = S.Extent.y;
    if (Reach == Support::Exact) {
      const double E = std::sqrt(
          2 * std::log(255 * Out * std::max(double(S.Opacity), 1. / 255)));
      Ex = E * std::sqrt(double(S.Covariance[0]));
      Ey = E * std::sqrt(double(S.Covariance[2]));
    }
    return {Mx - Ex * In,  Mx + Ex * In,  My - Ey * In,  My + Ey * In,
            Mx - Ex * Out, Mx + Ex * Out, My - Ey * Out, My + Ey * Out};
  }
  // Rounding up makes the radius itself a decision.
  const double Least = std::ceil(S.CircleRadius * (1 - DoubtBand));
  const double Most = std::ceil(S.CircleRadius * (1 + DoubtBand));
  if (Reach == Support::Square3) {
    const double In = Least * (1 - DoubtBand), Out = Most * (1 + DoubtBand);
    return {Mx - In,  Mx + In,  My - In,  My + In,
            Mx - Out, Mx + Out, My - Out, My + Out};
  }
  // The tile decision takes mean -+ radius, whose rounding in fp32 is relative
  // to the larger of the two.
  const auto Slack = [](double M, double R) {
    return DoubtBand * std::max(std::abs(M), R);
  };
  const auto Pixels = [&](double R, double Sign) {
    const double R0 = R + Sign * std::max(Slack(Mx, R), Slack(My, R));
    return officialPixels(glm::dvec2(S.Mean), R0, Width, Height);
  };
  const Rect In = Pixels(Least, -1), Out = Pixels(Most, 1);
  return {double(In.X0),  double(In.X1),  double(In.Y0),  double(In.Y1),
          double(Out.X0), double(Out.X1), double(Out.Y0), double(Out.Y1)};
}

/// All tiles that hold a pixel of \p B's outer side.
Rect outerTiles(const Border &B, const TileGrid &Grid) {
  const auto At = [&](double Value, int Count) {
    return static_cast<int>(
        std::clamp(std::floor(Value / Grid.Size), -1.0, double(Count)));
  };
  return {std::max(At(B.OuterX0, Grid.Columns), 0),
          std::max(At(B.OuterY0, Grid.Rows), 0),
          std::min(At(B.OuterX1, Grid.Columns) + 1, Grid.Columns),
          std::min(At(B.OuterY1, Grid.Rows) + 1, Grid.Rows)};
}

template <typename Real> class Blender {
public:
  Blender(const std::vector<Splat<Real>> &Splats, const Options &O,
          Picture<Real> &P)
      : Splats(Splats), O(O), P(P), Grid(O.TileSize, P.Width, P.Height),
        Cutoff(static_cast<Real>(O.Cutoff)),
        Background(O.Background[0], O.Background[1], O.Background[2]),
        Lists(Grid.count()) {
    // As tileLists, but with everything whose place in a list is doubtful.
    for (const std::uint32_t I : depthOrder(Splats)) {
      const Rect R =
          outerTiles(borderOf(Splats[I], O.Reach, P.Width, P.Height), Grid);
      for (int Y = R.Y0; Y < R.Y1; ++Y)
        for (int X = R.X0; X < R.X1; ++X)
          Lists[Grid.index(X, Y)].push_back(I);
    }
  }

  std::size_t tiles() const { return Lists.size(); }

  Counts tile(std::size_t Tile) const {
    const int Column = static_cast<int>(Tile) % Grid.Columns;
    const int Row = static_cast<int>(Tile) / Grid.Columns;
    std::vector<Candidate<Real>> List;
    List.reserve(Lists[Tile].size());
    for (const std::uint32_t I : Lists[Tile])
      List.push_back(candidate(I, Column, Row));
    const int X0 = Column * Grid.Size, Y0 = Row * Grid.Size;
    Counts Sum;
    for (int Y = Y0; Y < std::min(Y0 + Grid.Size, P.Height); ++Y)
      for (int X = X0; X < std::min(X0 + Grid.Size, P.Width); ++X)
        pixel(List, X, Y, Sum);
    return Sum;
  }

private:
  Candidate<Real> candidate(std::uint32_t I, int Column, int Row) const {
    const Splat<Real> &S = Splats[I];
    Candidate<Real> C;
    C.Mean = S.Mean;
    C.Extent = S.Extent;
    C.Conic = S.Conic;
    C.Color = S.Color;
    C.Opacity = S.Opacity;
    C.NearestKey = depthBits(double(S.Depth) - S.DepthSlack);
    C.FarthestKey = depthBits(double(S.Depth) + S.DepthSlack);
    C.Official = officialPixels(S.Mean, S.Extent.x, P.Width, P.Height);
    C.Edge = borderOf(S, O.Reach, P.Width, P.Height);
    C.Index = static_cast<std::int32_t>(I);
    C.Listed = tilesOf(S, O.Reach, Grid).contains(Column, Row);
    return C;
  }

  bool inSupport(const Candidate<Real> &C, Real Dx, Real Dy, int X,
                 int Y) const {
    if (O.Reach == Support::Exact)
      return true;
    if (O.Reach == Support::Official16)
      return C.Official.contains(X, Y);
    return std::abs(Dx) <= C.Extent.x && std::abs(Dy) <= C.Extent.y;
  }

  bool saturates(Real T) const {
    return O.Rule == Rules::Inria ? T < Cutoff : T <= Cutoff;
  }

  void pixel(const std::vector<Candidate<Real>> &List, int X, int Y,
             Counts &Sum) const {
    const Real Px = Real(X) + Real(0.5), Py = Real(Y) + Real(0.5);
    Real T = 1;
    glm::vec<3, Real> Color(0);
    std::uint8_t Doubts = 0;
    std::int32_t Last = -1, Stop = -1;
    DepthOrder Order;
    for (const Candidate<Real> &C : List) {
      Sum.Walked += C.Listed;
      const Real Dx = C.Mean.x - Px, Dy = C.Mean.y - Py;
      const bool Inside = inSupport(C, Dx, Dy, X, Y);
      const bool EdgeInDoubt =
          O.Reach != Support::Exact && C.Edge.doubtful(Px, Py);
      if (!Inside && !EdgeInDoubt)
        continue;
      const Real Power =
          Real(-0.5) * (C.Conic[0] * Dx * Dx + C.Conic[2] * Dy * Dy) -
          C.Conic[1] * Dx * Dy;
      if (!(Power <= 0))
        continue;
      // Through double: correctly rounded in fp32 but for rare ties.
      const Real Alpha =
          std::min(mostAlpha<Real>(),
                   C.Opacity * static_cast<Real>(std::exp(double(Power))));
      if (near(Alpha, leastAlpha<double>()) ||
          (EdgeInDoubt && Alpha >= leastAlpha<Real>()))
        Doubts |= DoubtThreshold;
      if (!Inside || Alpha < leastAlpha<Real>())
        continue;
      if (Order.doubtful(C.NearestKey, C.FarthestKey, C.Index))
        Doubts |= DoubtOrder;
      const Real Next = T * (1 - Alpha);
      if (near(Next, O.Cutoff))
        Doubts |= DoubtThreshold;
      if (saturates(Next)) {
        ++Sum.Saturated;
        Stop = C.Index;
        break;
      }
      Color += C.Color * (Alpha * T);
      T = Next;
      Last = C.Index;
      ++Sum.Blends;
    }
    const auto At =
        static_cast<std::size_t>(Y) * static_cast<std::size_t>(P.Width) +
        static_cast<std::size_t>(X);
    P.Render[At] = Color + T * Background;
    P.Transmittance[At] = T;
    P.Doubts[At] = Doubts;
    P.Last[At] = Last;
    P.Stop[At] = Stop;
  }

  const std::vector<Splat<Real>> &Splats;
  const Options &O;
  Picture<Real> &P;
  TileGrid Grid;
  Real Cutoff;
  glm::vec<3, Real> Background;
  std::vector<std::vector<std::uint32_t>> Lists;
};

} // namespace

template <typename Real> double Picture<Real>::doubtfulShare() const {
  const auto Doubtful = std::count_if(Doubts.begin(), Doubts.end(),
                                      [](std::uint8_t D) { return D != 0; });
  return Doubts.empty() ? 0 : double(Doubtful) / double(Doubts.size());
}

template <typename Real>
Picture<Real> blend(const std::vector<Splat<Real>> &Splats, int Width,
                    int Height, const Options &O) {
  Picture<Real> P;
  P.Width = Width;
  P.Height = Height;
  const std::size_t Pixels =
      static_cast<std::size_t>(Width) * static_cast<std::size_t>(Height);
  P.Render.resize(Pixels);
  P.Transmittance.resize(Pixels);
  P.Doubts.resize(Pixels);
  P.Last.resize(Pixels);
  P.Stop.resize(Pixels);

  // Tiles write pixels of their own, and counts are integers, so that neither
  // the number of threads nor their order shows in the result.
  std::atomic<std::size_t> NextTile = 0;
  std::atomic<std::uint64_t> Blends = 0, Walked = 0, Saturated = 0;
  const Blender<Real> B(Splats, O, P);
  const auto Work = [&] {
    Counts Sum;
    for (std::size_t T = NextTile++; T < B.tiles(); T = NextTile++) {
      const Counts C = B.tile(T);
      Sum.Blends += C.Blends;
      Sum.Walked += C.Walked;
      Sum.Saturated += C.Saturated;
    }
    Blends += Sum.Blends;
    Walked += Sum.Walked;
    Saturated += Sum.Saturated;
  };
  const unsigned Threads =
      O.Threads ? O.Threads : std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::thread> Others;
  for (unsigned I = 1; I < Threads; ++I)
    Others.emplace_back(Work);
  Work();
  for (std::thread &Other : Others)
    Other.join();
  P.Blends = Blends;
  P.Walked = Walked;
  P.Saturated = Saturated;
  return P;
}

template <typename Real>
Picture<Real> render(const Gaussians<Real> &G, const Camera<Real> &C,
                     const Options &O) {
  return blend(project(G, C, O), C.Width, C.Height, O);
}

template struct Picture<float>;
template struct Picture<double>;
template Picture<float> blend(const std::vector<Splat<float>> &, int, int,
                              const Options &);
template Picture<double> blend(const std::vector<Splat<double>> &, int, int,
                               const Options &);
template Picture<float> render(const Gaussians<float> &, const Camera<float> &,
                               const Options &);
template Picture<double> render(const Gaussians<double> &,
                                const Camera<double> &, const Options &);

} // namespace vorion::reference
