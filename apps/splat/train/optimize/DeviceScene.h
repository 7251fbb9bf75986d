/// What training keeps on the device.
#pragma once

#include "device/Launcher.h"
#include "picture/Layout.h"
#include "scene/Scene.h"
#include "train/optimize/MomentPlanes.h"

#include <cstdint>
#include <vector>

namespace vorion::splat {

/// A buffer of planes for the geometry and one for the colours: parameters or
/// their gradients (layout.h, GEOMETRY_PLANES; plane 3 k + c of the colours has
/// coefficient k of channel c).
struct PlanePair {
  cl::Buffer Geometry, Sh;
};
/// The same of one of the optimiser's moments.
struct MomentPair {
  MomentPlanes Geometry, Sh;
};

/// A scene in training. All pairs have the same number of Gaussians and bands.
struct DeviceScene {
  uint32_t Count = 0;
  int ShDegree = 0;
  PlanePair Parameters;
  MomentPair First, Second; ///< Adam's moments
  /// A number of each Gaussian that stays its own whatever becomes of others
  /// (density.cl).
  cl::Buffer Identities;

  uint32_t colourPlanes() const {
    return static_cast<uint32_t>(3 * shCoefficients(ShDegree));
  }
  /// Moments of \p New, which has another number of Gaussians: Do(from, to,
  /// planes) makes them of those here, one after the other, and those here go.
  template <typename Work>
  void remakeMoments(Launcher &L, DeviceScene &New, Work Do) {
    for (MomentPair DeviceScene::*M :
         {&DeviceScene::First, &DeviceScene::Second}) {
      MomentPair &From = this->*M, &To = New.*M;
      To = {From.Geometry.remade(L, Count, GEOMETRY_PLANES, New.Count, Do),
            From.Sh.remade(L, Count, colourPlanes(), New.Count, Do)};
      From = {};
    }
  }
  /// A pair for \p Gaussians of them.
  PlanePair allocate(Launcher &L, uint32_t Gaussians) const;

  /// \p S with moments of 0, which lie on \p Where; identities count from 0.
  static DeviceScene upload(Launcher &L, const Scene &S,
                            MomentsOn Where = MomentsOn::Device);
  Scene download(Launcher &L) const;
  void uploadIdentities(Launcher &L, const std::vector<uint32_t> &From);
  std::vector<uint32_t> downloadIdentities(Launcher &L) const;
};

/// How many Gaussians \p Bytes of a device's memory hold in training, a change
/// of density included; pictures and lists of tiles take from that.
uint64_t mostInTraining(uint64_t Bytes, int ShDegree, MomentsOn Where);

} // namespace vorion::splat
