/// Errors of command lines.
#pragma once

#include "vorion/support/Expected.h"

#include <string>
#include <utility>

namespace vorion::splat {

/// What is wrong with options; the tool ends as its help says of usage.
inline Error usage(std::string What) {
  return {"", std::move(What), ExitCode::Usage};
}

} // namespace vorion::splat
