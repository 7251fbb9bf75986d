#include "scene/Edit.h"

#include "io/Vector.h"
#include "scene/Axes.h"
#include "scene/Quaternion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace vorion::splat {
namespace {

using Mat3 = std::array<Vector, 3>;

/// The real spherical harmonics of bands 1 to 3, in INRIA's order and signs,
/// for the unit vector \p D.
std::array<double, 15> basis(const Vector &D) {
  const auto [X, Y, Z] = D;
  const double XX = X * X, YY = Y * Y, ZZ = Z * Z;
  const double C1 = std::sqrt(3 / (4 * std::numbers::pi));
  const double C2 = std::sqrt(15 / (4 * std::numbers::pi));
  const double C20 = std::sqrt(5 / (16 * std::numbers::pi));
  const double C33 = std::sqrt(35 / (32 * std::numbers::pi));
  const double C32 = std::sqrt(105 / (4 * std::numbers::pi));
  const double C31 = std::sqrt(21 / (32 * std::numbers::pi));
  const double C30 = std::sqrt(7 / (16 * std::numbers::pi));
  return {-C1 * Y,
          C1 * Z,
          -C1 * X,
          C2 * X * Y,
          -C2 * Y * Z,
          C20 * (2 * ZZ - XX - YY),
          -C2 * X * Z,
          C2 / 2 * (XX - YY),
          -C33 * Y * (3 * XX - YY),
          C32 * X * Y * Z,
          -C31 * Y * (4 * ZZ - XX - YY),
          C30 * Z * (2 * ZZ - 3 * XX - 3 * YY),
          -C31 * X * (4 * ZZ - XX - YY),
          C32 / 2 * Z * (XX - YY),
          -C33 * X * (XX - 3 * YY)};
}

/// [row][column]: what a turned function's coefficient gets of the function's.
using Turn = std::array<std::array<double, 15>, 15>;

/// By the harmonics' orthonormality: the integral over the sphere of each
/// times each turned one, which 4 rings of Gauss and Legendre times 8
/// directions give exactly for products of degree 6.
Turn turnOf(const Mat3 &R) {
  constexpr double Nodes[] = {0.33998104358485626, 0.86113631159405258};
  constexpr double Weights[] = {0.65214515486254614, 0.34785484513745386};
  Turn T{};
  for (int Ring = 0; Ring < 4; ++Ring) {
    const double Z = (Ring % 2 == 0 ? 1 : -1) * Nodes[Ring / 2];
    const double Around = std::sqrt(1 - Z * Z);
    const double Weight = Weights[Ring / 2] * 2 * std::numbers::pi / 8;
    for (int I = 0; I < 8; ++I) {
      const double Angle = 2 * std::numbers::pi * I / 8;
      const Vector D = {Around * std::cos(Angle), Around * std::sin(Angle), Z};
      Vector Back{}; // by the rotation's transpose
      for (std::size_t A = 0; A < 3; ++A)
        for (std::size_t B = 0; B < 3; ++B)
          Back[A] += R[B][A] * D[B];
      const auto Here = basis(D), There = basis(Back);
      for (std::size_t M = 0; M < 15; ++M)
        for (std::size_t N = 0; N < 15; ++N)
          T[M][N] += Weight * Here[M] * There[N];
    }
  }
  return T;
}

/// Turns \p Columns among themselves (Jacobi, from one side) until each is at
/// right angles to the others, and the columns of \p Along in the same way;
/// gives the lengths of the former. The ellipsoid whose half axes they are
/// stays the same. A right-handed three stays one.
Vector makeOrthogonal(Mat3 &Columns, Mat3 *Along = nullptr) {
  for (int Round = 0; Round < 12; ++Round)
    for (const auto &[P, Q] : {std::pair(0U, 1U), {0U, 2U}, {1U, 2U}}) {
      const Vector A = Columns[P], B = Columns[Q];
      const double Off = dot(A, B);
      if (Off == 0 || !std::isfinite(Off))
        continue;
      const double Zeta = (dot(B, B) - dot(A, A)) / (2 * Off);
      const double T =
          (Zeta < 0 ? -1 : 1) / (std::abs(Zeta) + std::sqrt(1 + Zeta * Zeta));
      const double C = 1 / std::sqrt(1 + T * T), S = C * T;
      for (Mat3 *Turned : {&Columns, Along})
        for (std::size_t K = 0; Turned && K < 3; ++K) {
          double &First = (*Turned)[P][K], &Second = (*Turned)[Q][K];
          const double Old = First;
          First = C * Old - S * Second;
          Second = S * Old + C * Second;
        }
    }
  Vector Lengths{};
  for (std::size_t C = 0; C < 3; ++C)
    Lengths[C] = length(Columns[C]);
  return Lengths;
}

/// The directions of \p Columns, which makeOrthogonal() left with \p Lengths,
/// as a right-handed three. The shortest column, and columns that vanish beside
/// the longest, may have any direction: theirs follow from the others.
Mat3 directionsOf(const Mat3 &Columns, const Vector &Lengths) {
  const auto Longest = static_cast<std::size_t>(
      std::ranges::max_element(Lengths) - Lengths.begin());
  std::size_t Next = (Longest + 1) % 3, Last = (Longest + 2) % 3;
  if (!(Lengths[Longest] > 0))
    return Similarity().Rotation;
  Mat3 D{};
  D[Longest] = (1 / Lengths[Longest]) * Columns[Longest];
  const bool Swapped = Lengths[Last] > Lengths[Next];
  if (Swapped)
    std::swap(Next, Last);
  constexpr double Vanishing = 1e-14;
  if (Lengths[Next] > Vanishing * Lengths[Longest]) {
    D[Next] = (1 / Lengths[Next]) * Columns[Next];
  } else {
    D[Next] = acrossOf(D[Longest]);
  }
  D[Last] = (Swapped ? -1.0 : 1.0) * cross(D[Longest], D[Next]);
  return D;
}

/// A matrix as Rotation, after a mirror at x = 0 if \c Mirrors, after the
/// symmetric \c Stretch.
struct Polar {
  Mat3 Rotation{}, Stretch{};
  bool Mirrors = false;
};

Polar polarOf(const Mat3 &Matrix) {
  Mat3 Columns{}, V = Similarity().Rotation; // columns
  for (std::size_t R = 0; R < 3; ++R)
    for (std::size_t C = 0; C < 3; ++C)
      Columns[C][R] = Matrix[R][C];
  const Vector Lengths = makeOrthogonal(Columns, &V);
  Mat3 U = directionsOf(Columns, Lengths);
  Polar P;
  for (std::size_t C = 0; C < 3; ++C)
    if (dot(U[C], Columns[C]) < -0.5 * Lengths[C]) {
      U[C] = -1.0 * U[C];
      P.Mirrors = true;
    }
  for (std::size_t R = 0; R < 3; ++R)
    for (std::size_t C = 0; C < 3; ++C)
      for (std::size_t K = 0; K < 3; ++K) {
        P.Rotation[R][C] += U[K][R] * V[K][C];
        P.Stretch[R][C] += V[K][R] * Lengths[K] * V[K][C];
      }
  if (P.Mirrors)
    for (Vector &Row : P.Rotation)
      Row[0] *= -1;
  // Of decimals, the identity's should stay it.
  for (Vector &Row : P.Rotation)
    for (double &Value : Row)
      if (std::abs(Value - std::round(Value)) < 1e-12)
        Value = std::round(Value);
  return P;
}

Quaternion product(const Quaternion &A, const Quaternion &B) {
  return {A[0] * B[0] - A[1] * B[1] - A[2] * B[2] - A[3] * B[3],
          A[0] * B[1] + A[1] * B[0] + A[2] * B[3] - A[3] * B[2],
          A[0] * B[2] - A[1] * B[3] + A[2] * B[0] + A[3] * B[1],
          A[0] * B[3] + A[1] * B[2] - A[2] * B[1] + A[3] * B[0]};
}

void turnHarmonics(Scene &S, const Mat3 &Rotation) {
  const Turn T = turnOf(Rotation);
  const std::size_t Each = S.coefficients();
  for (std::size_t I = 0; I < S.size(); ++I)
    for (std::size_t Channel = 0; Channel < 3; ++Channel) {
      float *First = &S.Sh[3 * Each * I + Channel];
      std::array<double, 15> Old{};
      for (std::size_t K = 1; K < Each; ++K)
        Old[K - 1] = First[3 * K];
      for (int Band = 1; Band <= S.ShDegree; ++Band)
        for (std::size_t K = shCoefficients(Band - 1); K < shCoefficients(Band);
             ++K) {
          double Sum = 0;
          for (std::size_t N = shCoefficients(Band - 1);
               N < shCoefficients(Band); ++N)
            Sum += T[K - 1][N - 1] * Old[N - 1];
          First[3 * K] = static_cast<float>(Sum);
        }
    }
}

} // namespace

