/// What a person sees while a device works.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

namespace vorion::splat {

/// From now on nothing is said of progress.
void hideProgress();
bool isProgressHidden();

/// A status line (StatusLine.h) that says what is going on.
std::function<void(std::string_view)> progress();

/// The same of a run that draws \p Views, with a bar of those that are drawn
/// and the time that is left; elsewhere a line now and then. It is told the
/// stages of each view.
std::function<void(std::string_view)> progressOf(std::size_t Views);

} // namespace vorion::splat
