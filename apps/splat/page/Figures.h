/// Pages and their figures, as files.
#pragma once

#include "vorion/support/Expected.h"

#include <string>
#include <string_view>

namespace vorion::splat {

/// document.js.
std::string_view documentScript();

/// Where a page goes; empty for nowhere.
struct PageFiles {
  std::string Html;    ///< the file
  std::string Figures; ///< folder of its charts and tables

  bool any() const { return !Html.empty() || !Figures.empty(); }
};

/// Writes the charts and tables of \p Page, the file of a page, into \p Folder:
/// as SVG, PNG and CSV, and tables as LaTeX. This is done by splat-figures, the
/// program beside this one.
Expected<Success> writeFigures(const std::string &Page,
                               const std::string &Folder);

/// Writes \p Page, a page's text, and its figures.
Expected<Success> writePage(const PageFiles &To, const std::string &Page);

} // namespace vorion::splat