Mat3 rotationOf(const Vector &Degrees) {
  Vector C{}, S{};
  for (std::size_t A = 0; A < 3; ++A) {
    // Quarter turns are exact.
    const double Quarters = Degrees[A] / 90;
    if (Quarters == std::floor(Quarters)) {
      constexpr double Cos[] = {1, 0, -1, 0};
      const auto Turn =
          static_cast<std::size_t>(std::fmod(std::fmod(Quarters, 4) + 4, 4));
      C[A] = Cos[Turn];
      S[A] = Cos[(Turn + 3) % 4];
    } else {
      C[A] = std::cos(Degrees[A] * std::numbers::pi / 180);
      S[A] = std::sin(Degrees[A] * std::numbers::pi / 180);
    }
  }
  const auto [X, Y, Z] = C;
  const auto [Sx, Sy, Sz] = S;
  return {{{Z * Y, Z * Sy * Sx - Sz * X, Z * Sy * X + Sz * Sx},
           {Sz * Y, Sz * Sy * Sx + Z * X, Sz * Sy * X - Z * Sx},
           {-Sy, Y * Sx, Y * X}}};
}

void transform(Scene &S, const Similarity &By) {
  if (By == Similarity())
    return;
  const double LogScale = std::log(By.Scale);
  for (std::size_t I = 0; I < S.size(); ++I) {
    Vector Moved = By.Translation;
    for (std::size_t A = 0; A < 3; ++A)
      for (std::size_t B = 0; B < 3; ++B)
        Moved[A] += By.Scale * By.Rotation[A][B] * S.mean(3 * I + B);
    for (std::size_t A = 0; A < 3; ++A) {
      S.setMean(3 * I + A, Moved[A]);
      float &Size = S.LogScales[3 * I + A];
      Size = static_cast<float>(Size + LogScale);
    }
  }
  if (By.Rotation == Similarity().Rotation)
    return;
  const Quaternion Turn = quaternionOf(By.Rotation);
  for (std::size_t I = 0; I < S.size(); ++I) {
    float *Q = &S.Quats[4 * I];
    Quaternion Old{Q[0], Q[1], Q[2], Q[3]};
    if (Old == Quaternion{}) // is read as no rotation
      Old[0] = 1;
    const Quaternion New = product(Turn, Old);
    std::ranges::transform(New, Q,
                           [](double V) { return static_cast<float>(V); });
  }
  turnHarmonics(S, By.Rotation);
}

