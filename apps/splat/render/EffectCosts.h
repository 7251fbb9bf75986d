/// The cost of each effect, measured by rendering a frame with and without it,
/// and the cost of other modes of --effects.
#pragma once

#include "effects/EffectPlan.h"
#include "render/Renderer.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// The cost of a frame with an effect minus that without it.
struct EffectCost {
  const Effect *Subject = nullptr;
  bool Done = false; ///< in the requested picture
  int64_t Instructions = 0;
  int64_t Cycles = 0;  ///< 0 without the clock
  std::string Failure; ///< reason of a failure, or empty
};

struct EffectCosts {
  /// Counts of the requested frame.
  uint64_t Instructions = 0;
  uint64_t Cycles = 0;
  std::string On; ///< the machine, empty without the clock
  /// Effects that can be switched, in the order of the registry.
  std::vector<EffectCost> Effects;
};

/// Opens the device.
using DeviceOpener = std::function<Expected<Device>()>;

/// Renders the frame of \p Request, and once with each effect switched, each in
/// its own process, so that all start with the empty caches of a new machine.
/// Must be called before a device is opened in this process. \p Progress is
/// called with the name of each.
Expected<EffectCosts>
measureEffects(const DeviceOpener &Open, const std::string &KernelFolder,
               const EffectRequest &Request, const EffectInputs &In,
               const Camera &C,
               const std::function<void(std::string_view)> &Progress);

/// One line for each effect.
std::string toString(const EffectCosts &Costs);

/// The cost of a frame in one mode of --effects.
struct ModeCost {
  EffectRequest::Mode Selection;
  uint64_t Instructions = 0, Cycles = 0;
  std::string On;   ///< the machine of the cycles
  std::string Hash; ///< pictureHash()
  /// Processor seconds of the host for the frame without the clock, excluding
  /// the compilation of programs; one for each run, in ascending order.
  std::vector<double> Seconds;

  double median() const { return Seconds[Seconds.size() / 2]; }
};

/// Renders the frame with `auto`, `flags` and `all`, in this order, each in its
/// own process: once by \p Clocked, which opens the device with its clock on,
/// and \p Runs times by \p Plain. The runs of the three modes alternate. Must
/// be called before a device is opened in this process. An Error if \p Clocked
/// yields no time.
Expected<std::vector<ModeCost>>
measureModes(const DeviceOpener &Clocked, const DeviceOpener &Plain,
             const std::string &KernelFolder, const EffectInputs &In,
             const Camera &C, unsigned Runs,
             const std::function<void(std::string_view)> &Progress);

/// One sentence about \p Modes, the result of measureModes(): the mode with the
/// fewest cycles, the increase of the others, and whether the pictures are
/// identical.
std::string verdictOf(const std::vector<ModeCost> &Modes);

} // namespace vorion::splat
