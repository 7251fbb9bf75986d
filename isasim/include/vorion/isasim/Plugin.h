/// Third-party observers, exponential units and policies of the clock, in a
/// shared object that `vorion-sim --plugin` and VORION_PLUGINS load
/// (docs/plugins.md).
#pragma once

#include "vorion/isasim/Observer.h"
#include "vorion/isasim/Policies.h"

#include <cstdint>
#include <memory>

namespace vorion::isasim {

/// Version of the plugin interface and of its semantics. A simulator loads only
/// plugins of its own version.
inline constexpr uint32_t PluginVersion = 3;

/// Hash of the sizes of the types in the interface.
constexpr uint64_t pluginLayout() {
  uint64_t Hash = 0;
  for (const uint64_t Size :
       {sizeof(Config), sizeof(Commit), sizeof(MemoryAccess), sizeof(Observer),
        sizeof(RunResult), sizeof(RunStart), sizeof(Step), sizeof(Trap),
        sizeof(CacheInfo), sizeof(LineUse), sizeof(DramInfo),
        sizeof(DramCandidate), sizeof(CoreInfo), sizeof(WarpToIssue)})
    Hash = Hash * 8191 + Size;
  return Hash;
}

/// A unit that replaces an exponential unit in the lanes of all rasterizers of
/// the process. The timing and area models keep the values of the replaced
/// unit.
struct ExpUnitPlugin {
  /// Name of the replaced unit in docs/model.md: "table", "poly2".
  const char *Replaces = nullptr;
  /// exp(Power) for Power <= 0, at most e times too large. Must be
  /// deterministic and thread-safe. Null: no unit.
  float (*Evaluate)(float Power) = nullptr;
};

struct Plugin {
  uint32_t Version = PluginVersion; ///< stays first in every version
  uint64_t Layout = pluginLayout();
  /// Creates the observer of a machine. It is notified of all runs of the
  /// machine, and destroyed with it. Null: no observer.
  std::unique_ptr<Observer> (*Make)() = nullptr;
  ExpUnitPlugin Exp = {};
  /// Each replaces what other units have by themselves, in all machines of the
  /// process that are opened from then on.
  PolicyMakers Policies = {};
};

} // namespace vorion::isasim

/// The entry point that a plugin defines, with C linkage.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" const vorion::isasim::Plugin vorion_plugin;
