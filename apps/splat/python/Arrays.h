/// Lists of floats as NumPy's arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <pybind11/numpy.h>
#include <string>
#include <vector>

namespace vorion::splat::python {

using Shape = std::vector<std::size_t>;
/// fp32, rows one after the other; what has another form is copied.
using FloatArray = pybind11::array_t<float, pybind11::array::c_style |
                                                pybind11::array::forcecast>;
using DoubleArray = pybind11::array_t<double, pybind11::array::c_style |
                                                  pybind11::array::forcecast>;

/// \p Values as an array that keeps \p Owner, which has them, alive. Who writes
/// to it writes to them. They must stay where they are.
pybind11::array viewOf(std::vector<float> &Values, const Shape &Sizes,
                       const pybind11::handle &Owner);

/// An array that owns \p Values.
pybind11::array arrayOf(std::vector<float> Values, const Shape &Sizes);
pybind11::array arrayOf(std::vector<double> Values, const Shape &Sizes);
pybind11::array arrayOf(std::vector<int32_t> Values, const Shape &Sizes);

/// The elements of \p A, called \p Name in the error that is thrown where its
/// shape is not \p Sizes, or where one is no finite number.
std::vector<float> valuesOf(const FloatArray &A, const std::string &Name,
                            const Shape &Sizes);

} // namespace vorion::splat::python
