#include "device/DeviceOptions.h"

#include <cstdlib>

namespace vorion::splat {

std::string DeviceOptions::text(const std::string &Variable) const {
  if (const auto Found = CommandLine.find(Variable); Found != CommandLine.end())
    return Found->second;
  const char *Value = std::getenv(Variable.c_str());
  return Value ? Value : "";
}

} // namespace vorion::splat
