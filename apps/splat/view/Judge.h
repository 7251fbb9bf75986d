/// The fp64 reference of `splat view`. It works concurrently with the device:
/// its pictures take seconds, during which the page may request frames.
#pragma once

#include "reference/Mesh.h"
#include "reference/Types.h"
#include "render/Pipeline.h"
#include "view/FairLock.h"
#include "view/Request.h"
#include "view/ShownScene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace vorion::splat {

/// A Gaussian of a pixel's list, which is ordered from front to back.
struct PixelGaussian {
  int32_t Index = 0; ///< in the scene
  double Weight = 0; ///< alpha times the transmittance before it
  double Alpha = 0;
  double Depth = 0;              ///< camera z
  std::array<double, 3> Color{}; ///< before weighting
  /// Its cost in the picture: tiles whose lists contain it, and pixels of its
  /// bounding box, each of which takes at most one lane slot.
  uint64_t Tiles = 0, Pixels = 0;
  /// The largest error of a channel of its contribution in fp32, by the
  /// reference in fp32 with an exact exponential.
  double Error = 0;
};

/// A triangle of a pixel.
struct PixelTriangle {
  std::size_t Triangle = 0; ///< of the mesh
  std::size_t InFront = 0;  ///< Gaussians of the list in front of it
  double Weight = 0, Alpha = 0, Depth = 0; ///< as of a Gaussian
  std::array<double, 3> Color{};
};

/// What a pixel is made of, front to back.
struct PixelParts {
  std::vector<PixelGaussian> Gaussians;
  std::vector<PixelTriangle> Triangles;
};

/// Of a mesh it takes the triangles and depths that the machine has drawn
/// (docs/meshes.md, "Beside the reference"): \c Seen of its functions, null
/// without a mesh.
class Judge {
public:
  /// The picture of \p View, 3 values per pixel, with the defaults of all
  /// knobs. If \p GiveUp returns true before it starts, the error is \c
  /// superseded(). The last picture is cached.
  Expected<std::shared_ptr<const std::vector<double>>>
  picture(const std::shared_ptr<const ShownScene> &S, const Camera &View,
          const VisibleMesh *Seen, const std::function<bool()> &GiveUp);

  /// The parts of pixel (\p R.X, \p R.Y), with the knobs of \p R that the
  /// reference supports.
  PixelParts pixel(const std::shared_ptr<const ShownScene> &S,
                   const ViewRequest &R, const VisibleMesh *Seen);

private:
  struct Kept {
    uint64_t Scene = 0;
    Camera View;
    std::shared_ptr<const std::vector<double>> Picture;
  };
  /// Requires the lock.
  template <typename Real>
  const reference::Gaussians<Real> &activated(const ShownScene &S);
  /// The mesh of \p S, which has one. Requires the lock.
  const reference::Mesh &meshOf(const ShownScene &S);

  FairLock Lock;
  uint64_t Activated = 0; ///< number of the activated scene
  reference::Gaussians<double> InDouble;
  reference::Gaussians<float> InSingle;
  std::shared_ptr<const Mesh> Converted; ///< the mesh that Surface is
  reference::Mesh Surface;
  Kept Last;
};

} // namespace vorion::splat
