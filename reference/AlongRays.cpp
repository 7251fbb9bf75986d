#include "AlongRays.h"

#include "Footprint.h"
#include "Projection.h"
#include "Ray.h"
#include "SphericalHarmonics.h"
#include "Walk.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <unordered_map>

namespace vorion::reference {
namespace {

/// Of the low pass on the picture, px^2.
constexpr double LowPassVariance = 0.5;

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
  glm::dvec2 Place;   ///< of the mean, px, with a low pass
};

/// What a pixel sees of a Gaussian.
struct SeenBody : Seen {
  bool IsOnPicture = false; ///< the low pass has more than the ray
  double Square = 0;        ///< of the body's deviations from the ray
};

/// The density \p Square deviations, squared, from the mean.
double density(const Options &O, double Square) {
  return std::exp(O.FalloffDegree == 4 ? -Square * Square / 18 : -Square / 2);
}

/// The square of the distance at which a density is \p Least.
double squareAt(const Options &O, double Least) {
  return O.FalloffDegree == 4 ? std::sqrt(std::max(0., -18 * std::log(Least)))
                              : -2 * std::log(Least);
}
/// The derivative of the density's logarithm at \p Square, relative to that of
/// degree 2.
double rate(const Options &O, double Square) {
  return O.FalloffDegree == 4 ? 2. / 9 * Square : 1;
}

/// v^T M^-1 v of a symmetric M, its entries being xx, xy, yy.
double throughInverse(const glm::dvec3 &M, double Det, const glm::dvec2 &V) {
  return (M[2] * V.x * V.x - 2 * M[1] * V.x * V.y + M[0] * V.y * V.y) / Det;
}

/// How far in front of where the ray \p R begins \p B is densest, \p From being
/// the mean from there: the cosine of the angle between the ray and the mean in
/// standard deviations.
double ahead(const Body &B, const PixelRay &R, const glm::dvec3 &From) {
  // Vectors are those times the product of all deviations.
  glm::dvec3 D, M;
  for (int K = 0; K < 3; ++K) {
    const double Others =
        std::sqrt(B.Squares[(K + 1) % 3]) * std::sqrt(B.Squares[(K + 2) % 3]);
    D[K] = Others * glm::dot(B.Turn[K], R.Direction);
    M[K] = Others * glm::dot(B.Turn[K], From);
  }
  const double Lengths = glm::length(D) * glm::length(M);
  return Lengths > 0 ? glm::dot(D, M) / Lengths : 0;
}

/// How a ray meets a body: the body's deviations from it, squared, and how far
/// along it the density is largest. No component is divided by a scale.
struct Meeting {
  double Square, Along;
};

Meeting meet(const Body &B, const PixelRay &R, const glm::dvec3 &From) {
  const glm::dvec3 Beside = glm::cross(From, R.Direction);
  double Across = 0, Both = 0, Ahead = 0;
  for (int K = 0; K < 3; ++K) {
    const double Others = B.Squares[(K + 1) % 3] * B.Squares[(K + 2) % 3];
    const double Along = glm::dot(B.Turn[K], R.Direction);
    const double Off = glm::dot(B.Turn[K], Beside);
    Across += B.Squares[K] * Off * Off;
    Both += Others * Along * glm::dot(B.Turn[K], From);
    Ahead += Others * Along * Along;
  }
  return {Across / Ahead, Both / Ahead};
}

/// Rays beside each other, of which a body that is far from the first is far
/// from all.
struct Bundle {
  std::vector<std::optional<PixelRay>> Rays;
  std::vector<double> Blurs; ///< how far across a ray the dilation reaches,
                             ///< squared, a unit of depth away
  std::vector<glm::dvec2> Places; ///< px
  const PixelRay *First = nullptr;
  double Turn = 0, Step = 0, Blur = 0; ///< the most of any, from the first

