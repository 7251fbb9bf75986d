#include "python/Arrays.h"

#include "python/Errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <utility>

namespace vorion::splat::python {

namespace py = pybind11;

py::array viewOf(std::vector<float> &Values, const Shape &Sizes,
                 const py::handle &Owner) {
  return py::array_t<float>(Sizes, Values.data(), Owner);
}

template <typename T>
static py::array owningArray(std::vector<T> Values, const Shape &Sizes) {
  auto Kept = std::make_unique<std::vector<T>>(std::move(Values));
  T *Data = Kept->data();
  const py::capsule Owner(Kept.get(), [](void *Pointer) {
    delete static_cast<std::vector<T> *>(Pointer);
  });
  Kept.release(); // NOLINT(bugprone-unused-return-value): the capsule's now
  return py::array_t<T>(Sizes, Data, Owner);
}

py::array arrayOf(std::vector<float> Values, const Shape &Sizes) {
  return owningArray(std::move(Values), Sizes);
}

py::array arrayOf(std::vector<double> Values, const Shape &Sizes) {
  return owningArray(std::move(Values), Sizes);
}

py::array arrayOf(std::vector<int32_t> Values, const Shape &Sizes) {
  return owningArray(std::move(Values), Sizes);
}

std::vector<float> valuesOf(const FloatArray &A, const std::string &Name,
                            const Shape &Sizes) {
  const Shape Has(A.shape(), A.shape() + A.ndim());
  if (!std::ranges::equal(Has, Sizes))
    throw Failed({"",
                  fmt::format("{} has the shape ({}), expected ({})", Name,
                              fmt::join(Has, ", "), fmt::join(Sizes, ", ")),
                  ExitCode::Usage});
  if (!std::all_of(A.data(), A.data() + A.size(),
                   [](float V) { return std::isfinite(V); }))
    throw Failed({"", Name + " has a NaN or an infinity, expected finite "
                             "values"});
  return {A.data(), A.data() + A.size()};
}

} // namespace vorion::splat::python
