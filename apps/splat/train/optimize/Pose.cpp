#include "train/optimize/Pose.h"

#include "io/Vector.h"
#include "kernels/pose.cl.h"
#include "picture/Layout.h"
#include "render/Pipeline.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace vorion::splat {
namespace {

#include "kernels/pose.h"

constexpr std::size_t Terms = POSE_TERMS;
/// Gaussians of a group of pose_back.
constexpr uint32_t Stretch = 4096;

using Matrix = std::array<Vector, 3>; ///< rows

Vector times(const Matrix &M, const Vector &V) {
  return {dot(M[0], V), dot(M[1], V), dot(M[2], V)};
}
Vector column(const Matrix &M, std::size_t K) {
  return {M[0][K], M[1][K], M[2][K]};
}
/// By the transpose.
Vector back(const Matrix &M, const Vector &V) {
  return {dot(column(M, 0), V), dot(column(M, 1), V), dot(column(M, 2), V)};
}
Vector vectorAt(std::span<const double> Values, std::size_t At) {
  return {Values[At], Values[At + 1], Values[At + 2]};
}

/// (1 - cos t) / t^2, and (t - sin t) / t^3 by its series where it would
/// cancel.
double halfAt(double T) {
  const double S = T == 0 ? 1 : std::sin(T / 2) / (T / 2);
  return S * S / 2;
}
double sixthAt(double T) {
  const double Q = T * T;
  return T < 0.01 ? 1.0 / 6 - Q / 120 + Q * Q / 5040
                  : (T - std::sin(T)) / (Q * T);
}

/// \p V turned by \p Turn (Rodrigues).
Vector turned(const Vector &V, const Vector &Turn) {
  const double T = length(Turn);
  const Vector Once = cross(Turn, V);
  return V + (T == 0 ? 1 : std::sin(T) / T) * Once +
         halfAt(T) * cross(Turn, Once);
}

/// The gradient by \p Turn of what has \p By by a small turn about the same
/// axes that comes after it: the transpose of the left Jacobian of the
/// rotations.
Vector byTurn(const Vector &By, const Vector &Turn) {
  const double T = length(Turn);
  const Vector Once = cross(Turn, By);
  return By - halfAt(T) * Once + sixthAt(T) * cross(Turn, Once);
}

/// x of M x = V, a symmetric positive M; 0 where it is none.
Vector solved(const Matrix &M, const Vector &V) {
  const Vector A = cross(M[1], M[2]), B = cross(M[2], M[0]),
               C = cross(M[0], M[1]);
  const double Det = dot(M[0], A);
  if (!(Det > 0))
    return {};
  return (1 / Det) * (V[0] * A + V[1] * B + V[2] * C);
}

} // namespace

ProgramSpec poseProgram() { return kernels::pose::Program{}; }

Poses::Poses(Launcher &Launch, const TrainSettings &Rules,
             std::vector<Camera> Given, double CamerasExtent)
    : Launch(Launch), Settings(Rules), Cameras(std::move(Given)),
      Extent(CamerasExtent) {
  restart();
}

void Poses::restart() {
  State.restart(std::vector<float>(areOn() ? Terms * Cameras.size() : 0, 0));
}

void Poses::restore(const std::vector<float> &Saved) {
  restart();
  State.restore(Saved);
}

Camera Poses::at(std::size_t View) const {
  Camera C = Cameras[View];
  if (!areOn())
    return C;
  const float *V = State.data() + Terms * View;
  const Vector Shift{V[0], V[1], V[2]}, Turn{V[3], V[4], V[5]};
  C.Position = C.Position + Extent * times(C.Rotation, Shift);
  // Columns: where the camera's turned axes go.
  for (std::size_t K = 0; K < 3; ++K) {
    Vector Axis{};
    Axis[K] = 1;
    const Vector To = times(Cameras[View].Rotation, turned(Axis, Turn));
    for (std::size_t Row = 0; Row < 3; ++Row)
      C.Rotation[Row][K] = To[Row];
  }
  return C;
}

PoseSlope Poses::slope(std::size_t View, const PlanePair &Parameters,
                       const GradientRenderer::Backward &Back, uint32_t Count) {
  const std::size_t Groups = (std::size_t{Count} + Stretch - 1) / Stretch;
  std::vector<float> Sums(Terms * Groups);
  const cl::Buffer Parts = Launch.allocate("pose's gradients", 4 * Sums.size());
  cl_float4 High{}, Low{};
  const Camera C = at(View);
  for (std::size_t K = 0; K < 3; ++K) {
    High.s[K] = static_cast<float>(C.Position[K]);
    Low.s[K] = static_cast<float>(C.Position[K] - double{High.s[K]});
  }
  Launch.run(Groups * Lanes, Lanes,
             kernels::pose::pose_back{.geometry = Parameters.Geometry,
                                      .gradients = Back.Gradients.Geometry,
                                      .depths = Back.Seen.Depths,
                                      .sums = Parts,
                                      .count = Count,
                                      .stretch = Stretch,
                                      .high = High,
                                      .low = Low});
  Launch.read("pose's gradients", Sums.data(), Parts, 4 * Sums.size());
  PoseSlope By{};
  for (std::size_t I = 0; I < Sums.size(); ++I)
    By[I % Terms] -= Sums[I];
  return By;
}

