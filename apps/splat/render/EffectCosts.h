/// What each effect costs a frame, by rendering it with and without; and what
/// it costs to choose them otherwise than by the scene.
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

/// The frame with its effects chosen in one way.
struct ModeCost {
  EffectRequest::Mode Selection;
  uint64_t Instructions = 0, Cycles = 0;
  std::string On;   ///< the machine that the cycles are of
  std::string Hash; ///< pictureHash()
  /// Processor seconds of the host for the frame without the clock, with its
  /// programs compiled before; one for each run, rising.
  std::vector<double> Seconds;

  double median() const { return Seconds[Seconds.size() / 2]; }
};

/// Renders the frame with `auto`, `flags` and `all`, in this order, each time
/// in a process of its own: once by \p Clocked, which opens the device with its
/// clock on, and \p Runs times by \p Plain. The runs of the three alternate. To
/// be called before a device is opened here. An Error if \p Clocked gives no
/// time.
Expected<std::vector<ModeCost>>
measureModes(const DeviceOpener &Clocked, const DeviceOpener &Plain,
             const std::string &KernelFolder, const EffectInputs &In,
             const Camera &C, unsigned Runs,
             const std::function<void(std::string_view)> &Progress);

/// One sentence on \p Modes, which measureModes() gave: which of them takes the
/// fewest cycles, what the others take more, and whether the pictures are the
/// same.
std::string verdictOf(const std::vector<ModeCost> &Modes);

} // namespace vorion::splat
