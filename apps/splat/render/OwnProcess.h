/// Work in a process of its own.
#pragma once

#include "vorion/support/Expected.h"

#include <functional>
#include <string>

namespace vorion::splat {

/// What \p Work gives in a child of this process, which ends with it: it finds
/// the machine as new as every process does. This process must have no threads
/// and no device yet.
Expected<std::string>
inOwnProcess(const std::function<Expected<std::string>()> &Work);

} // namespace vorion::splat
