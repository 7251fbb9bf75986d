/// Internal to the reference: the steps from a Gaussian's shape to its
/// footprint, which the projection and its backward pass share.
#pragma once

#include "Lens.h"

#include <algorithm>

namespace vorion::reference {

template <typename Real> using Vec2 = glm::vec<2, Real>;
template <typename Real> using Vec3 = glm::vec<3, Real>;
template <typename Real> using Mat3 = glm::mat<3, 3, Real>;

/// M v and A B with sums from left to right; unlike in GLM, the order is
/// guaranteed.
template <typename Real>
Vec3<Real> multiply(const Mat3<Real> &M, const Vec3<Real> &V) {
  Vec3<Real> R;
  for (int I = 0; I < 3; ++I)
    R[I] = M[0][I] * V[0] + M[1][I] * V[1] + M[2][I] * V[2];
  return R;
}

template <typename Real>
Mat3<Real> multiply(const Mat3<Real> &A, const Mat3<Real> &B) {
  Mat3<Real> R;
  for (int J = 0; J < 3; ++J)
    R[J] = multiply(A, B[J]);
  return R;
}

/// The rotation matrix of a unit quaternion (w, x, y, z); the identity for a
/// zero quaternion.
template <typename Real> Mat3<Real> rotation(const glm::vec<4, Real> &Q) {
  const Real W = Q[0], X = Q[1], Y = Q[2], Z = Q[3];
  // GLM's constructor takes columns.
  return Mat3<Real>(
      1 - 2 * (Y * Y + Z * Z), 2 * (X * Y + W * Z), 2 * (X * Z - W * Y),
      2 * (X * Y - W * Z), 1 - 2 * (X * X + Z * Z), 2 * (Y * Z + W * X),
      2 * (X * Z + W * Y), 2 * (Y * Z - W * X), 1 - 2 * (X * X + Y * Y));
}

/// Bounds of x/z or y/z in the Jacobian: lower, upper. Outside the frame the
/// affine approximation diverges, so it is evaluated at the bound.
template <typename Real>
Vec2<Real> slopeLimits(Rules Rule, Real Size, Real Focal, Real Principal) {
  const Real Half = Size / (2 * Focal); // tan(fov / 2)
  if (Rule == Rules::Inria)
    return {Real(-1.3) * Half, Real(1.3) * Half};
  return {-(Principal / Focal + Real(0.3) * Half),
          (Size - Principal) / Focal + Real(0.3) * Half};
}

/// The rows (XX, 0, XZ) and (0, YY, YZ) of the projection's Jacobian.
template <typename Real> struct Jacobian {
  Real XX, XZ, YY, YZ;
  Real Tx, Ty;       ///< x and y, held so that x/z and y/z are in their limits
  bool HeldX, HeldY; ///< whether they were beyond
};

template <typename Real>
Jacobian<Real> jacobian(const Vec3<Real> &P, const Camera<Real> &C,
                        Rules Rule) {
  const Vec2<Real> LimX =
      slopeLimits(Rule, Real(C.Width), C.Focal.x, C.Principal.x);
  const Vec2<Real> LimY =
      slopeLimits(Rule, Real(C.Height), C.Focal.y, C.Principal.y);
  const Real SlopeX = P.x / P.z, SlopeY = P.y / P.z;
  Jacobian<Real> J;
  J.HeldX = SlopeX < LimX[0] || LimX[1] < SlopeX;
  J.HeldY = SlopeY < LimY[0] || LimY[1] < SlopeY;
  J.Tx = std::clamp(SlopeX, LimX[0], LimX[1]) * P.z;
  J.Ty = std::clamp(SlopeY, LimY[0], LimY[1]) * P.z;
  const Real ZZ = P.z * P.z;
  J.XX = C.Focal.x / P.z;
  J.XZ = -(C.Focal.x * J.Tx) / ZZ;
  J.YY = C.Focal.y / P.z;
  J.YZ = -(C.Focal.y * J.Ty) / ZZ;
  return J;
}

/// dL/d(point) from dL/d(rows) of its Jacobian \p J at the depth \p Z. INRIA's
/// rules treat a clamped coordinate as a constant, and gsplat's differentiate
/// its limit.
inline glm::dvec3 backThroughJacobian(const Jacobian<double> &J, double Z,
                                      const glm::dvec2 &Focal, Rules Rule,
                                      const LensRows<double> &ByRows) {
  const double ZZ = Z * Z;
  glm::dvec3 By(0, 0, -(Focal.x * ByRows.X.x + Focal.y * ByRows.Y.y) / ZZ);
  // The entry -f t / z^2, where t may be limit z.
  const auto Entry = [&](bool Held, double F, double T, double ByEntry) {
    const double Factor = Held && Rule == Rules::Gsplat ? 1 : 2;
    By.z += Factor * F * T / (ZZ * Z) * ByEntry;
    return Held ? 0 : -F / ZZ * ByEntry;
  };
  By.x = Entry(J.HeldX, Focal.x, J.Tx, ByRows.X.z);
  By.y = Entry(J.HeldY, Focal.y, J.Ty, ByRows.Y.z);
  return By;
}

/// The rows of J A.
template <typename Real> struct Footprint {
  Vec3<Real> X, Y;
};

template <typename Real>
Footprint<Real> footprint(const Mat3<Real> &A, const Jacobian<Real> &J) {
  Footprint<Real> F;
  for (int K = 0; K < 3; ++K) {
    F.X[K] = J.XX * A[K][0] + J.XZ * A[K][2];
    F.Y[K] = J.YY * A[K][1] + J.YZ * A[K][2];
  }
  return F;
}

template <typename Real>
Real dotFromLeft(const Vec3<Real> &A, const Vec3<Real> &B) {
  return A[0] * B[0] + A[1] * B[1] + A[2] * B[2];
}

/// The rows of a lens times A.
template <typename Real>
Footprint<Real> footprint(const Mat3<Real> &A, const LensRows<Real> &J) {
  Footprint<Real> F;
  for (int K = 0; K < 3; ++K) {
    F.X[K] = dotFromLeft(J.X, A[K]);
    F.Y[K] = dotFromLeft(J.Y, A[K]);
  }
  return F;
}

/// The determinant of the covariance before dilation.
template <typename Real> Real sharpDeterminant(const Footprint<Real> &F) {
  const Real M01 = F.X[0] * F.Y[1] - F.X[1] * F.Y[0];
  const Real M02 = F.X[0] * F.Y[2] - F.X[2] * F.Y[0];
  const Real M12 = F.X[1] * F.Y[2] - F.X[2] * F.Y[1];
  return M01 * M01 + M02 * M02 + M12 * M12;
}

/// Depth of the near plane.
inline double nearLimit(const Options &O) {
  return O.Near > 0 ? O.Near : O.Rule == Rules::Inria ? 0.2 : 0.01;
}

/// Whether depth \p Z is beyond the near plane; false for a NaN.
template <typename Real> bool inFront(Real Z, const Options &O) {
  const auto Limit = static_cast<Real>(nearLimit(O));
  return O.Rule == Rules::Inria ? Z > Limit : Z >= Limit;
}

} // namespace vorion::reference
