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

py::array arrayOf(std::vector<float> Values, const Shape &Sizes) {
  auto Kept = std::make_unique<std::vector<float>>(std::move(Values));
  float *Data = Kept->data();
  const py::capsule Owner(Kept.get(), [](void *Pointer) {
    delete static_cast<std::vector<float> *>(Pointer);
  });
  Kept.release(); // NOLINT(bugprone-unused-return-value): the capsule's now
  return py::array_t<float>(Sizes, Data, Owner);
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
    throw Failed({"", Name + " holds a NaN or an infinity, expected finite "
                             "values"});
  return {A.data(), A.data() + A.size()};
}

} // namespace vorion::splat::python
