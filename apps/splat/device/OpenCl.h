/// The OpenCL C++ bindings as this program uses them, and its errors.
#pragma once

#include "vorion/support/Expected.h"

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/opencl.hpp>

#include <string>
#include <string_view>

namespace vorion::splat {

/// The OpenCL name of \p Status, or its number where it has none here.
std::string statusName(cl_int Status);

/// An error of \p What ("reading the picture back"). Memory that is not there
/// is a limit; anything else that OpenCL refuses is our bug.
Error clError(std::string_view What, cl_int Status);

} // namespace vorion::splat
