#include "device/Program.h"

#include <fmt/format.h>

namespace vorion::splat {

EffectSwitch EffectSwitch::flagged(uint32_t Bit) {
  return EffectSwitch(fmt::format("(effects&{}u)", Bit));
}

void ChoiceDefines::add(const char *Name, bool Value) {
  if (Value)
    Defines.emplace_back(Name);
}

void ChoiceDefines::add(const char *Name, const std::optional<cl_uint> &Value) {
  if (Value)
    Defines.push_back(fmt::format("{}={}", Name, *Value));
}

void ChoiceDefines::add(const char *Name,
                        const std::optional<cl_float> &Value) {
  if (Value)
    Defines.push_back(fmt::format("{}={:#}f", Name, *Value));
}

void ChoiceDefines::add(const char *Name,
                        const std::optional<EffectSwitch> &Value) {
  if (Value)
    Defines.push_back(fmt::format("{}={}", Name, Value->text()));
}

} // namespace vorion::splat
