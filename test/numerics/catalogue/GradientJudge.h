/// Holds a scene's gradients on the device against the reference's in fp64.
#pragma once

#include "HardCase.h"
#include "TrainingCase.h"

namespace vorion::test {

/// A scene with its view, and what must come of it.
struct GradientScene {
  splat::Scene Scene;
  splat::Camera View;
  splat::RenderOptions Options;
  /// Gaussians that are culled: all their gradients must be 0 exactly. The
  /// reference does without them.
  std::vector<uint32_t> Culled{};
  /// How many of the others have no gradient by their opacity, in fp64 and on
  /// the device alike.
  // May be left out: NOLINTNEXTLINE(readability-redundant-member-init)
  std::optional<std::size_t> Silent{};
  /// Depths are equal to the bit: no order is doubtful.
  bool AreTied = false;
};

/// Largest relative difference in the L2 norm of any kind of gradient
/// (docs/numerics.md, "Gradients"), which is at most \p Bound. The loss is a
/// random number for every channel of the pixels that are not doubtful.
Expected<Finding> judgeGradients(splat::Launcher &L, const Way &W,
                                 const GradientScene &S, double Bound);

} // namespace vorion::test
