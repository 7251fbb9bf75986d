// The library behind the Python package vorion.

#include "python/Bindings.h"

PYBIND11_MODULE(_machine, M) {
  using namespace vorion::splat::python;
  M.attr("__version__") = VORION_VERSION;
  addErrors(M);
  addScene(M);
  addMesh(M);
  addCamera(M);
  addMachine(M);
}
