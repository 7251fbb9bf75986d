/// Renders a scene in training and goes back to its parameters' gradients.
#pragma once

#include "train/optimize/Density.h"
#include "train/optimize/DeviceScene.h"

#include "render/DepthTargets.h"

#include "io/Cameras.h"

#include <array>

namespace vorion::splat {

class GradientRenderer {
public:
  virtual ~GradientRenderer() = default;

  /// The colour behind the pictures from now on. Only a renderer that was told
  /// so at its start may have several.
  virtual void setBackground(const std::array<float, 3> &Colour) = 0;

  /// The picture of \p S, four floats a pixel: colour over the background, and
  /// alpha. Bands of spherical harmonics above \p ShDegree are left out. The
  /// buffer is valid until the next call.
  virtual cl::Buffer forward(const DeviceScene &S, const Camera &C,
                             int ShDegree) = 0;

  /// What the way back gives, valid until the next call.
  struct Backward {
    /// Of all parameters of the scene that \c forward rendered, as they are
    /// stored; 0 where a Gaussian was not seen. Planes as in DeviceScene.h,
    /// more may follow; bands that were left out have none.
    PlanePair Gradients;
    SeenView Seen;
  };
  /// From dL/d(that picture), three floats a pixel, and dL/d(alpha), one; and
  /// from what is \p Known of its depths.
  virtual Backward backward(const cl::Buffer &ByRender,
                            const cl::Buffer &ByAlpha,
                            const DepthTargets &Known) = 0;
  /// Frees what backward() gave: nobody needs it before the next call.
  virtual void forget() {}
};

} // namespace vorion::splat
