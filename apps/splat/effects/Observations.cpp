// What watches a picture being made, and changes nothing of it. The platform
// reads the variables when it opens its devices (docs/debugging.md).

#include "effects/Registry.h"

#include <initializer_list>

namespace vorion::splat {

namespace {

/// On if one of \p Variables is set to more than nothing, by an option or in
/// the environment.
Finding asked(const EffectInputs &In,
              std::initializer_list<const char *> Variables) {
  std::string Names;
  for (const char *Name : Variables) {
    const std::string Text = In.Machine.text(Name);
    if (!Text.empty())
      return {true, In.Machine.giver(Name).empty()
                        ? std::string(Name) + "=" + Text
                        : In.Machine.giver(Name)};
    Names += (Names.empty() ? "" : ", ") + std::string(Name);
  }
  return {false, "not requested (" + Names + ")"};
}

Finding detectClock(const EffectInputs &In) {
  Finding F = In.Machine.clockRuns() == ClockText::Runs::Never
                  ? asked(In, {"VORION_REGION"})
                  : asked(In, {"VORION_TIME", "VORION_REGION"});
  if (!F.Needed)
    F.Figure = "not requested (--time, --clock)";
  return F;
}

/// Whether an option of splat asked for what \p Variable turns on, into a file
/// that nobody else sees: no report shall name that.
bool askedByOption(const EffectInputs &In, const char *Variable) {
  return In.Machine.commandLine().contains(Variable);
}

Finding detectNumerics(const EffectInputs &In) {
  if (askedByOption(In, "VORION_NUMERICS"))
    return {true, "--numerics"};
  return asked(In, {"VORION_NUMERICS"});
}

Finding detectCheckers(const EffectInputs &In) {
  return asked(In, {"VORION_CHECK"});
}

Finding detectTraces(const EffectInputs &In) {
  if (askedByOption(In, "VORION_TILES"))
    return {true, "--heat-map or --html"};
  return asked(In, {"VORION_TRACE", "VORION_TIMELINE", "VORION_TILES",
                    "VORION_DRAM_TRACE", "VORION_PIPELINE", "VORION_PROFILE",
                    "VORION_STATS"});
}

Finding detectDebugger(const EffectInputs &In) {
  return asked(In, {"VORION_GDB"});
}

Finding detectPairs(const EffectInputs &In) {
  return In.KeepPairs ? Finding{true, "--pairs"}
                      : Finding{false, "not requested (--pairs)"};
}

} // namespace

namespace effects {

const Effect Clock{
    .Name = "clock",
    .Kind = EffectKind::Observation,
    .What = "the timing model: cores, caches, DRAM, rasterizers, pixel units",
    .Detect = detectClock};

const Effect Numerics{
    .Name = "numerics",
    .Kind = EffectKind::Observation,
    .What = "a shadow double for every fp32 value of cores and rasterizers",
    .Detect = detectNumerics};

const Effect Checkers{.Name = "checkers",
                      .Kind = EffectKind::Observation,
                      .What = "errors of the kernels, reported as they happen",
                      .Detect = detectCheckers};

const Effect Traces{.Name = "traces",
                    .Kind = EffectKind::Observation,
                    .What = "trace, timeline, profile and counters in files",
                    .Detect = detectTraces};

const Effect Debugger{.Name = "debugger",
                      .Kind = EffectKind::Observation,
                      .What = "a port for gdb",
                      .Detect = detectDebugger};

const Effect SortedPairs{.Name = "sorted-pairs",
                         .Kind = EffectKind::Observation,
                         .What = "the sorted pairs, read back",
                         .Detect = detectPairs};

} // namespace effects
} // namespace vorion::splat
