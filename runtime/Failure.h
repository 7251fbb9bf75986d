/// How the parts of the runtime say that a call cannot be done.
#pragma once

#include "vorion/runtime.h"
#include "vorion/support/Expected.h"

#include <string>

namespace vorion::runtime {

/// A status and its text; the default is success. In a condition: did it fail?
struct Failure {
  vx_status Status = VX_OK;
  std::string Text;
  explicit operator bool() const { return Status != VX_OK; }
};

inline Failure badArgument(std::string Text) {
  return {VX_ERROR_ARGUMENT, std::move(Text)};
}

/// \p E as "where: what".
inline Failure failure(vx_status Status, const Error &E) {
  return {Status, E.Where.empty() ? E.What : E.Where + ": " + E.What};
}

/// The same of what a machine is opened with.
inline Failure cannotOpen(const Error &E) {
  return failure(E.Code == ExitCode::LimitReached ? VX_ERROR_MEMORY
                 : E.Code == ExitCode::InputFile  ? VX_ERROR_FILE
                                                  : VX_ERROR_CONFIG,
                 E);
}

} // namespace vorion::runtime
