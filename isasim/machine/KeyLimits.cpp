#include "machine/KeyLimits.h"

#include "timing/core/OpClass.h"
#include "timing/raster/DispatchTable.h"

#include <algorithm>

namespace vorion::isasim {

namespace {

/// Keys that are read only where another one is not, or is, 0.
struct Switch {
  std::string_view Keys; ///< all that begin so, but that of By
  std::string_view By;
  bool OffAtZero;
};

// The guards of the clock's units, by the unit.
constexpr Switch Switches[] = {
    {"timing.", "timing.enabled", true},
    {"timing.core.dcache_", "timing.core.dcache_kib", true},
    {"timing.socket.icache_", "timing.socket.icache_kib", true},
    {"timing.core.fpu_lanes", "timing.core.fpu", true},
    {"timing.core.fp_", "timing.core.fpu", true},
    {"timing.core.fp_hold", "timing.core.fp_in_flight", true},
    {"timing.l2.queue", "timing.l2.crossbar", true},
    {"timing.l2.", "timing.l2.fixed_cycles", false},
    {"timing.llc.", "timing.l2.fixed_cycles", false},
    {"timing.dram.", "timing.l2.fixed_cycles", false},
    {"timing.llc.", "timing.llc.constant_cycles", false},
    {"timing.dram.", "timing.llc.constant_cycles", false},
};

using Numbers = std::vector<uint64_t>;

/// Cycles of dispatch for boxes of all sizes.
Numbers dispatchCycles(RasterTiming P) {
  DispatchTable Table(P);
  constexpr unsigned Most = 64;
  Numbers All;
  for (unsigned Width = 1; Width <= Most; ++Width)
    for (unsigned Height = 1; Height <= Most; Height += 3)
      All.push_back(Table.cycles(Width, Height));
  return All;
}

Numbers inRenders(const Config &C) { return dispatchCycles(C.Timing.Raster); }

Numbers inBackwardCommands(const Config &C) {
  RasterTiming InPairs = C.Timing.Raster;
  InPairs.Lanes = std::max(1U, InPairs.Lanes / 2);
  return dispatchCycles(InPairs);
}

Numbers inCores(const Config &C) {
  Numbers All;
  for (unsigned P = 0; P != unsigned(Port::Count); ++P)
    All.push_back(passes(static_cast<Port>(P), C.Timing.Core, C.LanesPerWarp));
  return All;
}

/// A part of the model by which keys act and no other way.
struct View {
  std::vector<std::string> Keys;
  Numbers (*Of)(const Config &);
  std::string_view Name; ///< as KeyLimit::Of
};

const std::vector<View> &views() {
  static const std::vector<View> All = {
      {{"timing.raster.lanes", "timing.raster.banks"}, inRenders, "renders"},
      {{"timing.raster.lanes", "timing.raster.banks"},
       inBackwardCommands,
       "backward commands"},
      {{"timing.core.alu_lanes", "timing.core.fpu_lanes",
        "timing.core.sfu_lanes", "timing.core.lsu_lanes", "lanes_per_warp"},
       inCores,
       ""}};
  return All;
}

Config with(const Config &C, const Key &K, uint64_t Value) {
  Config Changed = C;
  K.Set(Changed, std::clamp(Value, K.Low, K.High));
  return Changed;
}

/// The key of \p V that would let a change of \p K from \p Old be seen, if it
/// were twice what it is.
const Key *limiterIn(const View &V, const Key &K, uint64_t Old,
                     const Config &After) {
  for (const std::string &Path : V.Keys) {
    const Key *By = findKey(Path);
    if (By == &K)
      continue;
    // Beyond what the key may be: the model computes it all the same.
    Config More = After;
    By->Set(More, 2 * By->Get(After));
    if (V.Of(More) != V.Of(with(More, K, Old)))
      return By;
  }
  return nullptr;
}

} // namespace

std::vector<KeyLimit> limitsOf(const Key &K, const Config &Before,
                               const Config &After) {
  for (const Switch &S : Switches) {
    const Key *By = findKey(std::string(S.By));
    if (K.Path.starts_with(S.Keys) && &K != By &&
        (By->Get(After) == 0) == S.OffAtZero)
      return {{By, ""}};
  }
  std::vector<KeyLimit> Found;
  for (const View &V : views()) {
    if (std::ranges::find(V.Keys, K.Path) == V.Keys.end())
      continue;
    const uint64_t Old = K.Get(Before);
    if (V.Of(After) != V.Of(with(After, K, Old)))
      continue;
    if (const Key *By = limiterIn(V, K, Old, After))
      Found.push_back({By, V.Name});
  }
  return Found;
}

} // namespace vorion::isasim
