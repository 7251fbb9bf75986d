#include "cameras/Motion.h"

#include "scene/Quaternion.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace vorion::splat {
namespace {

Vector axisOf(const Camera &C, std::size_t K) {
  return {C.Rotation[0][K], C.Rotation[1][K], C.Rotation[2][K]};
}

std::string numbered(const char *What, int I, int Count) {
  return fmt::format("{}-{:0{}}", What, I,
                     fmt::formatted_size("{}", Count - 1));
}

void setRotation(Camera &C, const Quaternion &Q) {
  double Norm = 0;
  for (const double V : Q)
    Norm += V * V;
  const double S = 2 / Norm;
  const auto [W, X, Y, Z] = Q;
  C.Rotation = {
      {{1 - S * (Y * Y + Z * Z), S * (X * Y - W * Z), S * (X * Z + W * Y)},
       {S * (X * Y + W * Z), 1 - S * (X * X + Z * Z), S * (Y * Z - W * X)},
       {S * (X * Z - W * Y), S * (Y * Z + W * X), 1 - S * (X * X + Y * Y)}}};
}

/// The curve of Catmull and Rom from B to C at 0 <= T <= 1.
template <std::size_t N>
std::array<double, N> curve(const std::array<double, N> &A,
                            const std::array<double, N> &B,
                            const std::array<double, N> &C,
                            const std::array<double, N> &D, double T) {
  std::array<double, N> Result{};
  for (std::size_t I = 0; I < N; ++I)
    Result[I] = B[I] + T / 2 *
                           (C[I] - A[I] +
                            T * (2 * A[I] - 5 * B[I] + 4 * C[I] - D[I] +
                                 T * (3 * (B[I] - C[I]) + D[I] - A[I])));
  return Result;
}

/// The direction to which what \p Cameras have on their right is most nearly at
/// right angles: the eigenvector of the least eigenvalue of the sum of r r^T,
/// by inverse iteration from \p Start, to which it keeps where rights say
/// nothing.
Vector acrossRights(const std::vector<Camera> &Cameras, const Vector &Start) {
  std::array<Vector, 3> A{};
  for (std::size_t I = 0; I < 3; ++I) {
    A[I][I] = 1e-6 * static_cast<double>(Cameras.size()); // no division by 0
    for (const Camera &C : Cameras)
      A[I] = A[I] + axisOf(C, 0)[I] * axisOf(C, 0);
  }
  Vector Up = Start;
  for (int Step = 0; Step < 16; ++Step)
    Up = unit(Up[0] * cross(A[1], A[2]) + Up[1] * cross(A[2], A[0]) +
              Up[2] * cross(A[0], A[1]));
  return Up;
}

} // namespace

std::optional<Vector> upOf(const std::vector<Camera> &Cameras) {
  Vector Sum{};
  for (const Camera &C : Cameras)
    Sum = Sum - axisOf(C, 1);
  if (!(length(Sum) > 0.1 * static_cast<double>(Cameras.size())))
    return std::nullopt;
  const Vector Mean = unit(Sum);
  // The up of a camera that looks down points forward, and the mean of a few
  // cameras with it.
  const Vector Up = acrossRights(Cameras, Mean);
  double Lean = 0;
  for (const Camera &C : Cameras)
    Lean += dot(axisOf(C, 0), Up) * dot(axisOf(C, 0), Up) /
            static_cast<double>(Cameras.size());
  // Cameras on their side, of portraits, have rights that are not level.
  constexpr double Level = 0.03; // 10 degrees
  return Lean < Level && dot(Up, Mean) > 0.5 ? Up : Mean;
}