  Bundle(const Camera<double> &C, const Options &O, const Rect &Pixels) {
    const double Dilation = O.LowPass ? LowPassVariance : O.Dilation;
    for (int Y = Pixels.Y0; Y < Pixels.Y1; ++Y)
      for (int X = Pixels.X0; X < Pixels.X1; ++X) {
        Places.emplace_back(X + 0.5, Y + 0.5);
        Rays.push_back(rayAt(C, Places.back()));
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
      B.Deviation = squareAt(O, leastAlpha<double>(O.AlphaCutoff) *
                                    (1 - DoubtBand) / G.Opacities[I]);
      if (O.LowPass)
        B.Place = C.Focal * glm::dvec2(B.Mean) /
                      (C.Optics.Model->IsParallel ? 1 : B.Mean.z) +
                  C.Principal;
      Bodies.push_back(B);
    }
  }

  /// What each pixel of \p Of sees, front to back.
  std::vector<std::vector<SeenBody>> see(const Bundle &Of) const {
    std::vector<std::vector<SeenBody>> Lists(Of.Rays.size());
    if (!Of.First)
      return Lists;
    for (std::size_t I = 0; I < Bodies.size(); ++I)
      if (Of.reaches(Bodies[I]))
        for (std::size_t X = 0; X < Lists.size(); ++X)
          if (Of.Rays[X])
            see(I, *Of.Rays[X], Of.Blurs[X], Of.Places[X], Lists[X]);
    for (auto &List : Lists)
      std::sort(List.begin(), List.end());
    return Lists;
  }

  const Body &body(int32_t Index) const {
    return Bodies[static_cast<std::size_t>(Index)];
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
           const glm::dvec2 &Place, std::vector<SeenBody> &List) const {
    const Body &B = Bodies[I];
    const glm::dvec3 From = B.Mean - R.Origin;
    if (By == RayDepths::Ray)
      return seeAlong(I, R, From, List);
    const double Depth =
        C.Optics.byDistance() ? glm::length(From) : glm::dot(R.Ahead, From);
    if (!inFront(Depth, O))
      return;
    const double Far = C.Optics.Model->IsParallel ? 1 : Depth;
    const double Along = glm::dot(R.Direction, From);
    const double Across = glm::dot(From, From) - Along * Along;
    if (!(Across <= B.Deviation * (B.Widest + Blur * Far * Far)))
      return;
    const double Ahead = C.Optics.Model->IsParallel ? 1 : ahead(B, R, From);
    if (Ahead < -DoubtBand && !O.LowPass)
      return;
    const auto [Shown, Square] = shadow(B, G.Opacities[I], R, From, Far);
    double Wanted = Ahead < 0 ? 0 : Shown * density(O, Square);
    bool IsOnPicture = false, IsBetween = false;
    if (O.LowPass) {
      const glm::dvec2 Off = Place - B.Place;
      const double Blurred = G.Opacities[I] * std::exp(-glm::dot(Off, Off));
      IsOnPicture = Blurred > Wanted;
      IsBetween = near(Wanted, Blurred);
      Wanted = std::max(Wanted, Blurred);
    }
    if (Wanted >= leastAlpha<double>(O.AlphaCutoff) * (1 - DoubtBand))
      List.push_back({{By == RayDepths::Own    ? Depth
                       : C.Optics.byDistance() ? glm::length(B.Mean)
                                               : B.Mean.z,
                       static_cast<int32_t>(I), Wanted,
                       std::abs(Ahead) <= DoubtBand || IsBetween},
                      IsOnPicture,
                      Square});
  }

  void seeAlong(std::size_t I, const PixelRay &R, const glm::dvec3 &From,
                std::vector<SeenBody> &List) const {
    const Meeting M = meet(Bodies[I], R, From);
    const double Depth = C.Optics.byDistance()
                             ? M.Along
                             : M.Along * glm::dot(R.Ahead, R.Direction);
    const double Wanted = G.Opacities[I] * density(O, M.Square);
    const bool IsSeen = inFront(Depth, O),
               IsAtOrigin = near(Depth, nearLimit(O));
    if ((IsSeen || IsAtOrigin) &&
        Wanted >= leastAlpha<double>(O.AlphaCutoff) * (1 - DoubtBand))
      List.push_back(
          {{Depth, static_cast<int32_t>(I), IsSeen ? Wanted : 0, IsAtOrigin}});
  }

