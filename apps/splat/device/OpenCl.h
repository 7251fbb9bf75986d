/// The OpenCL C++ bindings as configured for this program, and its errors.
#pragma once

#include "vorion/support/Expected.h"

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/opencl.hpp>

#include <string>
#include <string_view>

namespace vorion::splat {

/// The OpenCL name of \p Status, or its number if it is unknown.
std::string statusName(cl_int Status);

/// The error of \p What ("reading the picture back"). Insufficient memory is a
/// limit; any other error of OpenCL is internal.
Error clError(std::string_view What, cl_int Status);

} // namespace vorion::splat
