/// What is done to scenes before they are written: moved, cut, joined.
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

/// Moves \p S: means, sizes, rotations, and harmonics, so that a camera that is
/// moved with it sees the same. Computed in double and rounded once.
void transform(Scene &S, const Similarity &By);

/// Multiplies lengths along each axis by \p Factors, which are above 0:
/// Gaussians become those of the stretched covariance. Harmonics stay.
void stretch(Scene &S, const std::array<double, 3> &Factors);

/// Keeps the Gaussians, by number, for which \p Keep holds, in their order;
/// gives how many went.
std::size_t keepOnly(Scene &S, const std::function<bool(std::size_t)> &Keep);

/// Adds or drops bands of harmonics; new ones are zeros.
void setShDegree(Scene &S, int Degree);

/// Appends all of \p From, at the larger degree of the two.
void join(Scene &To, Scene From);

} // namespace vorion::splat
