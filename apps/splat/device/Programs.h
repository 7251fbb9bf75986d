/// The hash of the programs that compute results, as provenance of stored
/// results.
#pragma once

#include "vorion/support/Expected.h"

#include <string>

namespace vorion::splat {

/// A hash of the contents of all programs and libraries of the build or
/// installed tree that a result depends on: this program with its kernels, the
/// compiler, libraries of kernels, the runtime with the simulator, the OpenCL
/// platform. Missing files are skipped: a third-party device needs only this
/// program. An Error if one cannot be read. \p Splat: the program that is
/// hashed in place of this one.
Expected<std::string> hashPrograms(const std::string &Splat = "");

} // namespace vorion::splat
