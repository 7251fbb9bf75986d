/// The state of training on the device.
#pragma once

#include "device/Launcher.h"
#include "picture/Layout.h"
#include "scene/Scene.h"
#include "train/optimize/MomentPlanes.h"

#include <cstdint>
#include <vector>

namespace vorion::splat {

/// Buffers of planes for geometry and colours: parameters or their gradients
/// (layout.h, GEOMETRY_PLANES; plane 3 k + c of the colours has coefficient k
/// of channel c).
struct PlanePair {
  cl::Buffer Geometry, Sh;
};
/// The same for a moment of the optimizer.
struct MomentPair {
  MomentPlanes Geometry, Sh;
};

/// A scene in training. All pairs have the same number of Gaussians and bands.
struct DeviceScene {
  uint32_t Count = 0;
  int ShDegree = 0;
  PlanePair Parameters;
  MomentPair First, Second; ///< Adam's moments
  /// The identity of each Gaussian, which changes of others do not affect
  /// (density.cl).
  cl::Buffer Identities;

  uint32_t colourPlanes() const {
    return static_cast<uint32_t>(3 * shCoefficients(ShDegree));
  }
  /// Converts the moments to those of \p New, which has another number of
  /// Gaussians, by Do(from, to, planes) for one moment after another, and frees
  /// the old ones.
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
  /// Allocates a pair for \p Gaussians Gaussians.
  PlanePair allocate(Launcher &L, uint32_t Gaussians) const;

  /// Uploads \p S, with moments of 0 in the memory \p Where and identities from
  /// 0 on.
  static DeviceScene upload(Launcher &L, const Scene &S,
                            MomentsOn Where = MomentsOn::Device);
  Scene download(Launcher &L) const;
  void uploadIdentities(Launcher &L, const std::vector<uint32_t> &From);
  std::vector<uint32_t> downloadIdentities(Launcher &L) const;
};

/// Maximum number of Gaussians in training with \p Bytes of device memory,
/// including a change of density. Pictures and lists of tiles reduce it.
uint64_t mostInTraining(uint64_t Bytes, int ShDegree, MomentsOn Where);

} // namespace vorion::splat
