/// What tests share that run kernels with groups of many shapes.
#pragma once

#include "TestDevice.h"

#include <ostream>

namespace vorion::test {

using U = cl_uint;
using Values = std::vector<U>;

/// A group's size.
struct Shape {
  U X, Y, Z;
  U items() const { return X * Y * Z; }
  cl::NDRange range() const { return {X, Y, Z}; }
};

/// What GoogleTest shows for a parameter.
inline void PrintTo(const Shape &S, std::ostream *Stream) {
  *Stream << S.X << "x" << S.Y << "x" << S.Z;
}

/// What the output holds before a kernel runs.
constexpr U Untouched = ~U{0};

/// OpenCL C for the number of a work-item in its group, and how many these are.
inline const char *const ItemMacros = R"(
#define ITEM (get_local_id(0) + get_local_size(0) * (get_local_id(1) + get_local_size(1) * get_local_id(2)))
#define ITEMS (get_local_size(0) * get_local_size(1) * get_local_size(2))
)";

} // namespace vorion::test
