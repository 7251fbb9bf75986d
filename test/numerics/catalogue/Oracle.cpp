#include "Oracle.h"

#include "Big.h"
#include "Convert.h"
#include "Judge.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace vorion::test {
namespace {

using splat::Support;

/// Decisions that lie closer to their thresholds than this, in relation, are
/// not doubles' to make.
constexpr double Close = 1e-12;

using Vector = std::array<Big, 3>;
using Matrix = std::array<Vector, 3>; ///< rows

Big dot(const Vector &A, const Vector &B) {
  return A[0] * B[0] + A[1] * B[1] + A[2] * B[2];
}

bool isClose(const Big &Value, const Big &Threshold) {
  return abs(Value - Threshold) <= Big(Close) * abs(Threshold);
}

/// A Gaussian on the picture.
struct Ellipse {
  Vector Color;
  Big X, Y;           ///< the mean, px
  Big A, B, C;        ///< conic xx, xy, yy
  Big ReachX, ReachY; ///< half sides of its box; not read under exact
  Big Opacity;
  float Depth = 0; ///< as the keys have it
  uint32_t Index = 0;
};

Matrix rotationOf(const float *Q) {
  const Big W = double(Q[0]), X = double(Q[1]), Y = double(Q[2]),
            Z = double(Q[3]);
  const Big Norm = W * W + X * X + Y * Y + Z * Z;
  // The zero quaternion turns nothing.
  const Big Two = Norm <= Big(0) ? Big(0) : Big(2) / Norm;
  const Big One = 1;
  return {{{One - Two * (Y * Y + Z * Z), Two * (X * Y - W * Z),
            Two * (X * Z + W * Y)},
           {Two * (X * Y + W * Z), One - Two * (X * X + Z * Z),
            Two * (Y * Z - W * X)},
           {Two * (X * Z - W * Y), Two * (Y * Z + W * X),
            One - Two * (X * X + Y * Y)}}};
}

/// The real spherical harmonics in the sign convention of 3DGS.
std::array<Big, 16> harmonics(const Vector &D) {
  const Big Pi = Big::pi();
  const auto Root = [&](double Over, double Under) {
    return sqrt(Big(Over) / (Big(Under) * Pi));
  };
  const Big &X = D[0], &Y = D[1], &Z = D[2];
  const Big XX = X * X, YY = Y * Y, ZZ = Z * Z;
  const Big C1 = Root(3, 4), C2 = Root(15, 4);
  return {Root(1, 4),
          -C1 * Y,
          C1 * Z,
          -C1 * X,
          C2 * X * Y,
          -C2 * Y * Z,
          Root(5, 16) * (Big(2) * ZZ - XX - YY),
          -C2 * X * Z,
          Root(15, 16) * (XX - YY),
          -Root(35, 32) * Y * (Big(3) * XX - YY),
          Root(105, 4) * X * Y * Z,
          -Root(21, 32) * Y * (Big(4) * ZZ - XX - YY),
          Root(7, 16) * Z * (Big(2) * ZZ - Big(3) * XX - Big(3) * YY),
          -Root(21, 32) * X * (Big(4) * ZZ - XX - YY),
          Root(105, 16) * Z * (XX - YY),
          -Root(35, 32) * X * (XX - Big(3) * YY)};
}

class Oracle {
public:
  Oracle(const HardCase &C, const splat::RenderOptions &Options)
      : S(C.Scene), View(C.View), O(Options) {
    assert(O.Convention == splat::Rules::Inria && !O.Antialiased &&
           O.Reach != Support::Official16 && "not the oracle's");
  }

  /// Appends Gaussian \p I; false if it is culled.
  bool add(uint32_t I);
  void sort() {
    std::ranges::sort(Ellipses, [](const Ellipse &A, const Ellipse &B) {
      return std::pair(A.Depth, A.Index) < std::pair(B.Depth, B.Index);
    });
  }

  struct Pixel {
    std::array<double, 3> Color{};
    bool Close = false;
  };
  Pixel pixel(int X, int Y) const;

private:
  Vector fromCamera(uint32_t I) const {
    Vector D;
    for (std::size_t K = 0; K < 3; ++K)
      D[K] = Big(double(S.Means[3 * I + K])) - Big(View.Position[K]);
    return D;
  }
  Vector color(uint32_t I, const Vector &Along) const;
  void reach(Ellipse &E, const Big &Sxx, const Big &Sxy, const Big &Syy) const;