  /// How a ray sees a body: the opacity, 0 of what is none, and the square.
  struct Shadow {
    double Opacity, Square;
  };
  Shadow shadow(const Body &B, double Opacity, const PixelRay &R,
                const glm::dvec3 &From, double Far) const {
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
      return {0, 0};
    if (O.Antialiased)
      Opacity *= std::sqrt(std::max(LeastDeterminantRatio, Det0 / Det));
    return {Opacity, throughInverse(S, Det, Off)};
  }

  const Gaussians<double> &G;
  const Camera<double> &C;
  const Options &O;
  const RayDepths By;
  std::vector<Body> Bodies;
};

/// What a pixel blends, front to back; the alphas are those before the clamp.
struct Blended {
  int32_t Index;
  double Alpha, Wanted, T, Square;
  bool IsOnPicture;
};

/// Of the ray's nearest point to the mean by the covariance: what is left of it
/// from the mean, over the covariance, by the Gaussian's axes. The vector is
/// (d x (m x d)) with m and d in standard deviations, of which no component is
/// divided by a scale.
glm::dvec3 nearestOverCovariance(const Body &B, const glm::dvec3 &Scales,
                                 const PixelRay &R) {
  const glm::dvec3 Beside = glm::cross(B.Mean - R.Origin, R.Direction);
  glm::dvec3 M, D, Y;
  double Square = 0;
  for (int K = 0; K < 3; ++K) {
    M[K] = Scales[K] * Scales[K] * glm::dot(B.Turn[K], Beside);
    D[K] = glm::dot(B.Turn[K], R.Direction);
    const double Others = Scales[(K + 1) % 3] * Scales[(K + 2) % 3];
    Square += Others * Others * D[K] * D[K];
  }
  for (int K = 0; K < 3; ++K) {
    const int I = (K + 1) % 3, J = (K + 2) % 3;
    Y[K] = (M[I] * D[J] - M[J] * D[I]) / Square;
  }
  return Y;
}

/// What one Gaussian gets of the pixels of a tile.
struct RaySums {
  glm::dvec3 Color{0}, Mean{0}, Scales{0}, Turn{0}; ///< Turn: by its own axes
  glm::dvec2 Place{0}; ///< of the low pass, by the mean on the picture
  double S = 0;

  void addOnPicture(const glm::dvec2 &Off, double Weight) {
    S += Weight;
    Place += 2 * Weight * Off;
  }
  void add(const glm::dvec3 &Scale, const Body &B, const glm::dvec3 &Y,
           double Weight, double Rate) {
    S += Weight;
    Weight *= Rate;
    Mean += Weight * (B.Turn * Y);
    Scales += Weight * Scale * Y * Y;
    for (int K = 0; K < 3; ++K) {
      const int I = (K + 1) % 3, J = (K + 2) % 3;
      Turn[K] +=
          Weight * (Scale[I] * Scale[I] - Scale[J] * Scale[J]) * Y[I] * Y[J];
    }
  }
};

} // namespace

