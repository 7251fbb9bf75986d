/// JSON as Python's objects.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <pybind11/pybind11.h>

namespace vorion::splat::python {

/// Objects become dicts in the same order, arrays lists.
pybind11::object toPython(const nlohmann::ordered_json &J);

} // namespace vorion::splat::python
