/// `splat` as a child: each render is a process of its own, as a user's is.
#pragma once

#include "device/DeviceOptions.h"
#include "vorion/support/Expected.h"

#include <functional>
#include <string>
#include <vector>

namespace vorion::splat {

/// Runs this program with \p Arguments; what it says goes to \p LogFile, whose
/// last line is in the error if it fails. \p GiveUp, if set, is asked every few
/// milliseconds whether to end it before its time, which is an error too.
Expected<Success> runSplat(const std::vector<std::string> &Arguments,
                           const DeviceOptions &Machine,
                           const std::string &LogFile,
                           const std::function<bool()> &GiveUp = {});

} // namespace vorion::splat
