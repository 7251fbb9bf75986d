/// What training keeps on the device.
#pragma once

#include "device/Launcher.h"
#include "scene/Scene.h"

#include <cstdint>
#include <vector>

namespace vorion::splat {

/// A buffer of planes for the geometry and one for the colours: parameters,
/// their gradients, or a moment of the optimiser (layout.h, GEOMETRY_PLANES;
/// plane 3 k + c of the colours has coefficient k of channel c).
struct PlanePair {
  cl::Buffer Geometry, Sh;
};

/// A scene in training. All pairs have the same number of Gaussians and bands.
struct DeviceScene {
  uint32_t Count = 0;
  int ShDegree = 0;
  PlanePair Parameters;
  PlanePair First, Second; ///< Adam's moments
  /// A number of each Gaussian that stays its own whatever becomes of others
  /// (density.cl).
  cl::Buffer Identities;

  uint32_t colourPlanes() const {
    return static_cast<uint32_t>(3 * shCoefficients(ShDegree));
  }
  /// A pair for \p Gaussians of them.
  PlanePair allocate(Launcher &L, uint32_t Gaussians) const;

  /// \p S with moments of 0; identities count from 0.
  static DeviceScene upload(Launcher &L, const Scene &S);
  Scene download(Launcher &L) const;
  void uploadIdentities(Launcher &L, const std::vector<uint32_t> &From);
  std::vector<uint32_t> downloadIdentities(Launcher &L) const;
};

/// How many Gaussians \p Bytes of a device's memory hold in training, a change
/// of density included; pictures and lists of tiles take from that.
uint64_t mostInTraining(uint64_t Bytes, int ShDegree);

} // namespace vorion::splat
