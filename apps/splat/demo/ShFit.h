/// Fits a colour that depends on the direction of view with spherical
/// harmonics of degree 3.
#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>

namespace vorion::splat::demo {

inline constexpr int ShTerms = 16;

/// [coefficient][channel] of a Gaussian, as in \c Scene::Sh.
using ShColor = std::array<glm::vec3, ShTerms>;

/// The basis at unit vector \p D, in the order and with the signs of
/// kernels/sh.cl.
std::array<double, ShTerms> shBasis(const glm::dvec3 &D);

/// Least squares over directions from the camera that see the side of
/// \p Normal: the renderer's max(0, SH + 0.5) comes near \p Color there.
/// Higher bands are damped, so that what cannot be fitted is blurred and does
/// not ring.
ShColor fitColor(const glm::vec3 &Normal,
                 const std::function<glm::vec3(const glm::vec3 &)> &Color);

/// The same colour from everywhere.
ShColor constantColor(const glm::vec3 &Color);

} // namespace vorion::splat::demo