void Poses::step(const std::vector<Slope> &Slopes, unsigned Iteration) {
  std::vector<double> Gradient(State.size(), 0);
  for (const Slope &S : Slopes) {
    const Matrix &Axes = Cameras[S.View].Rotation;
    const float *V = State.data() + Terms * S.View;
    const Vector ByShift = back(Axes, vectorAt(S.Gradient, 0));
    const Vector ByTurn =
        byTurn(back(Axes, vectorAt(S.Gradient, 3)), {V[3], V[4], V[5]});
    const auto Share = 1 / static_cast<double>(Slopes.size());
    for (std::size_t K = 0; K < 3; ++K) {
      Gradient[Terms * S.View + K] += Share * Extent * ByShift[K];
      Gradient[Terms * S.View + 3 + K] += Share * ByTurn[K];
    }
  }
  std::vector<double> Stepped =
      State.step(Settings, Gradient, poseRate(Settings, Iteration), Iteration);
  settle(Stepped);
  for (std::size_t I = 0; I < Stepped.size(); ++I)
    State.set(I, Stepped[I]);
}

/// Takes out of \p Stepped the common motion, turn and scale that fit it best,
/// shifts in world units and turns times the cameras' root mean square distance
/// from their centre. Corrections are small, so that they add up.
void Poses::settle(std::vector<double> &Stepped) const {
  const std::size_t N = Cameras.size();
  const double Share = 1 / static_cast<double>(N);
  Vector Centre{}, Motion{};
  std::vector<Vector> Shifts(N), Turns(N), Arms(N);
  for (std::size_t I = 0; I < N; ++I) {
    const Matrix &Axes = Cameras[I].Rotation;
    Shifts[I] = Extent * times(Axes, vectorAt(Stepped, Terms * I));
    Turns[I] = times(Axes, vectorAt(Stepped, Terms * I + 3));
    Centre = Centre + Share * Cameras[I].Position;
    Motion = Motion + Share * Shifts[I];
  }
  double Square = 0, Growth = 0;
  Matrix Inertia{};
  Vector Moment{};
  for (std::size_t I = 0; I < N; ++I) {
    Arms[I] = Cameras[I].Position - Centre;
    Square += dot(Arms[I], Arms[I]);
    Growth += dot(Arms[I], Shifts[I]);
    Moment = Moment + cross(Arms[I], Shifts[I]);
    for (std::size_t R = 0; R < 3; ++R)
      for (std::size_t K = 0; K < 3; ++K)
        Inertia[R][K] -= Arms[I][R] * Arms[I][K];
  }
  for (const Vector &T : Turns)
    Moment = Moment + (Square * Share) * T;
  for (std::size_t K = 0; K < 3; ++K)
    Inertia[K][K] += 2 * Square;
  const Vector Turn = solved(Inertia, Moment);
  const double Scale = Square > 0 ? Growth / Square : 0;
  for (std::size_t I = 0; I < N; ++I) {
    const Matrix &Axes = Cameras[I].Rotation;
    const Vector Shift =
        back(Axes, Shifts[I] - Motion - cross(Turn, Arms[I]) - Scale * Arms[I]);
    const Vector Own = back(Axes, Turns[I] - Turn);
    for (std::size_t K = 0; K < 3; ++K) {
      Stepped[Terms * I + K] = Shift[K] / Extent;
      Stepped[Terms * I + 3 + K] = Own[K];
    }
  }
}

PoseChange Poses::change() const {
  PoseChange C;
  const double Share = 1 / static_cast<double>(Cameras.size());
  for (std::size_t I = 0; I < State.size(); I += Terms) {
    const float *V = State.data() + I;
    const double Shift = Extent * length({V[0], V[1], V[2]});
    const double Turn = length({V[3], V[4], V[5]});
    C.MeanShift += Share * Shift;
    C.MeanTurn += Share * Turn;
    C.MostShift = std::max(C.MostShift, Shift);
    C.MostTurn = std::max(C.MostTurn, Turn);
  }
  return C;
}

} // namespace vorion::splat
