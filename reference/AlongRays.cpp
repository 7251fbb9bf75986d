#include "AlongRays.h"

#include "Footprint.h"
#include "Projection.h"
#include "Ray.h"
#include "SphericalHarmonics.h"
#include "Walk.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace vorion::reference {
namespace {

/// Two depths that are rounded to fp32 may change places within this.
constexpr double DepthRounding = 0x1p-23;

/// A Gaussian in the axes of the camera's pose.
struct Body {
  glm::dvec3 Mean;
  glm::dmat3 Turn;    ///< columns are its axes
  glm::dmat3 Axes;    ///< the same, as long as its deviations
  glm::dvec3 Squares; ///< of the deviations
  double Widest;      ///< the largest of these
  double Deviation;   ///< where alpha is the least that may be blended, squared
};

/// v^T M^-1 v of a symmetric M, its entries being xx, xy, yy.
double throughInverse(const glm::dvec3 &M, double Det, const glm::dvec2 &V) {
  return (M[2] * V.x * V.x - 2 * M[1] * V.x * V.y + M[0] * V.y * V.y) / Det;
}

/// Whether \p B is densest in front of where the ray \p R begins, \p From being
/// the mean from there.
bool isAhead(const Body &B, const PixelRay &R, const glm::dvec3 &From) {
  // t = r' S m / r' S r with the inverse covariance S: its sign is that of the
  // numerator times the squares of all deviations.
  double Sum = 0;
  for (int K = 0; K < 3; ++K)
    Sum += glm::dot(B.Turn[K], R.Direction) * glm::dot(B.Turn[K], From) *
           B.Squares[(K + 1) % 3] * B.Squares[(K + 2) % 3];
  return Sum >= 0;
}

/// Rays beside each other, of which a body that is far from the first is far
/// from all.
struct Bundle {
  std::vector<std::optional<PixelRay>> Rays;
  std::vector<double> Blurs; ///< how far across a ray the dilation reaches,
                             ///< squared, a unit of depth away
  const PixelRay *First = nullptr;
  double Turn = 0, Step = 0, Blur = 0; ///< the most of any, from the first

  Bundle(const Camera<double> &C, double Dilation, const Rect &Pixels) {
    for (int Y = Pixels.Y0; Y < Pixels.Y1; ++Y)
      for (int X = Pixels.X0; X < Pixels.X1; ++X) {
        Rays.push_back(rayAt(C, {X + 0.5, Y + 0.5}));
        Blurs.push_back(Rays.back() ? blurOf(*Rays.back(), Dilation) : 0);
      }
    for (std::size_t X = 0; X < Rays.size(); ++X) {
      if (!Rays[X])
        continue;
      First = First ? First : &*Rays[X];
      Turn =
          std::max(Turn, glm::distance(Rays[X]->Direction, First->Direction));
      Step = std::max(Step, glm::distance(Rays[X]->Origin, First->Origin));
      Blur = std::max(Blur, Blurs[X]);
    }
  }

