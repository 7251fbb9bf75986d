/// Properties of a scene in a view, by which effects are decided.
#pragma once

#include "picture/Layout.h"
#include "picture/Options.h"
#include "scene/Scene.h"

#include <array>
#include <cstddef>

namespace vorion::splat {

/// Computed from the stored parameters in double precision. Bounds include the
/// rounding errors of the kernels, so that effects may be enabled without need,
/// but are never missing.
struct ViewFacts {
  /// The smallest depth of a mean along the camera's axis, and a bound of its
  /// error in the kernels.
  double NearestDepth = 0, DepthSlack = 0;
  /// Number of Gaussians beyond \c NearLimit whose x/z or y/z may exceed the
  /// limits of the Jacobian.
  std::size_t BeyondField = 0;
  /// Number of means in front of the camera and in the picture, by its focal
  /// lengths only (all in front if slopes have no limits), and number of these
  /// that the near plane culls.
  std::size_t InView = 0, BeforeNear = 0;
  /// The largest magnitude of a coordinate of a mean or the camera.
  double Reach = 0;
  /// \name Properties of the camera; the largest of several cameras
  /// @{
  bool IsCrop = false;    ///< the principal point is outside the picture
  double FocalLength = 0; ///< px; for an orthographic camera px per unit
  unsigned Side = 0;      ///< longest side of the picture, px
  /// @}
  /// Number of needles towards the camera whose footprints lose precision in
  /// fp32.
  std::size_t Pointing = 0;
  double Farthest = 0; ///< distance of a mean from the camera, maximum norm
  float LeastLogit = 0, MostLogit = 0; ///< logits of opacity
  /// For each band from 1: the first Gaussian with a nonzero coefficient, or \c
  /// NoWitness.
  static constexpr std::size_t NoWitness = ~std::size_t{0};
  std::array<std::size_t, MaxShDegree> BandWitness{NoWitness, NoWitness,
                                                   NoWitness};
};

/// The properties that do not depend on the scene.
ViewFacts factsOfCamera(const splat_view &View);

/// If a value is NaN, all effects are needed.
ViewFacts factsOf(const Scene &S, const splat_view &View,
                  const RenderOptions &Options);

/// The combination for two views of a scene, which need an effect if one of
/// them does. The figures of the near plane are those of the view in which it
/// culls the larger fraction.
ViewFacts combined(const ViewFacts &A, const ViewFacts &B);

} // namespace vorion::splat
