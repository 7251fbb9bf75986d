/// Edits of scenes: transforms, filters, merging.
#pragma once

#include "scene/Scene.h"

#include <array>
#include <cstddef>

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
/// rounded once: of means it takes and leaves the rests, too.
void transform(Scene &S, const Similarity &By);

/// A point p becomes Matrix p + Translation.
struct Affine {
  std::array<std::array<double, 3>, 3> Matrix{}; ///< rows, finite
  std::array<double, 3> Translation{};
};

/// Transforms \p S: Gaussians have the transformed covariance, even if the
/// matrix shears, mirrors or flattens. Spherical harmonics follow the matrix's
/// nearest orthogonal matrix, that of its polar decomposition.
void deform(Scene &S, const Affine &By);

/// Changes the SH degree; new coefficients are 0.
void setShDegree(Scene &S, int Degree);

/// Appends all of \p From, at the larger degree of the two.
void join(Scene &To, Scene From);

} // namespace vorion::splat
