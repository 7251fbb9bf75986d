#include "render/Explain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

std::string_view heading(EffectKind K) {
  switch (K) {
  case EffectKind::Scene:
    return "scene effects: same bits with and without where not needed";
  case EffectKind::Machine:
    return "machine effects: time, and rounding within their bounds";
  case EffectKind::Observation:
    return "observations: by option only";
  }
  return {};
}

/// What is said of an effect's code; "on" where it has none of its own.
std::string_view state(const EffectDecision &D) {
  if (!D.Done)
    return D.Code == EffectCode::Flagged ? "off, flagged" : "off";
  if (D.Code == EffectCode::Flagged)
    return "on, flagged";
  return D.Detected.Needed ? "on" : "on, unneeded";
}

} // namespace

std::string explain(const RenderPlan &Plan) {
  std::string Text;
  for (const ProgramSpec &P : Plan.Programs)
    Text +=
        fmt::format("program {}: {}{}{}\n", P.name(), P.File,
                    P.Defines.empty() ? "" : "; ", fmt::join(P.Defines, " "));
  const EffectKind *Last = nullptr;
  for (const EffectDecision &D : Plan.Effects.decisions()) {
    if (!Last || *Last != D.Subject->Kind)
      Text += fmt::format("{}\n", heading(D.Subject->Kind));
    Last = &D.Subject->Kind;
    Text += fmt::format("  {:<17}{:<13} {} ({})\n", D.Subject->Name, state(D),
                        D.Detected.Figure, D.Subject->What);
  }
  return Text;
}

Json effectsJson(const EffectPlan &Plan) {
  Json All = Json::array();
  for (const EffectDecision &D : Plan.decisions())
    All.push_back({{"name", D.Subject->Name},
                   {"kind", name(D.Subject->Kind)},
                   {"needed", D.Detected.Needed},
                   {"on", D.Done},
                   {"code", name(D.Code)},
                   {"figure", D.Detected.Figure}});
  return All;
}

} // namespace vorion::splat
