/// `splat doctor`.
#pragma once

#include "commands/Commands.h"

namespace vorion::splat {

/// Looks at what programs need to run here; a fault is an Error (GuestFailed),
/// given after all is said.
Runner addDoctor(CLI::App &App);

} // namespace vorion::splat
