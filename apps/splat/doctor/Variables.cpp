#include "doctor/Variables.h"

#include "vorion/support/Suggest.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace vorion::splat {

static constexpr std::array Variables{
#define VORION_VARIABLE(NAME, EFFECT, READERS, OPTION, WATCHES)                \
  KnownVariable{NAME, EFFECT, WATCHES},
#include "vorion/isasim/Variables.def"
};

std::span<const KnownVariable> knownVariables() { return Variables; }

Diagnoses examineVariables(std::span<const std::string> Environment) {
  std::vector<std::string> Names;
  Names.reserve(Variables.size());
  for (const KnownVariable &K : Variables)
    Names.emplace_back(K.Name);
  Diagnoses Found;
  for (const std::string_view Entry : Environment) {
    const std::string Name(Entry.substr(0, Entry.find('=')));
    // An empty one counts as unset.
    if (!Name.starts_with("VORION_") || Name.size() + 1 == Entry.size())
      continue;
    const auto *Known = std::ranges::find_if(
        Variables, [&](const KnownVariable &K) { return Name == K.Name; });
    if (Known != Variables.end()) {
      Found.push_back({DiagnosisState::Note, "variable",
                       fmt::format("{} {}", Entry, Known->Effect), ""});
      continue;
    }
    const std::string_view Near = closestTo(Name, Names);
    Found.push_back(
        {DiagnosisState::Fault, "variable",
         fmt::format("{} is set, but no program of Vorion reads it", Name),
         Near.empty()
             ? fmt::format("unset {}", Name)
             : fmt::format("unset {}, or did you mean {}?", Name, Near)});
  }
  return Found;
}

} // namespace vorion::splat
