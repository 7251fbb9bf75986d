/// Errors of command lines.
#pragma once

#include "vorion/support/Expected.h"

#include <string>
#include <utility>

namespace vorion::splat {

/// An error of the command line, with the exit code for usage errors.
inline Error usage(std::string What) {
  return {"", std::move(What), ExitCode::Usage};
}

} // namespace vorion::splat
