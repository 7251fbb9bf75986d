#include "effects/EffectPlan.h"

#include "effects/Registry.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <utility>

namespace vorion::splat {

namespace {

using Mode = EffectRequest::Mode;

bool hasFlag(const Effect &E) { return !E.Macro.empty() && !E.ByCamera; }

/// The bit of \p E in the kernels' variable `effects`: its place among those
/// with code.
uint32_t bitOf(const Effect &E) {
  uint32_t Bit = 1;
  for (const Effect *Other : effects::all()) {
    if (Other == &E)
      break;
    if (hasFlag(*Other))
      Bit <<= 1;
  }
  return Bit;
}

/// Whether --effects may name it: an option decides the others.
bool byData(const Effect &E) {
  return E.Kind == EffectKind::Scene && E.Neutral;
}

bool wanted(const EffectRequest &R, const Effect &E, const Finding &Found) {
  const bool Listed = std::ranges::find(R.List, &E) != R.List.end();
  if (E.ByCamera)
    return Found.Needed;
  const bool Wanted =
      R.Selection == Mode::List && byData(E) ? Listed : Found.Needed;
  return Wanted != (R.Toggled == &E);
}

EffectCode codeOf(const EffectRequest &R, const Effect &E, bool Wanted) {
  if (E.Macro.empty())
    return EffectCode::Absent;
  if (E.ByCamera)
    return Wanted ? EffectCode::Compiled : EffectCode::Absent;
  if (R.Selection == Mode::Flags)
    return EffectCode::Flagged;
  if (Wanted)
    return EffectCode::Compiled;
  if (R.Selection != Mode::All || R.Toggled == &E)
    return EffectCode::Absent;
  return E.Neutral ? EffectCode::Compiled : EffectCode::Flagged;
}

} // namespace

std::string_view name(EffectCode C) {
  switch (C) {
  case EffectCode::Absent:
    return "absent";
  case EffectCode::Compiled:
    return "compiled";
  case EffectCode::Flagged:
    return "flagged";
  }
  return {};
}

std::string_view name(Mode M) {
  switch (M) {
  case Mode::Auto:
    return "auto";
  case Mode::All:
    return "all";
  case Mode::Flags:
    return "flags";
  case Mode::List:
    return "list";
  }
  return {};
}

std::vector<std::string> effectChoices() {
  std::vector<std::string> Known;
  for (const Mode M : {Mode::Auto, Mode::All, Mode::Flags})
    Known.emplace_back(name(M));
  for (const Effect *E : effects::all())
    if (byData(*E))
      Known.emplace_back(E->Name);
  return Known;
}

Expected<EffectRequest> parseEffectRequest(const std::string &Text) {
  EffectRequest R;
  for (const Mode M : {Mode::Auto, Mode::All, Mode::Flags})
    if (Text == name(M)) {
      R.Selection = M;
      return R;
    }
  R.Selection = Mode::List;
  std::string_view Rest = Text;
  for (;;) {
    const std::size_t Comma = Rest.find(',');
    const std::string_view Name = Rest.substr(0, Comma);
    const Effect *E = effects::find(Name);
    if (!E || !byData(*E)) {
      const std::vector<std::string> Known = effectChoices();
      return Error{
          "",
          E ? fmt::format("--effects {}: {} is decided by its own option "
                          "(--explain names it), expected {}",
                          Text, Name, fmt::join(Known, ", "))
            : fmt::format("--effects {}: no effect is called \"{}\", expected "
                          "{}{}",
                          Text, Name, fmt::join(Known, ", "),
                          didYouMean(Name, Known)),
          ExitCode::Usage};
    }
    R.List.push_back(E);
    if (Comma == std::string_view::npos)
      return R;
    Rest.remove_prefix(Comma + 1);
  }
}

EffectPlan::EffectPlan(const EffectRequest &R, const EffectInputs &In) {
  std::vector<const Effect *> Enclosing;
  for (const Effect *E : effects::all()) {
    EffectDecision D;
    D.Subject = E;
    D.Detected = E->detect(In);
    const bool Wanted = D.Detected.Applies &&
                        (wanted(R, *E, D.Detected) ||
                         std::ranges::find(Enclosing, E) != Enclosing.end());
    D.Code = D.Detected.Applies || R.Selection == Mode::Flags
                 ? codeOf(R, *E, Wanted)
                 : EffectCode::Absent;
    D.Done = D.Code == EffectCode::Compiled || Wanted;
    if (D.Done && E->Within)
      Enclosing.push_back(E->Within);
    Decisions.push_back(std::move(D));
  }
}

EffectPlan EffectPlan::forAnyScene(int ShDegree, const RenderOptions &O,
                                   const ViewFacts &F) {
  RenderOptions Limited = O;
  Limited.ShLimit = ShDegree;
  EffectRequest R;
  R.Selection = Mode::List;
  std::ranges::copy_if(effects::all(), std::back_inserter(R.List),
                       [](const Effect *E) { return byData(*E); });
  const Scene None = Scene::sized(0, MaxShDegree);
  return {R, {None, Limited, F, false}};
}

const EffectDecision &EffectPlan::of(const Effect &E) const {
  return *std::ranges::find(Decisions, &E, &EffectDecision::Subject);
}

std::optional<EffectSwitch> EffectPlan::choiceOf(std::string_view Macro) const {
  const auto D = std::ranges::find(
      Decisions, Macro, [](const auto &Each) { return Each.Subject->Macro; });
  assert(D != Decisions.end() && "kernels declare effects of the registry");
  if (D->Subject->ByCamera && !D->Done)
    return std::nullopt;
  switch (D->Code) {
  case EffectCode::Absent:
    return EffectSwitch::absent();
  case EffectCode::Compiled:
    return EffectSwitch::compiled();
  case EffectCode::Flagged:
    return EffectSwitch::flagged(bitOf(*D->Subject));
  }
  return std::nullopt;
}

uint32_t EffectPlan::flags() const {
  uint32_t Flags = 0;
  for (const EffectDecision &D : Decisions)
    if (D.Done && hasFlag(*D.Subject))
      Flags |= bitOf(*D.Subject);
  return Flags;
}

std::vector<const Effect *> EffectPlan::missing() const {
  std::vector<const Effect *> Missing;
  for (const EffectDecision &D : Decisions)
    if (D.Detected.Needed && !D.Done)
      Missing.push_back(D.Subject);
  return Missing;
}

} // namespace vorion::splat
