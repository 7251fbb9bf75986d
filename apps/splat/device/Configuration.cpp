#include "device/Configuration.h"

#include "io/Hash.h"
#include "vorion/support/File.h"

#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

/// \p E of a file that the variable \p Name names, as the platform says it.
static Error ofVariable(std::string_view Name, const Error &E) {
  return {fmt::format("{}: {}", Name, E.Where), E.What, E.Code};
}

static Expected<Json> namedConfiguration(const std::string &Value) {
  if (Value.empty())
    return Json("default");
  // As the platform tells names from files.
  if (Value.find_first_of("./{") == std::string::npos)
    return Json(Value);
  const std::size_t First = Value.find_first_not_of(" \t\r\n");
  if (First != std::string::npos && Value[First] == '{')
    return Json{{"fnv1a64", fnv1a64(Value)}, {"text", Value}};
  const auto Bytes = readFile(Value);
  if (!Bytes)
    return ofVariable("VORION_CONFIG", Bytes.error());
  const std::string Text(reinterpret_cast<const char *>(Bytes->data()),
                         Bytes->size());
  return Json{{"file", Value}, {"fnv1a64", fnv1a64(Text)}, {"text", Text}};
}

/// \p Files, as VORION_PLUGINS has them: their names without folders, and what
/// is in them.
static Expected<Json> pluginsOf(const std::string &Files) {
  Json All = Json::array();
  std::istringstream Paths(Files);
  for (std::string Path; std::getline(Paths, Path, ',');) {
    const auto Bytes = readFile(Path);
    if (!Bytes)
      return ofVariable("VORION_PLUGINS", Bytes.error());
    All.push_back(
        {{"name", std::filesystem::path(Path).filename().string()},
         {"fnv1a64", fnv1a64({reinterpret_cast<const char *>(Bytes->data()),
                              Bytes->size()})}});
  }
  return All;
}

Expected<Json> machineConfiguration(const DeviceOptions &O) {
  Expected<Json> Base = namedConfiguration(O.text("VORION_CONFIG"));
  const std::string Set = O.text("VORION_SET");
  const std::string Plugins = O.text("VORION_PLUGINS");
  if (!Base || (Set.empty() && Plugins.empty()))
    return Base;
  Json All{{"base", *Base}};
  if (!Set.empty())
    All["set"] = Set;
  if (!Plugins.empty()) {
    auto Loaded = pluginsOf(Plugins);
    if (!Loaded)
      return Loaded.error();
    All["plugins"] = std::move(*Loaded);
  }
  return All;
}

} // namespace vorion::splat
