/// Which programs make results: what is kept of one build is none of another.
#pragma once

#include "vorion/support/Expected.h"

#include <string>

namespace vorion::splat {

/// A hash of the contents of all programs and libraries of the build or
/// installed tree that a result depends on: this one with its kernels, the
/// compiler, what kernels link, the runtime with the machine, the OpenCL
/// platform. What is not there does not count: a device of somebody else needs
/// only this program. An Error if one cannot be read.
/// \p Splat: the program that counts as this one, if it is another.
Expected<std::string> hashPrograms(const std::string &Splat = "");

} // namespace vorion::splat