  /// Whether a ray of it may see \p B.
  bool reaches(const Body &B) const {
    const glm::dvec3 From = B.Mean - First->Origin;
    const double Far = glm::length(From),
                 Along = glm::dot(First->Direction, From);
    const double Most = std::max(1.0, Far + Step);
    const double Across = std::sqrt(std::max(0.0, Far * Far - Along * Along));
    const double Least = std::max(0.0, Across - Far * Turn - Step - 1e-9 * Far);
    return Least * Least <= B.Deviation * (B.Widest + Blur * Most * Most);
  }

private:
  /// The rows' smaller singular value is the least that a step across the ray
  /// moves on the picture.
  static double blurOf(const PixelRay &R, double Dilation) {
    const double Xx = glm::dot(R.Rows.X, R.Rows.X),
                 Yy = glm::dot(R.Rows.Y, R.Rows.Y),
                 Xy = glm::dot(R.Rows.X, R.Rows.Y);
    const double Mid = (Xx + Yy) / 2, Half = (Xx - Yy) / 2;
    return Dilation / (Mid - std::sqrt(Half * Half + Xy * Xy)) * (1 + 1e-9);
  }
};

class SeenScene {
public:
  SeenScene(const Gaussians<double> &G, const Camera<double> &C,
            const Options &O, RayDepths By)
      : G(G), C(C), O(O), By(By) {
    Bodies.reserve(G.size());
    for (std::size_t I = 0; I < G.size(); ++I) {
      Body B;
      B.Mean = multiply(C.Rotation, G.Means[I]) + C.Translation;
      B.Turn = B.Axes = multiply(C.Rotation, rotation(G.Quats[I]));
      for (int K = 0; K < 3; ++K)
        B.Axes[K] *= G.Scales[I][K];
      B.Squares = G.Scales[I] * G.Scales[I];
      B.Widest = std::max({B.Squares.x, B.Squares.y, B.Squares.z});
      B.Deviation =
          2 * std::log(G.Opacities[I] /
                       (leastAlpha<double>(O.AlphaCutoff) * (1 - DoubtBand)));
      Bodies.push_back(B);
    }
  }

  /// What each pixel of \p Of sees, front to back.
  std::vector<std::vector<Seen>> see(const Bundle &Of) const {
    std::vector<std::vector<Seen>> Lists(Of.Rays.size());
    if (!Of.First)
      return Lists;
    for (std::size_t I = 0; I < Bodies.size(); ++I)
      if (Of.reaches(Bodies[I]))
        for (std::size_t X = 0; X < Lists.size(); ++X)
          if (Of.Rays[X])
            see(I, *Of.Rays[X], Of.Blurs[X], Lists[X]);
    for (auto &List : Lists)
      std::sort(List.begin(), List.end());
    return Lists;
  }

  glm::dvec3 color(int32_t Index, const PixelRay &R) const {
    const auto I = static_cast<std::size_t>(Index);
    if (!G.Colors.empty())
      return G.Colors[I];
    const int Coefficients = (G.ShDegree + 1) * (G.ShDegree + 1);
    const glm::dvec3 Along =
        G.Means[I] - C.Centre - glm::transpose(C.Rotation) * R.Eye;
    return shColor(&G.Sh[I * static_cast<std::size_t>(Coefficients)],
                   std::min(G.ShDegree, O.ShLimit), Along);
  }

private:
  void see(std::size_t I, const PixelRay &R, double Blur,
           std::vector<Seen> &List) const {
    const Body &B = Bodies[I];
    const glm::dvec3 From = B.Mean - R.Origin;
    const double Depth =
        C.Optics.byDistance() ? glm::length(From) : glm::dot(R.Ahead, From);
    if (!inFront(Depth, O))
      return;
    const double Far = C.Optics.Model->IsParallel ? 1 : Depth;
    const double Along = glm::dot(R.Direction, From);
    const double Across = glm::dot(From, From) - Along * Along;
    if (!(Across <= B.Deviation * (B.Widest + Blur * Far * Far)))
      return;
    if (const double Alpha = alpha(B, G.Opacities[I], R, From, Far);
        Alpha >= leastAlpha<double>(O.AlphaCutoff) * (1 - DoubtBand))
      List.push_back({By == RayDepths::Own    ? Depth
                      : C.Optics.byDistance() ? glm::length(B.Mean)
                                              : B.Mean.z,
                      static_cast<int32_t>(I), Alpha});
  }