  const splat::Scene &S;
  const splat::Camera &View;
  const splat::RenderOptions &O;
  std::vector<Ellipse> Ellipses;
};

Vector Oracle::color(uint32_t I, const Vector &Along) const {
  const Big Length = sqrt(dot(Along, Along));
  const bool HasDirection = Big(0) < Length;
  Vector D;
  if (HasDirection)
    for (std::size_t K = 0; K < 3; ++K)
      D[K] = Along[K] / Length;
  const auto Basis = harmonics(D);
  const std::size_t Stored = S.coefficients();
  const std::size_t Used =
      HasDirection ? splat::shCoefficients(std::min(S.ShDegree, O.ShLimit)) : 1;
  Vector Color;
  for (std::size_t Channel = 0; Channel < 3; ++Channel) {
    Big Sum = 0.5;
    for (std::size_t K = 0; K < Used; ++K)
      Sum = Sum + Basis[K] * Big(double(S.Sh[3 * (I * Stored + K) + Channel]));
    Color[Channel] = Sum < Big(0) ? Big(0) : Sum;
  }
  return Color;
}

void Oracle::reach(Ellipse &E, const Big &Sxx, const Big &Sxy,
                   const Big &Syy) const {
  if (O.Reach == Support::Box3) {
    E.ReachX = Big(3) * sqrt(Sxx);
    E.ReachY = Big(3) * sqrt(Syy);
  } else if (O.Reach == Support::Square3) {
    const Big Middle = (Sxx + Syy) / Big(2);
    const Big Spread = Middle * Middle - (Sxx * Syy - Sxy * Sxy);
    const Big Floor = Big(1) / Big(10);
    const Big Largest = Middle + sqrt(Spread < Floor ? Floor : Spread);
    E.ReachX = E.ReachY = ceil(Big(3) * sqrt(Largest));
  }
}

bool Oracle::add(uint32_t I) {
  const Vector D = fromCamera(I);
  // Columns of the camera's rotation are its axes.
  Vector P;
  for (std::size_t K = 0; K < 3; ++K)
    for (std::size_t J = 0; J < 3; ++J)
      P[K] = P[K] + Big(View.Rotation[J][K]) * D[J];
  const Big &Z = P[2];
  if (Z <= Big(1) / Big(5))
    return false;

  // A = R_camera R_Gaussian diag(scale), J A's rows with the slopes held.
  const Matrix Turn = rotationOf(&S.Quats[4 * std::size_t{I}]);
  const std::array<double, 2> Focal{View.Fx, View.Fy};
  const std::array<int, 2> Size{View.Width, View.Height};
  std::array<Vector, 2> Rows;
  for (std::size_t Axis = 0; Axis < 2; ++Axis) {
    const Big F = Focal[Axis];
    const Big Limit = Big(13) / Big(10) * Big(Size[Axis]) / (Big(2) * F);
    Big Slope = P[Axis] / Z;
    if (Limit < abs(Slope))
      Slope = Slope < Big(0) ? -Limit : Limit;
    for (std::size_t K = 0; K < 3; ++K) {
      Big Along = 0, Ahead = 0; // of the Gaussian's axis K
      for (std::size_t J = 0; J < 3; ++J) {
        Along = Along + Big(View.Rotation[J][Axis]) * Turn[J][K];
        Ahead = Ahead + Big(View.Rotation[J][2]) * Turn[J][K];
      }
      Rows[Axis][K] = F / Z * (Along - Slope * Ahead) *
                      exp(Big(double(S.LogScales[3 * I + K])));
    }
  }
  const Big Dilation = double(O.Dilation);
  const Big Sxx = dot(Rows[0], Rows[0]) + Dilation;
  const Big Sxy = dot(Rows[0], Rows[1]);
  const Big Syy = dot(Rows[1], Rows[1]) + Dilation;
  const Big Determinant = Sxx * Syy - Sxy * Sxy;
  // What a double cannot hold, the reference culls.
  const auto Held = double(Determinant);
  if (!(Held > 0) || !std::isfinite(Held))
    return false;

  Ellipse E;
  E.Opacity = Big(1) / (Big(1) + exp(-Big(double(S.OpacityLogits[I]))));
  if (O.Reach == Support::Exact &&
      E.Opacity * Big(255) < Big(double(O.AlphaCutoff)))
    return false;
  E.X = Big(View.Fx) * P[0] / Z + Big(View.Cx);
  E.Y = Big(View.Fy) * P[1] / Z + Big(View.Cy);
  E.A = Syy / Determinant;
  E.B = -Sxy / Determinant;
  E.C = Sxx / Determinant;
  reach(E, Sxx, Sxy, Syy);
  E.Color = color(I, D);
  E.Depth = float(Z);
  E.Index = I;
  Ellipses.push_back(std::move(E));
  return true;
}

Oracle::Pixel Oracle::pixel(int X, int Y) const {
  const Big Px = X + 0.5, Py = Y + 0.5;
  const Big Least = Big(double(O.AlphaCutoff)) / Big(255);
  const Big Most = Big(99) / Big(100);
  const Big Cutoff = double(O.Cutoff);
  // e^-745 is 0 in double; alphas below it are 0 here too.
  const Big Lowest = -745;
  Pixel Result;
  Vector Color;
  Big T = 1;
  for (const Ellipse &E : Ellipses) {
    const Big Dx = E.X - Px, Dy = E.Y - Py;
    if (O.Reach != Support::Exact) {
      const Big FarX = abs(Dx), FarY = abs(Dy);
      Result.Close |= isClose(FarX, E.ReachX) || isClose(FarY, E.ReachY);
      if (E.ReachX < FarX || E.ReachY < FarY)
        continue;
    }
    const Big Power = -(E.A * Dx * Dx + E.C * Dy * Dy) / Big(2) - E.B * Dx * Dy;
    if (Power < Lowest)
      continue;
    Big Alpha = E.Opacity * exp(Power);
    Result.Close |= isClose(Alpha, Least);
    if (Alpha < Least)
      continue;
    if (Most < Alpha)
      Alpha = Most;
    const Big Next = T * (Big(1) - Alpha);
    Result.Close |= isClose(Next, Cutoff);
    if (Next < Cutoff)
      break;
    for (std::size_t K = 0; K < 3; ++K)
      Color[K] = Color[K] + E.Color[K] * Alpha * T;
    T = Next;
  }
  for (std::size_t K = 0; K < 3; ++K)
    Result.Color[K] = double(Color[K] + T * Big(double(O.Background[K])));
  return Result;
}

} // namespace

