#include "doctor/Variables.h"

#include "vorion/support/Suggest.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace vorion::splat {

static constexpr std::array Variables{
    KnownVariable{"VORION_ROOT", "says where the tools are", false},
    KnownVariable{"VORION_CONFIG",
                  "chooses the machine, by its name or by a JSON file", false},
    KnownVariable{"VORION_SET", "changes single values of the machine", false},
    KnownVariable{"VORION_TIME", "turns the clock on", false},
    KnownVariable{"VORION_CAPTURE",
                  "keeps a program's kernel launches in a folder", true},
    KnownVariable{"VORION_COMPILE_ALL",
                  "compiles every kernel for groups of any size", false},
    KnownVariable{"VORION_REMARKS", "says what the compiler tells of kernels",
                  false},
    KnownVariable{"VORION_KERNEL_FOLDER",
                  "is the folder of compiled kernels, in place of the cache's",
                  false},
    KnownVariable{"VORION_JOBS", "says how many jobs scripts/setup.sh starts",
                  false},
    KnownVariable{"VORION_SOURCES",
                  "says where the build finds the sources of LLVM and PoCL",
                  false},
#define VORION_SESSION_OPTION(Member, Option, Variable, Value, Default, Help)  \
  KnownVariable{Variable, "watches runs: " Help, true},
#include "vorion/isasim/SessionOptions.def"
#undef VORION_SESSION_OPTION
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
    if (!Name.starts_with("VORION_"))
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
