/// The machine and clock of a time, as text that accompanies every printed or
/// stored time: "prototype, 530 MHz, clock version 3".
#pragma once

#include "device/TimeReport.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vorion::splat {

/// The machine and clock of \p R.
std::string clockedMachine(const TimeReport &R);

/// The same for a time report in JSON. In older reports the machine is
/// "unknown". Throws an exception of the library if it has no clock.
std::string clockedMachine(const nlohmann::ordered_json &Report);

/// The key of this text in JSON.
inline constexpr const char *ClockedMachineKey = "clocked_machine";

} // namespace vorion::splat
