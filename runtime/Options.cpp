#include "Options.h"

#include "vorion/isasim/Variables.h"
#include "vorion/support/ClockText.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Environment.h"

#include <mutex>
#include <set>
#include <utility>

using namespace vorion;
using namespace vorion::runtime;

namespace {

constexpr std::pair<std::string DeviceOptions::*, const char *>
    MachineOptions[] = {{&DeviceOptions::Config, "VORION_CONFIG"},
                        {&DeviceOptions::Set, "VORION_SET"},
                        {&DeviceOptions::Time, "VORION_TIME"}};

void readVariable(const char *Name, std::string &Text) {
  if (const char *Value = environmentVariable(Name))
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
    return cannotOpen(isasim::inVariable("VORION_CONFIG", Found.error()));
  auto Parsed = isasim::parseConfig(Found->Json, Found->Where);
  if (!Parsed)
    return cannotOpen(isasim::inVariable("VORION_CONFIG", Parsed.error()));
  C = *Parsed;
  return {};
}

bool DeviceOptions::onlyProfiled() const {
  const auto Clock = ClockText::parse(Time);
  return Clock && Clock->When == ClockText::Runs::Profiled;
}

Failure DeviceOptions::readTime(isasim::Config &C) const {
  const auto Clock = ClockText::parse(Time);
  if (!Clock)
    return cannotOpen(isasim::inVariable("VORION_TIME", Clock.error()));
  if (onlyProfiled() && !Watch.Region.empty())
    return {VX_ERROR_CONFIG,
            "VORION_REGION with VORION_TIME 'profiled', expected only one of "
            "them to select the timed launches"};
  if (Clock->When != ClockText::Runs::AsConfigured)
    C.Timing.Enabled = Clock->When != ClockText::Runs::Never;
  C.Timing.Enabled |= Watch.needClock();
  if (Clock->Mhz)
    C.Timing.ClockMhz = *Clock->Mhz;
  return {};
}

Error DeviceOptions::ofMachine(Error E) const {
  return isasim::ofMachine(std::move(E), !Config.empty(), !Set.empty());
}

/// A process may open a device several times; each note is printed once.
/// Without a clock, at the user's request, no setting changes a cycle, and no
/// note is printed.
void DeviceOptions::noteIdle(const isasim::Config &Before,
                             const isasim::Config &After) const {
  if (const auto Clock = ClockText::parse(Time);
      Clock && Clock->When == ClockText::Runs::Never)
    return;
  static std::mutex Mutex;
  static std::set<std::string> Said;
  const std::lock_guard Held(Mutex);
  for (const std::string &Idle : isasim::idleSettings(Before, After, Set))
    if (Said.insert(Idle).second)
      printDiagnostic("vorion", "note", "VORION_SET", Idle);
}

Failure DeviceOptions::machine(isasim::Config &C) const {
  if (Failure Failed = readConfig(C))
    return Failed;
  const isasim::Config Before = C;
  if (!Set.empty())
    if (const auto Done = isasim::setValues(C, Set); !Done)
      return cannotOpen(isasim::inVariable("VORION_SET", Done.error()));
  if (Failure Failed = readTime(C))
    return Failed;
  noteIdle(Before, C);
  return {};
}
