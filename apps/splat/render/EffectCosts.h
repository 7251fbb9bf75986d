/// What each effect costs a frame, by rendering it with and without.
#pragma once

#include "effects/EffectPlan.h"
#include "render/Renderer.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// The frame with an effect less the frame without it.
struct EffectCost {
  const Effect *Subject = nullptr;
  bool Done = false; ///< in the picture that was asked for
  int64_t Instructions = 0;
  int64_t Cycles = 0;  ///< 0 without the clock
  std::string Failure; ///< why there is no figure, or empty
};

struct EffectCosts {
  /// Of the frame as asked for.
  uint64_t Instructions = 0;
  uint64_t Cycles = 0;
  std::string On; ///< the machine that they are of, empty without the clock
  /// Effects whose code can be told from the rest, in the registry's order.
  std::vector<EffectCost> Effects;
};

/// What opens the device.
using DeviceOpener = std::function<Expected<Device>()>;

/// Renders the frame of \p Request, and once with each effect switched: each in
/// a process of its own, so that all begin with the same machine, whose caches
/// are empty, as any first frame does. To be called before a device is opened
/// here. \p Progress is told which.
Expected<EffectCosts>
measureEffects(const DeviceOpener &Open, const std::string &KernelFolder,
               const EffectRequest &Request, const EffectInputs &In,
               const Camera &C,
               const std::function<void(std::string_view)> &Progress);

/// A line an effect.
std::string toString(const EffectCosts &Costs);

} // namespace vorion::splat
