#include "cameras/GoodView.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <vector>

namespace vorion::splat {
namespace {

/// A Gaussian that stands for its neighbours in the file.
struct Sample {
  Vector Mean{};
  Vector Normal{}; ///< of the shortest axis, a unit vector
  double Opacity = 0;
  double Area = 0;    ///< of the two longest axes, world units squared
  double Longest = 0; ///< axis, world units
  bool Flat = false;  ///< whether the shortest axis is much shorter
};

/// At most so many are looked at.
constexpr std::size_t MostSamples = 16384;

/// By how much small scenes are drawn nearer, at most: in smaller ones fp32
/// would not tell places apart.
constexpr double LongestLens = 1e4;

Vector columnOf(const float *Q, std::size_t K) {
  const double W = Q[0], X = Q[1], Y = Q[2], Z = Q[3];
  const double Norm = W * W + X * X + Y * Y + Z * Z;
  const double S = Norm > 0 ? 2 / Norm : 0;
  switch (K) {
  case 0:
    return {1 - S * (Y * Y + Z * Z), S * (X * Y + W * Z), S * (X * Z - W * Y)};
  case 1:
    return {S * (X * Y - W * Z), 1 - S * (X * X + Z * Z), S * (Y * Z + W * X)};
  default:
    return {S * (X * Z + W * Y), S * (Y * Z - W * X), 1 - S * (X * X + Y * Y)};
  }
}

std::vector<Sample> samplesOf(const Scene &S) {
  const std::size_t Step = (S.size() + MostSamples - 1) / MostSamples;
  std::vector<Sample> Samples;
  for (std::size_t I = 0; I < S.size(); I += Step) {
    Sample One;
    std::array<double, 3> Sizes{};
    for (std::size_t A = 0; A < 3; ++A) {
      One.Mean[A] = S.mean(3 * I + A);
      Sizes[A] =
          std::exp(std::clamp<double>(S.LogScales[3 * I + A], -80.0, 80.0));
    }
    const std::size_t Shortest = static_cast<std::size_t>(
        std::min_element(Sizes.begin(), Sizes.end()) - Sizes.begin());
    One.Normal = columnOf(&S.Quats[4 * I], Shortest);
    std::sort(Sizes.begin(), Sizes.end());
    One.Flat = Sizes[0] < 0.4 * Sizes[1];
    One.Longest = Sizes[2];
    One.Area = std::numbers::pi * Sizes[1] * Sizes[2];
    One.Opacity = 1 / (1 + std::exp(-static_cast<double>(S.OpacityLogits[I])));
    Samples.push_back(One);
  }
  return Samples;
}

/// The value below which \p Share of the weights are.
double quantile(std::vector<std::pair<double, double>> ValuesAndWeights,
                double Share) {
  std::sort(ValuesAndWeights.begin(), ValuesAndWeights.end());
  double All = 0;
  for (const auto &[Value, Weight] : ValuesAndWeights)
    All += Weight;
  double Sum = 0;
  for (const auto &[Value, Weight] : ValuesAndWeights) {
    Sum += Weight;
    if (Sum >= Share * All)
      return Value;
  }
  return ValuesAndWeights.back().first;
}

/// What a flat Gaussian near the focus counts; 0 for others. Large ones are
/// those of walls and floors, the largest of the sky.
double flatWeight(const Sample &S, const SceneFocus &F) {
  if (!S.Flat || length(S.Mean - F.Centre) > 1.5 * F.Radius)
    return 0;
  return S.Opacity * std::min(S.Area, 0.01 * F.Radius * F.Radius);
}

/// Where flat Gaussians near \p Axis point on average, and which share of all
/// flat ones they are.
struct FlatSide {
  Vector Direction{};
  double Share = 0;
};

FlatSide flatSideNear(const std::vector<Sample> &Samples, const SceneFocus &F,
                      const Vector &Axis) {
  FlatSide Result{Axis, 0};
  for (const double Degrees : {30.0, 20.0, 12.0}) {
    const double Least = std::cos(Degrees * std::numbers::pi / 180);
    Vector Sum{};
    double Near = 0, All = 0;
    for (const Sample &S : Samples) {
      const double Weight = flatWeight(S, F);
      const double Along = dot(S.Normal, Result.Direction);
      All += Weight;
      if (std::abs(Along) < Least)
        continue;
      Near += Weight;
      Sum = Sum + (Along < 0 ? -Weight : Weight) * S.Normal;
    }
    if (!(length(Sum) > 0))
      return Result;
    Result = {unit(Sum), Near / All};
  }
  return Result;
}

/// Where the flat Gaussians lie that point along the unit vector \p Up: how far
/// above the middle of the detail, over the radius; negative for below. 0 if
/// there are none.
double heightOfFlat(const std::vector<Sample> &Samples, const SceneFocus &F,
                    const Vector &Up) {
  double Sum = 0, All = 0;
  for (const Sample &S : Samples) {
    if (std::abs(dot(S.Normal, Up)) < 0.97)
      continue;
    const double Weight = flatWeight(S, F);
    Sum += Weight * dot(S.Mean - F.Centre, Up);
    All += Weight;
  }
  return All > 0 ? Sum / All / F.Radius : 0;
}

/// Half of the detail is so near to the middle along \p Direction.
double spreadAlong(const std::vector<Sample> &Samples, const SceneFocus &F,
                   const Vector &Direction) {
  std::vector<std::pair<double, double>> Values;
  Values.reserve(Samples.size());
  for (const Sample &S : Samples)
    Values.emplace_back(std::abs(dot(S.Mean - F.Centre, Direction)),
                        S.Opacity + 1e-9);
  return quantile(std::move(Values), 0.5);
}

Vector upFrom(const std::vector<Sample> &Samples, const SceneFocus &F,
              const std::optional<Vector> &Near) {
  // A floor is below what stands on it. Of a room the ceiling is flat, too: on
  // 14 scenes with up near -y or +z the product is at most 0.02.
  const auto RightWayUp = [&](const FlatSide &Up) {
    const bool IsUpsideDown =
        Up.Share * heightOfFlat(Samples, F, Up.Direction) > 0.05;
    return (IsUpsideDown ? -1.0 : 1.0) * Up.Direction;
  };
  // Few flat Gaussians say too little to lean by.
  constexpr double LeastShare = 0.05;
  if (Near) {
    const FlatSide Up = flatSideNear(Samples, F, *Near);
    return Up.Share > LeastShare ? RightWayUp(Up) : *Near;
  }
  // Trainers' cameras have y down, and so have their scenes; others have z up.
  // A figure or a tower is taller than wide, a street or a garden much wider
  // than high.
  const Vector X{1, 0, 0}, Y{0, -1, 0}, Z{0, 0, 1};
  const double Wide = spreadAlong(Samples, F, X),
               AtY = spreadAlong(Samples, F, Y),
               AtZ = spreadAlong(Samples, F, Z);
  constexpr double Tall = 1.5;
  if (AtY > Tall * std::max(Wide, AtZ))
    return Y;
  if (AtZ > Tall * std::max(Wide, AtY))
    return Z;
  const bool LiesInXy = std::min(Wide, AtY) > 3 * AtZ;
  const FlatSide AlongY = flatSideNear(Samples, F, Y),
                 AlongZ = flatSideNear(Samples, F, Z);
  const bool IsZ = AlongZ.Share * (LiesInXy ? 2 : 0.45) > AlongY.Share;
  const FlatSide &Up = IsZ ? AlongZ : AlongY;
  if (!(Up.Share > LeastShare))
    return IsZ ? Z : Y;
  return RightWayUp(Up);
}

/// A coarse picture into which samples are put from front to back.
class CoarsePicture {
public:
  /// How much of \p Samples the camera sees, and how full its picture is.
  double score(const std::vector<Sample> &Samples, const Camera &C,
               double GaussiansPerSample);

private:
  static constexpr int Width = 64, Height = 36;
  static constexpr double Widest = 24; ///< reach that is drawn, pixels
  struct Placed {
    double Depth, X, Y, Reach; ///< the last three in pixels
    uint32_t Sample;
  };
  std::vector<Placed> Order;
  std::array<double, std::size_t{Width} * Height> Through{};
};

double CoarsePicture::score(const std::vector<Sample> &Samples, const Camera &C,
                            double GaussiansPerSample) {
  const auto R = C.worldToCameraRotation();
  const auto T = C.worldToCameraTranslation();
  const double ScaleX = static_cast<double>(Width) / C.Width,
               ScaleY = static_cast<double>(Height) / C.Height;
  const double Focal = C.Fx * ScaleX;
  Order.clear();
  double All = 0;
  for (std::size_t I = 0; I < Samples.size(); ++I) {
    const Vector &M = Samples[I].Mean;
    All += Samples[I].Opacity;
    const double Z = R[6] * M[0] + R[7] * M[1] + R[8] * M[2] + T[2];
    if (!(Z > 1e-6))
      continue;
    const double X = R[0] * M[0] + R[1] * M[1] + R[2] * M[2] + T[0];
    const double Y = R[3] * M[0] + R[4] * M[1] + R[5] * M[2] + T[1];
    const double Px = Focal * X / Z + C.Cx * ScaleX,
                 Py = Focal * Y / Z + C.Cy * ScaleY;
    // What is beside the picture may reach into it.
    const double Reach = std::min(1.5 * Samples[I].Longest * Focal / Z, Widest);
    if (Px > -Reach && Px < Width + Reach && Py > -Reach && Py < Height + Reach)
      Order.push_back({Z, Px, Py, Reach, static_cast<uint32_t>(I)});
  }
  std::sort(Order.begin(), Order.end(), [](const Placed &A, const Placed &B) {
    return std::pair(A.Depth, A.Sample) < std::pair(B.Depth, B.Sample);
  });
  Through.fill(1);
  double Seen = 0;
  for (const Placed &P : Order) {
    const Sample &S = Samples[P.Sample];
    const double Pixels = Focal / P.Depth;
    const int X0 = static_cast<int>(std::max(P.X - P.Reach, 0.0)),
              X1 = static_cast<int>(std::min(P.X + P.Reach, Width - 1.0)),
              Y0 = static_cast<int>(std::max(P.Y - P.Reach, 0.0)),
              Y1 = static_cast<int>(std::min(P.Y + P.Reach, Height - 1.0));
    if (X0 > X1 || Y0 > Y1)
      continue;
    const double Side = 2 * P.Reach + 1;
    const double Cover =
        S.Opacity * std::min(1.0, S.Area * Pixels * Pixels *
                                      GaussiansPerSample / (Side * Side));
    double Open = 0;
    for (int Y = Y0; Y <= Y1; ++Y)
      for (int X = X0; X <= X1; ++X) {
        double &Left = Through[static_cast<std::size_t>(Y) *
                                   static_cast<std::size_t>(Width) +
                               static_cast<std::size_t>(X)];
        Open += Left;
        Left *= 1 - Cover;
      }
    // A blob over much of the picture shows no detail.
    const double Blur = P.Reach / 5;
    Seen +=
        S.Opacity * Open / (1 + Blur * Blur) / ((X1 - X0 + 1) * (Y1 - Y0 + 1));
  }
  double Filled = 0;
  for (const double Left : Through)
    Filled += 1 - Left;
  Filled /= static_cast<double>(Through.size());
  return All > 0 ? Seen / All * (0.4 + 0.6 * Filled) : 0;
}

/// At \p From, with \p At in the picture's middle; \p Up is not along the way.
Camera lookingAt(const Vector &From, const Vector &At, const Vector &Up,
                 int Width, int Height, double Focal) {
  Camera C = Camera::ahead(Width, Height, Focal);
  const Vector Forward = unit(At - From);
  const Vector Right = unit(cross(Forward, Up));
  const Vector Down = cross(Forward, Right);
  C.Position = From;
  for (std::size_t R = 0; R < 3; ++R)
    C.Rotation[R] = {Right[R], Down[R], Forward[R]};
  return C;
}

/// A part of a scene that is to be in the picture.
struct Ball {
  Vector Centre{};
  double Radius = 0;
};

/// The samples of a scene without a background, strays excepted; empty for
/// other scenes.
std::vector<Ball> wholeOf(const std::vector<Sample> &Samples,
                          const SceneFocus &F) {
  constexpr double Nearly = 0.98, Background = 2.2, Stray = 2;
  std::vector<std::pair<double, double>> Distances;
  Distances.reserve(Samples.size());
  for (const Sample &S : Samples)
    Distances.emplace_back(length(S.Mean - F.Centre), S.Opacity + 1e-9);
  const double Reach = quantile(std::move(Distances), Nearly);
  // Two standard deviations, but not the blur of a large Gaussian.
  const double Largest = 0.2 * F.Radius;
  std::vector<Ball> Whole;
  if (Reach <= Background * F.Radius)
    for (const Sample &S : Samples)
      if (length(S.Mean - F.Centre) <= Stray * Reach)
        Whole.push_back({S.Mean, std::min(2 * S.Longest, Largest)});
  return Whole;
}

/// From the direction \p Out with \p Whole in the picture, which it fills in
/// one direction but for a margin.
Camera showing(const std::vector<Ball> &Whole, const SceneFocus &F,
               const Vector &Out, int Width, int Height, double Focal,
               double Nearest) {
  constexpr double Filled = 0.95; // of the picture's half sides
  const Vector Forward = -1.0 * Out, Right = unit(cross(Forward, F.Up)),
               Down = cross(Forward, Right);
  Vector Least{}, Most{};
  for (const Ball &B : Whole) {
    const Vector D = B.Centre - F.Centre;
    const Vector Seen = {dot(D, Right), dot(D, Down), dot(D, Forward)};
    for (std::size_t K = 0; K < 3; ++K) {
      Least[K] = std::min(Least[K], Seen[K]);
      Most[K] = std::max(Most[K], Seen[K]);
    }
  }
  const Vector At = F.Centre + 0.5 * (Least[0] + Most[0]) * Right +
                    0.5 * (Least[1] + Most[1]) * Down;
  const auto Distance = [&](double Lens) {
    double Away = 0;
    for (const Ball &B : Whole) {
      const Vector D = B.Centre - At;
      const double Across = (std::abs(dot(D, Right)) + B.Radius) / Width,
                   High = (std::abs(dot(D, Down)) + B.Radius) / Height;
      Away = std::max(Away, 2 * Lens / Filled * std::max(Across, High) -
                                dot(D, Forward));
    }
    return Away;
  };
  // A small scene is farther away, through a longer lens.
  const double Needed = Nearest + std::max(F.Radius, -Least[2]);
  double Lens = Focal, Away = Distance(Lens);
  for (int Round = 0; Away < Needed && Round < 8; ++Round) {
    Lens = std::min(Lens * 1.001 * Needed / std::max(Away, Needed * 1e-4),
                    LongestLens * Focal);
    Away = Distance(Lens);
  }
  Away = std::max(Away, Needed);
  return lookingAt(At + Away * Out, At, F.Up, Width, Height, Lens);
}

} // namespace

SceneFocus focusOf(const SceneFile &F, std::optional<Vector> Up) {
  return focusOf(F.Gaussians, Up, F.Up);
}

SceneFocus focusOf(const Scene &S, std::optional<Vector> Up,
                   std::optional<Vector> Near) {
  const std::vector<Sample> Samples = samplesOf(S);
  SceneFocus F;
  std::vector<std::pair<double, double>> Values;
  const auto Quantile = [&](double Share, auto Value) {
    Values.clear();
    for (const Sample &One : Samples)
      Values.emplace_back(Value(One), One.Opacity + 1e-9);
    return quantile(Values, Share);
  };
  for (std::size_t A = 0; A < 3; ++A)
    F.Centre[A] = Quantile(0.5, [&](const Sample &One) { return One.Mean[A]; });
  const auto Distance = [&](const Sample &One) {
    return length(One.Mean - F.Centre);
  };
  // The median's ball, without what lies far outside of it.
  double Half = Quantile(0.5, Distance);
  for (int Round = 0; Round < 3; ++Round) {
    Vector Sum{};
    double All = 0;
    for (const Sample &One : Samples)
      if (Distance(One) <= 2 * Half) {
        Sum = Sum + One.Opacity * One.Mean;
        All += One.Opacity;
      }
    if (All > 0)
      F.Centre = (1 / All) * Sum;
    Half = Quantile(0.5, Distance);
  }
  F.Radius = std::min(Quantile(0.8, Distance), 2 * Half);
  if (!(F.Radius > 0)) {
    // All in one place: as large as its Gaussians.
    for (const Sample &One : Samples)
      F.Radius = std::max(F.Radius, 3 * One.Longest);
    F.Radius = F.Radius > 0 && std::isfinite(F.Radius) ? F.Radius : 1;
  }
  F.Up = Up ? unit(*Up) : upFrom(Samples, F, Near);
  return F;
}

Camera goodView(const Scene &S, const SceneFocus &F, int Width, int Height,
                double Nearest) {
  const std::vector<Sample> Samples = samplesOf(S);
  const double PerSample =
      static_cast<double>(S.size()) / static_cast<double>(Samples.size());
  // 60 degrees across.
  const double Focal = 0.5 * Width / std::tan(30 * std::numbers::pi / 180);
  // From here the ball just fits.
  const double Fit =
      F.Radius * std::sqrt(1 + 4 * Focal * Focal /
                                   (double(std::min(Width, Height)) *
                                    std::min(Width, Height)));
  const Vector Side = acrossOf(F.Up), Other = cross(F.Up, Side);
  const std::vector<Ball> Whole = wholeOf(Samples, F);
  CoarsePicture Picture;
  Camera Best;
  double Most = -1;
  constexpr int Directions = 16;
  for (const auto &[Degrees, Custom] :
       {std::pair(15.0, 1.0), std::pair(30.0, 0.97), std::pair(3.0, 0.92)})
    for (int D = 0; D < Directions; ++D) {
      const double Turn = 2 * std::numbers::pi * D / Directions;
      const double High = Degrees * std::numbers::pi / 180;
      const Vector Out =
          std::sin(High) * F.Up +
          std::cos(High) * (std::cos(Turn) * Side + std::sin(Turn) * Other);
      const auto Judge = [&, Weight = Custom](const Camera &C) {
        const double Score = Weight * Picture.score(Samples, C, PerSample);
        if (Score > Most) {
          Most = Score;
          Best = C;
        }
      };
      if (!Whole.empty()) {
        Judge(showing(Whole, F, Out, Width, Height, Focal, Nearest));
        continue;
      }
      for (const double Distance : {1.0, 0.75, 0.55, 0.35}) {
        // Farther away and as large.
        const double Away =
            std::max(1.0, (Nearest + F.Radius) / (Distance * Fit));
        Judge(lookingAt(F.Centre + Away * Distance * Fit * Out, F.Centre, F.Up,
                        Width, Height, std::min(Away, LongestLens) * Focal));
      }
    }
  Best.Name = "found";
  return Best;
}

} // namespace vorion::splat
