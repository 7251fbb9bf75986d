/// Figures about a scene as one camera sees it, by which effects are decided.
#pragma once

#include "picture/Layout.h"
#include "picture/Options.h"
#include "scene/Scene.h"

#include <array>
#include <cstddef>

namespace vorion::splat {

/// From the stored parameters, in double precision. Bounds allow for what the
/// kernels round, so that a figure may say "needed" too often, never too
/// rarely.
struct ViewFacts {
  /// The smallest depth of a mean along the camera's axis, and how far from it
  /// the kernels' own may be.
  double NearestDepth = 0, DepthSlack = 0;
  /// Gaussians whose x/z or y/z may lie beyond the Jacobian's limits, among
  /// those in front of \c NearLimit.
  std::size_t BeyondField = 0;
  /// Means in front of the camera and within the picture, by its focal lengths
  /// alone (all in front where slopes have no limits), and how many of them the
  /// near plane takes away.
  std::size_t InView = 0, BeforeNear = 0;
  /// Of a mean's coordinates and the camera's, the largest magnitude.
  double Reach = 0;
  /// \name Of the camera, and of several the largest
  /// @{
  bool IsCrop = false;    ///< the principal point is outside the picture
  double FocalLength = 0; ///< px; of parallel rays, px a unit
  unsigned Side = 0;      ///< of the picture, px
  /// @}
  /// Needles that point at the camera so nearly that fp32 rounds off what the
  /// picture has of them.
  std::size_t Pointing = 0;
  double Farthest = 0; ///< from the camera, a mean, by its largest coordinate
  float LeastLogit = 0, MostLogit = 0; ///< of opacity
  /// Per band from 1: a Gaussian with a coefficient other than zero, the first
  /// there is, or \c NoWitness.
  static constexpr std::size_t NoWitness = ~std::size_t{0};
  std::array<std::size_t, MaxShDegree> BandWitness{NoWitness, NoWitness,
                                                   NoWitness};
};

/// The facts that need no scene.
ViewFacts factsOfCamera(const splat_view &View);

/// A NaN among the values gives figures by which everything is needed.
ViewFacts factsOf(const Scene &S, const splat_view &View,
                  const RenderOptions &Options);

/// Of two views of one scene: by these is needed what either needs.
/// Of the near plane, they are those of the view of which it takes the larger
/// share.
ViewFacts combined(const ViewFacts &A, const ViewFacts &B);

} // namespace vorion::splat