  double alpha(const Body &B, double Opacity, const PixelRay &R,
               const glm::dvec3 &From, double Far) const {
    if (!C.Optics.Model->IsParallel && !isAhead(B, R, From))
      return 0;
    // The rows take away what is along the ray. What they leave of the mean and
    // the covariance is on the picture, where the density's largest value on
    // the ray is that of the shadow.
    const Footprint<double> F =
        footprint(B.Axes, LensRows<double>{R.Rows.X / Far, R.Rows.Y / Far});
    const glm::dvec2 Off =
        glm::dvec2(glm::dot(R.Rows.X, From), glm::dot(R.Rows.Y, From)) / Far;
    const double H = O.Dilation;
    const glm::dvec3 S(dotFromLeft(F.X, F.X) + H, dotFromLeft(F.X, F.Y),
                       dotFromLeft(F.Y, F.Y) + H);
    const double Det0 = sharpDeterminant(F);
    const double Det = Det0 + H * (S[0] + S[2]) - H * H;
    if (!(Det > 0) || !std::isfinite(Det))
      return 0;
    if (O.Antialiased)
      Opacity *= std::sqrt(std::max(LeastDeterminantRatio, Det0 / Det));
    return std::min(mostAlpha<double>(),
                    Opacity * std::exp(-0.5 * throughInverse(S, Det, Off)));
  }

  const Gaussians<double> &G;
  const Camera<double> &C;
  const Options &O;
  const RayDepths By;
  std::vector<Body> Bodies;
};

} // namespace

Picture<double> renderAlongRays(const Gaussians<double> &G,
                                const Camera<double> &C, const Options &O,
                                RayDepths By) {
  Picture<double> P;
  P.Width = C.Width;
  P.Height = C.Height;
  const TileGrid Grid(8, C.Width, C.Height);
  const std::size_t Pixels =
      static_cast<std::size_t>(C.Width) * static_cast<std::size_t>(C.Height);
  P.Render.resize(Pixels);
  P.Transmittance.resize(Pixels, 1);
  P.Doubts.resize(Pixels);
  P.Last.resize(Pixels, -1);
  P.Stop.resize(Pixels, -1);
  const glm::dvec3 Background(O.Background[0], O.Background[1],
                              O.Background[2]);
  const SeenScene All(G, C, O, By);
  const double LeastAlpha = leastAlpha<double>(O.AlphaCutoff);
  std::atomic<uint64_t> Blends = 0, Walked = 0, Saturated = 0;
  forEachTile(Grid.count(), O.Threads, [&](std::size_t Tile) {
    const int X0 = static_cast<int>(Tile) % Grid.Columns * Grid.Size;
    const int Y0 = static_cast<int>(Tile) / Grid.Columns * Grid.Size;
    const Rect Area{X0, Y0, std::min(X0 + Grid.Size, C.Width),
                    std::min(Y0 + Grid.Size, C.Height)};
    const Bundle Rays(C, O.Dilation, Area);
    const auto Lists = All.see(Rays);
    std::size_t Ray = 0;
    for (int Y = Area.Y0; Y < Area.Y1; ++Y)
      for (int X = Area.X0; X < Area.X1; ++X, ++Ray) {
        const auto At =
            static_cast<std::size_t>(Y) * static_cast<std::size_t>(C.Width) +
            static_cast<std::size_t>(X);
        double &T = P.Transmittance[At];
        double Depth = 0; // of the Gaussian in front
        for (const Seen &S : Lists[Ray]) {
          ++Walked;
          if (near(S.Alpha, LeastAlpha))
            P.Doubts[At] |= DoubtThreshold;
          if (S.Alpha < LeastAlpha)
            continue;
          const double Next = T * (1 - S.Alpha);
          if (near(Next, O.Cutoff))
            P.Doubts[At] |= DoubtThreshold;
          if (S.Depth - Depth <= DepthRounding * S.Depth)
            P.Doubts[At] |= DoubtOrder;
          Depth = S.Depth;
          if (isFull(Next, O)) {
            P.Stop[At] = S.Index;
            ++Saturated;
            break;
          }
          P.Render[At] += S.Alpha * T * All.color(S.Index, *Rays.Rays[Ray]);
          T = Next;
          P.Last[At] = S.Index;
          ++Blends;
        }
        P.Render[At] += T * Background;
      }
  });
  P.Blends = Blends;
  P.Walked = Walked;
  P.Saturated = Saturated;
  return P;
}

} // namespace vorion::reference
