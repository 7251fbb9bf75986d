/// The machine and the clock that a time is of, in words, as they stand beside
/// every time that is printed or kept: "prototype, 530 MHz, clock version 3".
#pragma once

#include "device/TimeReport.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vorion::splat {

/// Of \p R.
std::string clockedMachine(const TimeReport &R);

/// Of a time report as reports have it. Older ones do not name their machine,
/// which is "unknown" then. Throws an exception of the library where it has no
/// clock.
std::string clockedMachine(const nlohmann::ordered_json &Report);

/// What such words are called in JSON.
inline constexpr const char *ClockedMachineKey = "clocked_machine";

} // namespace vorion::splat
