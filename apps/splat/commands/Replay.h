/// Runs again what made a report, and says whether it is the same.
#pragma once

#include "commands/Commands.h"

namespace vorion::splat {

Runner addReplay(CLI::App &App);

} // namespace vorion::splat
