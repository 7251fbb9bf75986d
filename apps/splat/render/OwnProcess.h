/// Work in a separate process.
#pragma once

#include "vorion/support/Expected.h"

#include <functional>
#include <string>

namespace vorion::splat {

/// Executes \p Work in a child process and returns its result. The child has a
/// new machine. This process must have no threads and no open device.
Expected<std::string>
inOwnProcess(const std::function<Expected<std::string>()> &Work);

} // namespace vorion::splat
