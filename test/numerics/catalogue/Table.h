/// The catalogue as a table for docs/tables/hard-cases.md.
#pragma once

#include "Rows.h"

#include <string>

namespace vorion::test {

/// Markdown: a line a case, from the rows of a check.
std::string tableOf(const Rows &R);

} // namespace vorion::test
