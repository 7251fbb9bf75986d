/// View-dependent colour.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace vorion::reference {

/// The real spherical harmonics of degree 0 to \p Degree (at most 3) in
/// direction \p D of unit length, in the order and with the signs of the 3DGS
/// file layout: for degree 1 -y, z, -x.
template <typename Real>
std::array<Real, 16> shBasis(const glm::vec<3, Real> &D, int Degree);

/// max(0, 0.5 + the sum over the coefficients \p Sh) seen along \p Along, which
/// need not be of unit length; where it is zero only the constant term counts.
template <typename Real>
glm::vec<3, Real> shColor(const glm::vec<3, Real> *Sh, int Degree,
                          const glm::vec<3, Real> &Along);

} // namespace vorion::reference
