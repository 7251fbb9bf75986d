#include "SphericalHarmonics.h"

#include <cmath>

namespace vorion::reference {

// The factors are the usual normalisation of real spherical harmonics, e.g.
// sqrt(1 / (4 pi)) and sqrt(3 / (4 pi)), to the precision of a double.
template <typename Real>
std::array<Real, 16> shBasis(const glm::vec<3, Real> &D, int Degree) {
  std::array<Real, 16> B{};
  B[0] = Real(0.28209479177387814);
  if (Degree < 1)
    return B;
  constexpr Real C1 = Real(0.4886025119029199);
  const Real X = D.x, Y = D.y, Z = D.z;
  B[1] = -C1 * Y;
  B[2] = C1 * Z;
  B[3] = -C1 * X;
  if (Degree < 2)
    return B;
  const Real XX = X * X, YY = Y * Y, ZZ = Z * Z;
  B[4] = Real(1.0925484305920792) * X * Y;
  B[5] = Real(-1.0925484305920792) * Y * Z;
  B[6] = Real(0.31539156525252005) * (2 * ZZ - XX - YY);
  B[7] = Real(-1.0925484305920792) * X * Z;
  B[8] = Real(0.5462742152960396) * (XX - YY);
  if (Degree < 3)
    return B;
  B[9] = Real(-0.5900435899266435) * Y * (3 * XX - YY);
  B[10] = Real(2.890611442640554) * X * Y * Z;
  B[11] = Real(-0.4570457994644658) * Y * (4 * ZZ - XX - YY);
  B[12] = Real(0.3731763325901154) * Z * (2 * ZZ - 3 * XX - 3 * YY);
  B[13] = Real(-0.4570457994644658) * X * (4 * ZZ - XX - YY);
  B[14] = Real(1.445305721320277) * Z * (XX - YY);
  B[15] = Real(-0.5900435899266435) * X * (XX - 3 * YY);
  return B;
}

template <typename Real>
glm::vec<3, Real> shColor(const glm::vec<3, Real> *Sh, int Degree,
                          const glm::vec<3, Real> &Along) {
  const Real Length =
      std::sqrt(Along.x * Along.x + Along.y * Along.y + Along.z * Along.z);
  const bool HasDirection = Length > 0;
  const auto B =
      shBasis(HasDirection ? Along / Length : Along, HasDirection ? Degree : 0);
  glm::vec<3, Real> Color(0);
  for (int K = 0; K < (Degree + 1) * (Degree + 1); ++K)
    Color += B[static_cast<std::size_t>(K)] * Sh[K];
  Color += Real(0.5);
  for (int Channel = 0; Channel < 3; ++Channel)
    if (!(Color[Channel] > 0))
      Color[Channel] = 0;
  return Color;
}

/// d(basis function)/d(x, y, z) of \c shBasis, as of polynomials.
static std::array<glm::dvec3, 16> shBasisGradients(const glm::dvec3 &D) {
  const double X = D.x, Y = D.y, Z = D.z;
  constexpr double C1 = 0.4886025119029199, C4 = 1.0925484305920792,
                   C6 = 0.31539156525252005, C8 = 0.5462742152960396,
                   C9 = 0.5900435899266435, C10 = 2.890611442640554,
                   C11 = 0.4570457994644658, C12 = 0.3731763325901154,
                   C14 = 1.445305721320277;
  const double XX = X * X, YY = Y * Y, ZZ = Z * Z;
  return {glm::dvec3(0),
          {0, -C1, 0},
          {0, 0, C1},
          {-C1, 0, 0},
          {C4 * Y, C4 * X, 0},
          {0, -C4 * Z, -C4 * Y},
          {-2 * C6 * X, -2 * C6 * Y, 4 * C6 * Z},
          {-C4 * Z, 0, -C4 * X},
          {2 * C8 * X, -2 * C8 * Y, 0},
          {-6 * C9 * X * Y, -3 * C9 * (XX - YY), 0},
          {C10 * Y * Z, C10 * X * Z, C10 * X * Y},
          {2 * C11 * X * Y, -C11 * (4 * ZZ - XX - 3 * YY), -8 * C11 * Y * Z},
          {-6 * C12 * X * Z, -6 * C12 * Y * Z, 3 * C12 * (2 * ZZ - XX - YY)},
          {-C11 * (4 * ZZ - 3 * XX - YY), 2 * C11 * X * Y, -8 * C11 * X * Z},
          {2 * C14 * X * Z, -2 * C14 * Y * Z, C14 * (XX - YY)},
          {-3 * C9 * (XX - YY), 6 * C9 * X * Y, 0}};
}

glm::dvec3 shBackward(const glm::dvec3 *Sh, int Degree, const glm::dvec3 &Along,
                      const glm::dvec3 &Gradient, glm::dvec3 *ShGradient) {
  const glm::dvec3 Color = shColor(Sh, Degree, Along);
  glm::dvec3 G = Gradient;
  for (int Channel = 0; Channel < 3; ++Channel)
    if (!(Color[Channel] > 0))
      G[Channel] = 0;
  const double Length =
      std::sqrt(Along.x * Along.x + Along.y * Along.y + Along.z * Along.z);
  if (!(Length > 0)) {
    ShGradient[0] = shBasis(Along, 0)[0] * G;
    return glm::dvec3(0);
  }
  const glm::dvec3 D = Along / Length;
  const auto Basis = shBasis(D, Degree);
  const auto ByD = shBasisGradients(D);
  glm::dvec3 Direction(0);
  const auto Bands = static_cast<std::size_t>(Degree) + 1;
  for (std::size_t K = 0; K < Bands * Bands; ++K) {
    ShGradient[K] = Basis[K] * G;
    Direction += ByD[K] * (Sh[K].x * G.x + Sh[K].y * G.y + Sh[K].z * G.z);
  }
  // Through the normalisation: what lies along D is lost.
  const double Radial =
      Direction.x * D.x + Direction.y * D.y + Direction.z * D.z;
  return (Direction - Radial * D) / Length;
}

template std::array<float, 16> shBasis(const glm::vec<3, float> &, int);
template std::array<double, 16> shBasis(const glm::vec<3, double> &, int);
template glm::vec<3, float> shColor(const glm::vec<3, float> *, int,
                                    const glm::vec<3, float> &);
template glm::vec<3, double> shColor(const glm::vec<3, double> *, int,
                                     const glm::vec<3, double> &);

} // namespace vorion::reference
