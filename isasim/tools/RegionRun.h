/// Runs the launches of a saved region, one behind the other.
#pragma once

#include "region/RegionFile.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Session.h"

#include <functional>
#include <string_view>

namespace vorion::isasim {

/// Brings \p M into the state that \p R begins with and runs its launches, as
/// far as they end well; \p Watch, which is attached, sees each. The result is
/// of the last. \p ChoosesClock: launches are timed or warm up as the file
/// says, else as \p Watch does. \p Print receives a table of what each took.
/// Errors: a file \p Where that does not fit itself, and a launch that changes
/// memory otherwise than it did when it was saved.
Expected<RunResult>
runRegion(const SavedRegion &R, Machine &M, Session &Watch, bool ChoosesClock,
          const std::string &Where,
          const std::function<void(std::string_view)> &Print);

} // namespace vorion::isasim
