#include "vorion/isasim/Variables.h"

#include "machine/MachineTexts.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Environment.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>
#include <unistd.h>
#include <utility>

using namespace vorion;

namespace {
struct ReadVariable {
  const char *Name;
  std::string_view Readers;
  const char *Option; ///< of vorion-sim, which does the same
};
} // namespace

static constexpr std::array All{
#define VORION_VARIABLE(NAME, EFFECT, READERS, OPTION, WATCHES)                \
  ReadVariable{NAME, READERS, OPTION},
#include "vorion/isasim/Variables.def"
};

static constexpr auto Names = [] {
  std::array<std::string_view, All.size()> Of;
  std::ranges::transform(All, Of.begin(), &ReadVariable::Name);
  return Of;
}();

void isasim::warnOfMisspeltVariables(std::string_view Tool) {
  for (char **Each = environ; *Each; ++Each) {
    const std::string_view Entry = *Each;
    const std::string Name(Entry.substr(0, Entry.find('=')));
    if (!Name.starts_with("VORION_") || !environmentVariable(Name.c_str()) ||
        std::ranges::find(Names, Name) != Names.end())
      continue;
    if (const std::string Meant = didYouMean(Name, Names); !Meant.empty())
      printDiagnostic(Tool, "warning", Name,
                      "no program reads this variable" + Meant);
  }
}

void isasim::warnOfUnreadVariables(std::string_view Tool) {
  for (const ReadVariable &V : All)
    if (V.Readers == "OpenCL programs" && environmentVariable(V.Name))
      printDiagnostic(
          Tool, "warning", V.Name,
          fmt::format("OpenCL programs alone read this variable{}",
                      V.Option ? fmt::format(", expected {}", V.Option) : ""));
}

Error isasim::inVariable(std::string_view Name, Error E) {
  if (E.Where.empty() || E.Where == GivenText)
    E.Where = Name;
  else
    E.Where = fmt::format("{}: {}", Name, E.Where);
  return E;
}

Error isasim::ofMachine(Error E, bool HasConfig, bool HasSet) {
  if (E.Where != GivenText || !(HasConfig || HasSet))
    return E;
  return inVariable(HasConfig && HasSet ? "VORION_CONFIG with VORION_SET"
                    : HasConfig         ? "VORION_CONFIG"
                                        : "VORION_SET",
                    std::move(E));
}
