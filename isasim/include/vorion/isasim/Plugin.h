/// Observers and exponential units of somebody else's, in a shared object that
/// `vorion-sim --plugin` and VORION_PLUGINS load (docs/plugins.md).
#pragma once

#include "vorion/isasim/Observer.h"

#include <cstdint>
#include <memory>

namespace vorion::isasim {

/// What Plugin and Observer's functions are, and mean. A simulator takes
/// plugins of its own number alone.
inline constexpr uint32_t PluginVersion = 2;

/// Differs where what these functions are given has other sizes.
constexpr uint64_t pluginLayout() {
  uint64_t Hash = 0;
  for (const uint64_t Size :
       {sizeof(Config), sizeof(Commit), sizeof(MemoryAccess), sizeof(Observer),
        sizeof(RunResult), sizeof(RunStart), sizeof(Step), sizeof(Trap)})
    Hash = Hash * 8191 + Size;
  return Hash;
}

/// A unit with which the lanes of all rasterizers of the process compute in the
/// place of one of their own. The clock knows only that one's time and area.
struct ExpUnitPlugin {
  /// The one that it replaces, by its name in docs/model.md: "table", "poly2".
  const char *Replaces = nullptr;
  /// exp(Power) for Power <= 0, at most e times too large. The same Power must
  /// give the same bits, from several threads at once. Null: no unit.
  float (*Evaluate)(float Power) = nullptr;
};

struct Plugin {
  uint32_t Version = PluginVersion; ///< stays first in every version
  uint64_t Layout = pluginLayout();
  /// Makes what watches one machine. It is told of all its runs, and destroyed
  /// with the machine. Null: nothing watches.
  std::unique_ptr<Observer> (*Make)() = nullptr;
  ExpUnitPlugin Exp = {};
};

} // namespace vorion::isasim

/// What a plugin defines, under a name of C.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" const vorion::isasim::Plugin vorion_plugin;
