#include "device/DeviceOptions.h"

#include "vorion/support/Environment.h"

namespace vorion::splat {

std::string DeviceOptions::text(const std::string &Variable) const {
  if (const auto Found = CommandLine.find(Variable); Found != CommandLine.end())
    return Found->second;
  const char *Value = environmentVariable(Variable.c_str());
  return Value ? Value : "";
}

std::string DeviceOptions::giver(const std::string &Variable) const {
  const auto Found = Givers.find(Variable);
  return Found == Givers.end() ? "" : Found->second;
}

std::string DeviceOptions::inOurWords(const std::string &Problem) const {
  for (const auto &[Variable, Option] : Givers)
    if (!Option.empty() && Problem.starts_with(Variable + ": "))
      return Option + Problem.substr(Variable.size());
  return Problem;
}

ClockText::Runs DeviceOptions::clockRuns() const {
  const auto Clock = ClockText::parse(text("VORION_TIME"));
  return Clock ? Clock->When : ClockText::Runs::AsConfigured;
}

} // namespace vorion::splat
