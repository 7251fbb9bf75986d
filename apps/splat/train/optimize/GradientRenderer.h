/// Renders a scene in training and computes the gradients of its parameters.
#pragma once

#include "train/optimize/Density.h"
#include "train/optimize/DeviceScene.h"

#include "render/DepthTargets.h"
#include "render/TileDivision.h"

#include "io/Cameras.h"

#include <array>

namespace vorion::splat {

class GradientRenderer {
public:
  virtual ~GradientRenderer() = default;

  /// Sets the background of subsequent pictures. The renderer must be created
  /// for several backgrounds.
  virtual void setBackground(const std::array<float, 3> &Colour) = 0;

  /// Divides subsequent pictures by \p By; null: not. Returns false if this
  /// renderer always renders whole pictures.
  virtual bool divide(TileDivision * /*By*/) { return false; }

  /// The picture of \p S, four floats per pixel: colour over the background,
  /// and alpha. Bands of spherical harmonics above \p ShDegree are ignored. The
  /// buffer is valid until the next call.
  virtual cl::Buffer forward(const DeviceScene &S, const Camera &C,
                             int ShDegree) = 0;

  /// The result of the backward pass, valid until the next call.
  struct Backward {
    /// Gradients by all stored parameters of the scene that \c forward
    /// rendered; 0 for invisible Gaussians. Planes as in DeviceScene.h,
    /// possibly followed by others; ignored bands have none.
    PlanePair Gradients;
    SeenView Seen;
  };
  /// Computed from dL/d(picture), three floats per pixel, dL/d(alpha), one
  /// float per pixel, and the \p Known depths.
  virtual Backward backward(const cl::Buffer &ByRender,
                            const cl::Buffer &ByAlpha,
                            const DepthTargets &Known) = 0;
  /// Frees the result of backward().
  virtual void forget() {}
};

} // namespace vorion::splat
