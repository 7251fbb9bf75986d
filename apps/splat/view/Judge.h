/// The fp64 reference of what `splat view` shows. Works beside the device: its
/// pictures take seconds, in which the page may go on to ask for frames.
#pragma once

#include "reference/Types.h"
#include "view/FairLock.h"
#include "view/Request.h"
#include "view/ShownScene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace vorion::splat {

/// A Gaussian of a pixel, front to back.
struct PixelGaussian {
  int32_t Index = 0; ///< in the scene
  double Weight = 0; ///< alpha times the transmittance in front of it
  double Alpha = 0;
  double Depth = 0;              ///< camera z
  std::array<double, 3> Color{}; ///< before its weight
  /// What it costs in the picture: tiles whose lists hold it, and pixels of its
  /// box, which each get a lane slot of the rasterizer at most.
  uint64_t Tiles = 0, Pixels = 0;
  /// The largest difference of a channel that fp32 makes of its contribution,
  /// by the reference in fp32 with an exact exponential.
  double Error = 0;
};

class Judge {
public:
  /// The picture of \p View, 3 values a pixel, by the defaults of all knobs. It
  /// is not begun if \p GiveUp says so meanwhile; the error is then
  /// \c superseded(). The last one is kept.
  Expected<std::shared_ptr<const std::vector<double>>>
  picture(const std::shared_ptr<const ShownScene> &S, const Camera &View,
          const std::function<bool()> &GiveUp);

  /// What pixel (\p R.X, \p R.Y) is made of, by the knobs of \p R that the
  /// reference has.
  std::vector<PixelGaussian> pixel(const std::shared_ptr<const ShownScene> &S,
                                   const ViewRequest &R);

private:
  struct Kept {
    uint64_t Scene = 0;
    Camera View;
    std::shared_ptr<const std::vector<double>> Picture;
  };
  /// Needs the lock.
  template <typename Real>
  const reference::Gaussians<Real> &activated(const ShownScene &S);

  FairLock Lock;
  uint64_t Activated = 0; ///< number of the scene that these are of
  reference::Gaussians<double> InDouble;
  reference::Gaussians<float> InSingle;
  Kept Last;
};

} // namespace vorion::splat
