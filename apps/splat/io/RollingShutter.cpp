#include "io/RollingShutter.h"

#include <cmath>
#include <cstddef>
#include <fmt/format.h>

namespace vorion::splat {
namespace {

using Vector3 = std::array<double, 3>;

Matrix3 product(const Matrix3 &A, const Matrix3 &B) {
  Matrix3 P{};
  for (std::size_t I = 0; I < 3; ++I)
    for (std::size_t J = 0; J < 3; ++J)
      for (std::size_t K = 0; K < 3; ++K)
        P[I][J] += A[I][K] * B[K][J];
  return P;
}

Matrix3 transposed(const Matrix3 &A) {
  Matrix3 T{};
  for (std::size_t I = 0; I < 3; ++I)
    for (std::size_t J = 0; J < 3; ++J)
      T[I][J] = A[J][I];
  return T;
}

double length(const Vector3 &V) { return std::hypot(V[0], V[1], V[2]); }

/// The rotation by \p Turn, an axis times an angle (Rodrigues).
Matrix3 rotationBy(const Vector3 &Turn) {
  const double Angle = length(Turn);
  // sin a / a and (1 - cos a) / a^2
  const double Half = Angle / 2;
  const double Sinc = Angle > 0 ? std::sin(Angle) / Angle : 1;
  const double Root = Angle > 0 ? std::sin(Half) / Angle : 0.5;
  const Matrix3 Cross{
      {{0, -Turn[2], Turn[1]}, {Turn[2], 0, -Turn[0]}, {-Turn[1], Turn[0], 0}}};
  const Matrix3 Squared = product(Cross, Cross);
  Matrix3 R{};
  for (std::size_t I = 0; I < 3; ++I)
    for (std::size_t J = 0; J < 3; ++J)
      R[I][J] = (I == J ? 1.0 : 0.0) + Sinc * Cross[I][J] +
                2 * Root * Root * Squared[I][J];
  return R;
}

/// Of a turn by less than pi.
Vector3 turnOf(const Matrix3 &R) {
  Vector3 Turn{(R[2][1] - R[1][2]) / 2, (R[0][2] - R[2][0]) / 2,
               (R[1][0] - R[0][1]) / 2};
  const double Sine = length(Turn);
  const double Angle = std::atan2(Sine, (R[0][0] + R[1][1] + R[2][2] - 1) / 2);
  if (Sine > 0)
    for (double &T : Turn)
      T *= Angle / Sine;
  return Turn;
}

} // namespace

CameraPlace placeAt(const CameraPlace &Middle, const RollingShutter &Shutter,
                    double Moment) {
  const double Part = Moment - 0.5;
  Vector3 Turn = Shutter.Turn;
  CameraPlace P = Middle;
  for (std::size_t K = 0; K < 3; ++K) {
    Turn[K] *= Part;
    for (std::size_t J = 0; J < 3; ++J)
      P.Position[K] += Part * Middle.Rotation[K][J] * Shutter.Motion[J];
  }
  P.Rotation = product(Middle.Rotation, rotationBy(Turn));
  return P;
}

Expected<CameraWay> wayBetween(const CameraPlace &From, const CameraPlace &To) {
  const Matrix3 Between = product(transposed(From.Rotation), To.Rotation);
  CameraWay W;
  W.Shutter.Turn = turnOf(Between);
  // Half a turn has two axes.
  if (!(length(W.Shutter.Turn) <= MostShutterTurn))
    return Error{"", fmt::format("a camera that rotates by {:.0f} degrees "
                                 "during the exposure, expected at most 90",
                                 length(W.Shutter.Turn) * 180 / M_PI)};
  W.Middle = placeAt(From, {.Turn = W.Shutter.Turn}, 1);
  const Matrix3 Back = transposed(W.Middle.Rotation);
  for (std::size_t I = 0; I < 3; ++I) {
    W.Middle.Position[I] = (From.Position[I] + To.Position[I]) / 2;
    for (std::size_t J = 0; J < 3; ++J)
      W.Shutter.Motion[I] += Back[I][J] * (To.Position[J] - From.Position[J]);
  }
  return W;
}

} // namespace vorion::splat
