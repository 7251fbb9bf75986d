#include "device/Configuration.h"

#include "io/Hash.h"
#include "vorion/support/File.h"

#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

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
    return Bytes.error();
  const std::string Text(reinterpret_cast<const char *>(Bytes->data()),
                         Bytes->size());
  return Json{{"file", Value}, {"fnv1a64", fnv1a64(Text)}, {"text", Text}};
}

Expected<Json> machineConfiguration(const DeviceOptions &O) {
  Expected<Json> Base = namedConfiguration(O.text("VORION_CONFIG"));
  const std::string Set = O.text("VORION_SET");
  if (!Base || Set.empty())
    return Base;
  return Json{{"base", *Base}, {"set", Set}};
}

} // namespace vorion::splat
