/// What the driver tells the program.
#pragma once

#include "vorion.h"

#include <string>

namespace vorion {

/// Tells of a kernel that fails with \p Status: the function that the program
/// gave clCreateContext, or, if it gave none, standard error.
void tellFailure(cl_context Context, cl_int Status, const std::string &Text);

/// Notes on standard error, once in a process, that the profiling times of
/// kernels are those of the machine.
void noteModelledTimes();

} // namespace vorion