Picture<double> renderAlongRays(const Gaussians<double> &G,
                                const Camera<double> &C, const Options &O,
                                RayDepths By) {
  assert(By != RayDepths::Ray || (O.Dilation == 0 && !O.LowPass));
  assert(!O.LowPass || (O.Dilation == 0 && O.FalloffDegree == 2));
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
  const double OneOrder = By == RayDepths::Ray ? DoubtBand : DepthRounding;
  std::atomic<uint64_t> Blends = 0, Walked = 0, Saturated = 0;
  forEachTile(Grid.count(), O.Threads, [&](std::size_t Tile) {
    const int X0 = static_cast<int>(Tile) % Grid.Columns * Grid.Size;
    const int Y0 = static_cast<int>(Tile) / Grid.Columns * Grid.Size;
    const Rect Area{X0, Y0, std::min(X0 + Grid.Size, C.Width),
                    std::min(Y0 + Grid.Size, C.Height)};
    const Bundle Rays(C, O, Area);
    const auto Lists = All.see(Rays);
    std::size_t Ray = 0;
    for (int Y = Area.Y0; Y < Area.Y1; ++Y)
      for (int X = Area.X0; X < Area.X1; ++X, ++Ray) {
        const auto At =
            static_cast<std::size_t>(Y) * static_cast<std::size_t>(C.Width) +
            static_cast<std::size_t>(X);
        double &T = P.Transmittance[At];
        double Depth = 0; // of the Gaussian in front
        for (const SeenBody &S : Lists[Ray]) {
          ++Walked;
          const double Alpha = std::min(mostAlpha<double>(), S.Alpha);
          if (near(Alpha, LeastAlpha) || S.IsAtOrigin)
            P.Doubts[At] |= DoubtThreshold;
          if (Alpha < LeastAlpha)
            continue;
          const double Next = T * (1 - Alpha);
          if (near(Next, O.Cutoff))
            P.Doubts[At] |= DoubtThreshold;
          if (S.Depth - Depth <= OneOrder * S.Depth)
            P.Doubts[At] |= DoubtOrder;
          Depth = S.Depth;
          if (isFull(Next, O)) {
            P.Stop[At] = S.Index;
            ++Saturated;
            break;
          }
          P.Render[At] += Alpha * T * All.color(S.Index, *Rays.Rays[Ray]);
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

Gradients alongRaysBackward(const Gaussians<double> &G, const Camera<double> &C,
                            const Upstream &U, const Options &O) {
  assert(O.Dilation == 0 && !O.Antialiased);
  const std::size_t N = G.size();
  const TileGrid Grid(8, C.Width, C.Height);
  const glm::dvec3 Background(O.Background[0], O.Background[1],
                              O.Background[2]);
  const SeenScene All(G, C, O, RayDepths::Own);
  // Of tiles, so that the order of additions is always the same.
  std::vector<std::unordered_map<int32_t, RaySums>> Tiles(Grid.count());
  forEachTile(Grid.count(), O.Threads, [&](std::size_t Tile) {
    const int X0 = static_cast<int>(Tile) % Grid.Columns * Grid.Size;
    const int Y0 = static_cast<int>(Tile) / Grid.Columns * Grid.Size;
    const Rect Area{X0, Y0, std::min(X0 + Grid.Size, C.Width),
                    std::min(Y0 + Grid.Size, C.Height)};
    const Bundle Rays(C, O, Area);
    const auto Lists = All.see(Rays);
    std::size_t Ray = 0;
    std::vector<Blended> Pixel;
    for (int Y = Area.Y0; Y < Area.Y1; ++Y)
      for (int X = Area.X0; X < Area.X1; ++X, ++Ray) {
        const auto At =
            static_cast<std::size_t>(Y) * static_cast<std::size_t>(C.Width) +
            static_cast<std::size_t>(X);
        double T = 1;
        Pixel.clear();
        for (const SeenBody &S : Lists[Ray]) {
          const double Alpha = std::min(mostAlpha<double>(), S.Alpha);
          if (Alpha < leastAlpha<double>(O.AlphaCutoff))
            continue;
          if (isFull(T * (1 - Alpha), O))
            break;
          Pixel.push_back(
              {S.Index, Alpha, S.Alpha, T, S.Square, S.IsOnPicture});
          T *= 1 - Alpha;
        }
        const double ByLast = glm::dot(Background, U.Render[At]) - U.Alpha[At];
        glm::dvec3 Behind(0);
        for (std::size_t I = Pixel.size(); I-- > 0;) {
          const Blended &B = Pixel[I];
          const glm::dvec3 Color = All.color(B.Index, *Rays.Rays[Ray]);
          const double ByAlpha = B.T * glm::dot(Color - Behind, U.Render[At]) -
                                 T / (1 - B.Alpha) * ByLast;
          Behind = B.Alpha * Color + (1 - B.Alpha) * Behind;
          RaySums &Sums = Tiles[Tile][B.Index];
          Sums.Color += B.Alpha * B.T * U.Render[At];
          if (O.Rule == Rules::Gsplat && B.Wanted > mostAlpha<double>())
            continue;
          const glm::dvec3 &Scales =
              G.Scales[static_cast<std::size_t>(B.Index)];
          const Body &Shape = All.body(B.Index);
          const double Weight = B.Wanted * ByAlpha;
          if (B.IsOnPicture)
            Sums.addOnPicture(Rays.Places[Ray] - Shape.Place, Weight);
          else
            Sums.add(Scales, Shape,
                     nearestOverCovariance(Shape, Scales, *Rays.Rays[Ray]),
                     Weight, rate(O, B.Square));
        }
      }
  });

  std::vector<RaySums> Sums(N);
  for (const auto &Tile : Tiles)
    for (const auto &[Index, Own] : Tile) {
      RaySums &To = Sums[static_cast<std::size_t>(Index)];
      To.Color += Own.Color;
      To.Mean += Own.Mean;
      To.Scales += Own.Scales;
      To.Turn += Own.Turn;
      To.S += Own.S;
      To.Place += Own.Place;
    }
  Gradients Out;
  Out.Sums.resize(N);
  Out.Means2d.resize(N, glm::dvec2(0));
  for (auto *V : {&Out.Means, &Out.Scales, &Out.Colors})
    V->resize(N, glm::dvec3(0));
  Out.Quats.resize(N, glm::dvec4(0));
  Out.Opacities.resize(N, 0);
  Out.Sh.resize(G.Sh.size(), glm::dvec3(0));
  const auto Bands = static_cast<std::size_t>(G.ShDegree) + 1;
  const std::size_t Coefficients = Bands * Bands;
  for (std::size_t I = 0; I < N; ++I) {
    RaySums &From = Sums[I];
    const glm::dvec3 &At = All.body(static_cast<int32_t>(I)).Mean;
    const double Far = C.Optics.Model->IsParallel ? 1 : At.z;
    const glm::dvec2 ByPlace = From.Place * C.Focal / Far;
    From.Mean +=
        glm::dvec3(ByPlace, C.Optics.Model->IsParallel
                                ? 0
                                : -glm::dot(ByPlace, glm::dvec2(At)) / Far);
    Out.Sums[I].Color = Out.Colors[I] = From.Color;
    Out.Sums[I].S = From.S;
    Out.Opacities[I] = From.S == 0 ? 0 : From.S / G.Opacities[I];
    Out.Scales[I] = From.Scales;
    Out.Means2d[I] = {From.Mean.x * Far / C.Focal.x,
                      From.Mean.y * Far / C.Focal.y};
    // A rotation about its own axes by t is a step of q (0, t) / 2.
    const glm::dvec4 &Q = G.Quats[I];
    const glm::dvec3 Axis(Q[1], Q[2], Q[3]);
    Out.Quats[I] =
        2. * glm::dvec4(-glm::dot(Axis, From.Turn),
                        Q[0] * From.Turn + glm::cross(Axis, From.Turn));
    Out.Means[I] = glm::transpose(C.Rotation) * From.Mean;
    if (G.Colors.empty())
      Out.Means[I] += shBackward(
          &G.Sh[I * Coefficients], std::min(G.ShDegree, O.ShLimit),
          G.Means[I] - C.Centre, From.Color, &Out.Sh[I * Coefficients]);
  }
  return Out;
}

} // namespace vorion::reference
