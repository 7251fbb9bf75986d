// The library behind the Python package vorion.

#include "python/Arrays.h"
#include "python/Bindings.h"

#include "io/Metrics.h"

PYBIND11_MODULE(_machine, M) {
  using namespace vorion::splat::python;
  M.attr("__version__") = VORION_VERSION;
  addErrors(M);
  addScene(M);
  addMesh(M);
  addCamera(M);
  addMachine(M);
  // (H, W, C) each, of the same shape.
  M.def("ssim", [](const DoubleArray &A, const DoubleArray &B) {
    const auto Values = [](const DoubleArray &Of) {
      return std::vector<double>(Of.data(), Of.data() + Of.size());
    };
    return vorion::splat::ssim(Values(A), Values(B),
                               static_cast<std::size_t>(A.shape(1)),
                               static_cast<std::size_t>(A.shape(2)));
  });
}
