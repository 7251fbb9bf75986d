#include "machine/MachineTexts.h"
#include "vorion/isasim/Config.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <nlohmann/json.hpp>

namespace vorion::isasim {

static Config machineOf(std::string_view Name) {
  Config C;
  [[maybe_unused]] const Expected<Success> Ok =
      changeConfig(C, machineText(Name), std::string(Name));
  assert(Ok && "a test holds them good");
  return C;
}

/// Those of machineNames(), in its order.
static const std::vector<Config> &machines() {
  static const std::vector<Config> All = [] {
    std::vector<Config> Made;
    for (const std::string_view Name : machineNames())
      Made.push_back(machineOf(Name));
    return Made;
  }();
  return All;
}

const Config &namedMachine(size_t Number) { return machines()[Number]; }

const Config &defaultMachine() {
  // On its own, so that not every run reads the others.
  static const Config Default = machineOf(machineNames().front());
  return Default;
}

MachineName nameOf(const Config &C) {
  MachineName Nearest;
  size_t Fewest = std::numeric_limits<size_t>::max();
  for (size_t N = 0; N != machines().size(); ++N) {
    std::vector<std::string> Changes = changesOf(machines()[N], C);
    if (Changes.size() < Fewest) {
      Fewest = Changes.size();
      Nearest = {std::string(machineNames()[N]), std::move(Changes)};
    }
  }
  if (Fewest)
    Nearest.Name += " with changes";
  return Nearest;
}

Expected<MachineSource> findMachine(const std::string &Text) {
  const size_t First = Text.find_first_not_of(" \t\r\n");
  if (First != std::string::npos && Text[First] == '{')
    return MachineSource{Text, std::string(GivenText)};
  if (Text.find_first_of("./") == std::string::npos)
    return MachineSource{jsonText(nlohmann::json{{"machine", Text}}),
                         std::string(GivenText)};
  const auto Bytes = readFile(Text);
  if (!Bytes)
    return Bytes.error();
  return MachineSource{
      {reinterpret_cast<const char *>(Bytes->data()), Bytes->size()}, Text};
}

} // namespace vorion::isasim
