/// Edits of scenes: transforms, filters, merging.
#pragma once

#include "scene/Scene.h"

#include <array>
#include <cstddef>
#include <functional>

namespace vorion::splat {

/// A point p becomes Scale Rotation p + Translation.
struct Similarity {
  double Scale = 1; ///< above 0
  /// Rows of a rotation: orthonormal, with determinant +1.
  std::array<std::array<double, 3>, 3> Rotation{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<double, 3> Translation{};

  bool operator==(const Similarity &) const = default;
};

/// The rotation about x, then about y, then about z, in degrees: the order of
/// PlayCanvas' tools.
std::array<std::array<double, 3>, 3>
rotationOf(const std::array<double, 3> &Degrees);

/// Transforms \p S: means, scales, rotations, and spherical harmonics, so that
/// an equally transformed camera has the same view. Computed in double and
/// rounded once.
void transform(Scene &S, const Similarity &By);

/// Multiplies lengths along each axis by \p Factors, which are above 0:
/// Gaussians have the transformed covariance. Spherical harmonics are
/// unchanged.
void stretch(Scene &S, const std::array<double, 3> &Factors);

/// Keeps the Gaussians whose index satisfies \p Keep, in order; returns the
/// number of dropped ones.
std::size_t keepOnly(Scene &S, const std::function<bool(std::size_t)> &Keep);

/// Changes the SH degree; new coefficients are 0.
void setShDegree(Scene &S, int Degree);

/// Appends all of \p From, at the larger degree of the two.
void join(Scene &To, Scene From);

} // namespace vorion::splat
