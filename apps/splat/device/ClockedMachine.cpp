#include "device/ClockedMachine.h"

#include "vorion/support/ClockText.h"

#include <nlohmann/json.hpp>

namespace vorion::splat {

std::string clockedMachine(const TimeReport &R) {
  return vorion::clockedMachine(R.Machine, R.ClockMhz, R.ClockVersion);
}

std::string clockedMachine(const nlohmann::ordered_json &Report) {
  // Reports had no version at first.
  return vorion::clockedMachine(Report.value("machine", std::string("unknown")),
                                Report.at("clock_mhz"),
                                Report.value("clock_version", 1U));
}

} // namespace vorion::splat
