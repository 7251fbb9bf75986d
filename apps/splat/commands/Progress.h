/// What a person sees while a device works.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

namespace vorion::splat {

/// From now on nothing is said of progress.
void hideProgress();
bool isProgressHidden();

/// A line on a terminal that says what is going on; nothing elsewhere.
std::function<void(std::string_view)> progress();

/// The same of a run that draws \p Views, with a bar of those that are drawn
/// and the time that is left; elsewhere a line now and then. It is told the
/// stages of each view.
std::function<void(std::string_view)> progressOf(std::size_t Views);

/// Clears that line.
void endProgress();

} // namespace vorion::splat
