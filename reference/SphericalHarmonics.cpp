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

template std::array<float, 16> shBasis(const glm::vec<3, float> &, int);
template std::array<double, 16> shBasis(const glm::vec<3, double> &, int);
template glm::vec<3, float> shColor(const glm::vec<3, float> *, int,
                                    const glm::vec<3, float> &);
template glm::vec<3, double> shColor(const glm::vec<3, double> *, int,
                                     const glm::vec<3, double> &);

} // namespace vorion::reference
