#include "Options.h"

#include "vorion/isasim/Variables.h"

#include <charconv>
#include <cstdlib>
#include <fmt/format.h>
#include <mutex>
#include <utility>

using namespace vorion;
using namespace vorion::runtime;

namespace {

constexpr std::pair<std::string DeviceOptions::*, const char *>
    MachineOptions[] = {{&DeviceOptions::Config, "VORION_CONFIG"},
                        {&DeviceOptions::Set, "VORION_SET"},
                        {&DeviceOptions::Time, "VORION_TIME"}};

void readVariable(const char *Name, std::string &Text) {
  if (const char *Value = std::getenv(Name))
    Text = Value;
}

} // namespace

DeviceOptions DeviceOptions::fromEnvironment() {
  static std::once_flag Warned;
  std::call_once(Warned, [] { isasim::warnOfMisspeltVariables("vorion"); });
  DeviceOptions O;
  for (const auto &[Member, Name] : MachineOptions)
    readVariable(Name, O.*Member);
  for (const isasim::SessionOption &S : isasim::sessionOptions())
    readVariable(S.Variable, O.Watch.*S.Text);
  return O;
}

std::string *DeviceOptions::find(std::string_view Name) {
  for (const auto &[Member, Known] : MachineOptions)
    if (Name == Known)
      return &(this->*Member);
  for (const isasim::SessionOption &S : isasim::sessionOptions())
    if (Name == S.Variable)
      return &(Watch.*S.Text);
  return nullptr;
}

Failure DeviceOptions::readConfig(isasim::Config &C) const {
  if (Config.empty())
    return {};
  const auto Found = isasim::findMachine(Config);
  if (!Found)
    return cannotOpen(Found.error());
  auto Parsed = isasim::parseConfig(Found->Json, Found->Where);
  if (!Parsed)
    return cannotOpen(Parsed.error());
  C = *Parsed;
  return {};
}

Failure DeviceOptions::readTime(isasim::Config &C) const {
  if (onlyProfiled() && !Watch.Region.empty())
    return {VX_ERROR_CONFIG, "VORION_REGION with VORION_TIME 'profiled', "
                             "expected one of them to choose what is timed"};
  C.Timing.Enabled |= !Time.empty() || Watch.needClock();
  if (Time.empty())
    return {};
  if (onlyProfiled() || Time == "on")
    return {};
  const char *End = Time.data() + Time.size();
  const auto [Rest, Wrong] =
      std::from_chars(Time.data(), End, C.Timing.ClockMhz);
  if (Wrong != std::errc() || Rest != End)
    return {VX_ERROR_CONFIG,
            fmt::format("VORION_TIME is '{}', expected 'on', 'profiled' or a "
                        "clock in MHz",
                        Time)};
  return {};
}

Failure DeviceOptions::machine(isasim::Config &C) const {
  if (Failure Failed = readConfig(C))
    return Failed;
  if (!Set.empty())
    if (const auto Done = isasim::setValues(C, Set); !Done)
      return cannotOpen(
          {"", "VORION_SET: " + Done.error().What, Done.error().Code});
  return readTime(C);
}
