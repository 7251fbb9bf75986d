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

/// max(0, 0.5 + the sum over the coefficients \p Sh) evaluated in direction \p
/// Along, which need not be normalized; if it is zero, only the constant term
/// is used.
template <typename Real>
glm::vec<3, Real> shColor(const glm::vec<3, Real> *Sh, int Degree,
                          const glm::vec<3, Real> &Along);

/// Backward pass of \c shColor: from dL/dcolour \p Gradient to
/// dL/dcoefficients, which are written to \p ShGradient, and dL/d\p Along,
/// which is returned. The gradients of a channel that is clamped to 0 are 0.
glm::dvec3 shBackward(const glm::dvec3 *Sh, int Degree, const glm::dvec3 &Along,
                      const glm::dvec3 &Gradient, glm::dvec3 *ShGradient);

} // namespace vorion::reference
