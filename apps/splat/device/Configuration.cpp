#include "Configuration.h"

#include "Hash.h"
#include "vorion/support/File.h"

#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

/// What the environment's VORION_CONFIG names, a file or the text itself
/// (runtime/include/vorion/runtime.h).
static Expected<Json> namedConfiguration() {
  const char *Value = std::getenv("VORION_CONFIG");
  if (!Value || !*Value)
    return Json("default prototype");
  if (Value[std::strspn(Value, " \t\r\n")] == '{')
    return Json{{"fnv1a64", fnv1a64(Value)}, {"text", Value}};
  const auto Bytes = readFile(Value);
  if (!Bytes)
    return Bytes.error();
  const std::string Text(reinterpret_cast<const char *>(Bytes->data()),
                         Bytes->size());
  return Json{{"file", Value}, {"fnv1a64", fnv1a64(Text)}, {"text", Text}};
}

Expected<Json> machineConfiguration() {
  Expected<Json> Base = namedConfiguration();
  const char *Set = std::getenv("VORION_SET");
  if (!Base || !Set || !*Set)
    return Base;
  return Json{{"base", *Base}, {"set", Set}};
}

} // namespace vorion::splat