/// Transforms \p S by the symmetric matrix \p By, harmonics excepted.
static void stretch(Scene &S, const Mat3 &By) {
  for (std::size_t I = 0; I < S.size(); ++I) {
    float *Q = &S.Quats[4 * I];
    double Norm = 0;
    for (std::size_t K = 0; K < 4; ++K)
      Norm += double(Q[K]) * Q[K];
    const double N = Norm > 0 ? 2 / Norm : 0;
    const double W = Q[0], X = Q[1], Y = Q[2], Z = Q[3];
    // Half axes: the rotation's columns, times the scales, then stretched.
    Mat3 Columns = {
        {{1 - N * (Y * Y + Z * Z), N * (X * Y + W * Z), N * (X * Z - W * Y)},
         {N * (X * Y - W * Z), 1 - N * (X * X + Z * Z), N * (Y * Z + W * X)},
         {N * (X * Z + W * Y), N * (Y * Z - W * X), 1 - N * (X * X + Y * Y)}}};
    const auto Stretched = [&By](const Vector &V) {
      return Vector{dot(By[0], V), dot(By[1], V), dot(By[2], V)};
    };
    for (std::size_t C = 0; C < 3; ++C)
      Columns[C] =
          std::exp(double(S.LogScales[3 * I + C])) * Stretched(Columns[C]);
    const Vector Mean =
        Stretched({S.mean(3 * I), S.mean(3 * I + 1), S.mean(3 * I + 2)});
    for (std::size_t A = 0; A < 3; ++A)
      S.setMean(3 * I + A, Mean[A]);
    const Vector Lengths = makeOrthogonal(Columns);
    const Mat3 Directions = directionsOf(Columns, Lengths);
    Mat3 Rotation{};
    for (std::size_t C = 0; C < 3; ++C) {
      S.LogScales[3 * I + C] = static_cast<float>(std::log(Lengths[C]));
      for (std::size_t A = 0; A < 3; ++A)
        Rotation[A][C] = Directions[C][A];
    }
    const Quaternion New = quaternionOf(Rotation);
    std::ranges::transform(New, Q,
                           [](double V) { return static_cast<float>(V); });
  }
}

void deform(Scene &S, const Affine &By) {
  const Polar P = polarOf(By.Matrix);
  Similarity Turn{.Rotation = P.Rotation, .Translation = By.Translation};
  const auto &[X, Y, Z] = P.Stretch;
  const double Even = X[0];
  const double Off = std::max({std::abs(Y[1] - Even), std::abs(Z[2] - Even),
                               std::abs(X[1]), std::abs(X[2]), std::abs(Y[2])});
  if (Off < 1e-6 * Even)
    Turn.Scale = Even;
  else
    stretch(S, P.Stretch);
  if (P.Mirrors)
    changeAxes(S, {.From = {1, 1, 1}, .To = {-1, 1, 1}});
  transform(S, Turn);
}

void setShDegree(Scene &S, int Degree) {
  if (Degree == S.ShDegree)
    return;
  const std::size_t Old = 3 * S.coefficients(),
                    New = 3 * shCoefficients(Degree);
  std::vector<float> Sh(S.size() * New);
  for (std::size_t I = 0; I < S.size(); ++I)
    std::copy_n(&S.Sh[Old * I], std::min(Old, New), &Sh[New * I]);
  S.Sh = std::move(Sh);
  S.ShDegree = Degree;
}

void join(Scene &To, Scene From) {
  const int Degree = std::max(To.ShDegree, From.ShDegree);
  setShDegree(To, Degree);
  setShDegree(From, Degree);
  append(To, From, 0, From.size());
}

} // namespace vorion::splat