std::optional<Vector> lookedAt(const std::vector<Camera> &Cameras) {
  // Each axis leaves out its own direction: the sum of I - d d^T.
  std::array<Vector, 3> A{};
  Vector B{};
  for (const Camera &C : Cameras) {
    const Vector D = axisOf(C, 2);
    for (std::size_t I = 0; I < 3; ++I)
      for (std::size_t J = 0; J < 3; ++J) {
        const double V = (I == J ? 1.0 : 0.0) - D[I] * D[J];
        A[I][J] += V;
        B[I] += V * C.Position[J];
      }
  }
  const double Count = static_cast<double>(Cameras.size());
  const double Determinant = dot(A[0], cross(A[1], A[2]));
  // Of axes that spread over 10 degrees it is about a hundredth of the most.
  if (!(Determinant > 0.005 * Count * Count * Count))
    return std::nullopt;
  const Vector Point = {dot(B, cross(A[1], A[2])) / Determinant,
                        dot(A[0], cross(B, A[2])) / Determinant,
                        dot(A[0], cross(A[1], B)) / Determinant};
  const auto Ahead = std::ranges::count_if(Cameras, [&](const Camera &C) {
    return dot(axisOf(C, 2), Point - C.Position) > 0;
  });
  if (2 * Ahead <= static_cast<std::ptrdiff_t>(Cameras.size()))
    return std::nullopt;
  return Point;
}

std::vector<Camera> orbit(const Camera &Start, const Vector &Centre,
                          const Vector &Up, int Count) {
  std::vector<Camera> Cameras;
  for (int I = 0; I < Count; ++I) {
    const double Angle = 2 * std::numbers::pi * I / Count;
    const double Cos = std::cos(Angle), Sin = std::sin(Angle);
    Camera C = Start;
    C.Id = I;
    C.Name = numbered("orbit", I, Count);
    if (I != 0) {
      C.Position = Centre + turned(Start.Position - Centre, Up, Cos, Sin);
      for (std::size_t K = 0; K < 3; ++K) {
        const Vector Axis = turned(axisOf(Start, K), Up, Cos, Sin);
        for (std::size_t R = 0; R < 3; ++R)
          C.Rotation[R][K] = Axis[R];
      }
    }
    Cameras.push_back(std::move(C));
  }
  return Cameras;
}

std::vector<Camera> alongPath(const std::vector<Camera> &Keys, int Count) {
  assert(Keys.size() > 1 && Count > 1);
  std::vector<Camera> Sized;
  std::vector<Quaternion> Turns;
  for (const Camera &Key : Keys) {
    Sized.push_back(resized(Key, Keys.front().Width, Keys.front().Height));
    Quaternion Q = quaternionOf(Key.Rotation);
    // Of a quaternion and its negative the one nearer to the last.
    if (!Turns.empty() && Q[0] * Turns.back()[0] + Q[1] * Turns.back()[1] +
                                  Q[2] * Turns.back()[2] +
                                  Q[3] * Turns.back()[3] <
                              0)
      for (double &V : Q)
        V = -V;
    Turns.push_back(Q);
  }
  const std::size_t Last = Keys.size() - 1;
  std::vector<Camera> Cameras;
  for (int I = 0; I < Count; ++I) {
    const double At = static_cast<double>(Last) * I / (Count - 1);
    const std::size_t B = std::min(static_cast<std::size_t>(At), Last - 1);
    const std::size_t A = B == 0 ? 0 : B - 1, D = std::min(B + 2, Last);
    const double T = At - static_cast<double>(B);
    Camera C = Sized[B];
    C.Id = I;
    C.Name = numbered("path", I, Count);
    C.Position = curve(Sized[A].Position, Sized[B].Position,
                       Sized[B + 1].Position, Sized[D].Position, T);
    setRotation(C, curve(Turns[A], Turns[B], Turns[B + 1], Turns[D], T));
    for (double Camera::*V :
         {&Camera::Fx, &Camera::Fy, &Camera::Cx, &Camera::Cy})
      C.*V = (1 - T) * (Sized[B].*V) + T * (Sized[B + 1].*V);
    Cameras.push_back(std::move(C));
  }
  return Cameras;
}

Camera resized(Camera C, int Width, int Height) {
  const double Scale = static_cast<double>(Width) / C.Width;
  C.Fx *= Scale;
  C.Fy *= Scale;
  C.Cx *= Scale;
  C.Cy = (C.Cy - 0.5 * C.Height) * Scale + 0.5 * Height;
  C.Width = Width;
  C.Height = Height;
  return C;
}

Camera resized(Camera C, int Width) {
  const double Height = static_cast<double>(C.Height) * Width / C.Width;
  return resized(
      std::move(C), Width,
      std::clamp(static_cast<int>(std::lround(Height)), 1, MaxImageSize));
}

} // namespace vorion::splat