double OracleVerdict::digits() const {
  return Error > 0 ? std::clamp(-std::log10(Error), 0.0, 16.0) : 16;
}

OracleVerdict compareWithOracle(const HardCase &C,
                                const splat::RenderOptions &O,
                                uint64_t Evaluations) {
  const reference::Options R = referenceOptions(O);
  const auto Splats = reference::project(splat::toReference<double>(C.Scene),
                                         splat::toReference<double>(C.View), R);
  const auto Picture = reference::blend(Splats, C.View.Width, C.View.Height, R);

  OracleVerdict V;
  Oracle Exact(C, O);
  double Peak = 1;
  for (uint32_t I = 0; I < C.Scene.size(); ++I) {
    if (Exact.add(I) != Splats[I].Visible)
      V.Broken = fmt::format("Gaussian {} is {} in fp64 alone", I,
                             Splats[I].Visible ? "drawn" : "culled");
    if (Splats[I].Visible)
      for (int K = 0; K < 3; ++K)
        Peak = std::max(Peak, Splats[I].Color[K]);
  }
  Exact.sort();

  const auto Width = static_cast<uint64_t>(C.View.Width);
  const uint64_t Pixels = Width * static_cast<unsigned>(C.View.Height);
  const uint64_t Wanted = std::max<uint64_t>(16, Evaluations / C.Scene.size());
  uint64_t Step = std::max<uint64_t>(1, Pixels / Wanted);
  // So that samples are spread over columns too.
  while (Step > 1 && std::gcd(Step, Width) != 1)
    ++Step;
  for (uint64_t At = 0; At < Pixels; At += Step) {
    const auto P =
        Exact.pixel(static_cast<int>(At % Width), static_cast<int>(At / Width));
    ++V.Pixels;
    V.Close += P.Close;
    if (!P.Close)
      for (int K = 0; K < 3; ++K)
        V.Error =
            std::max(V.Error, std::abs(Picture.Render[At][K] -
                                       P.Color[static_cast<std::size_t>(K)]) /
                                  Peak);
  }
  return V;
}

} // namespace vorion::test
