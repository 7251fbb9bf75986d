/// Progress messages on the terminal.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace vorion::splat {

/// Disables progress messages.
void hideProgress();
bool isProgressHidden();

/// A status line (StatusLine.h) with the current activity.
std::function<void(std::string_view)> progress();

/// The same for a run that renders \p Views, with a progress bar and the
/// remaining time; without a terminal, an occasional line. It must be called
/// with each stage of each view.
std::function<void(std::string_view)> progressOf(std::size_t Views);

/// The same for a step \p What of several parts. It must be called with the
/// number of finished parts and the number of all parts, or 0 if that is
/// unknown.
std::function<void(std::size_t, std::size_t)>
progressOfParts(const std::string &What);

} // namespace vorion::splat
