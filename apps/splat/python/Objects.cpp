#include "python/Objects.h"

#include <nlohmann/json.hpp>
#include <string>

namespace vorion::splat::python {

namespace py = pybind11;
using Json = nlohmann::ordered_json;

py::object toPython(const Json &J) {
  switch (J.type()) {
  case Json::value_t::object: {
    py::dict Members;
    for (const auto &[Key, Value] : J.items())
      Members[py::str(Key)] = toPython(Value);
    return Members;
  }
  case Json::value_t::array: {
    py::list Elements;
    for (const Json &Element : J)
      Elements.append(toPython(Element));
    return Elements;
  }
  case Json::value_t::string:
    return py::str(J.get_ref<const std::string &>());
  case Json::value_t::boolean:
    return py::bool_(J.get<bool>());
  case Json::value_t::number_integer:
    return py::int_(J.get<int64_t>());
  case Json::value_t::number_unsigned:
    return py::int_(J.get<uint64_t>());
  case Json::value_t::number_float:
    return py::float_(J.get<double>());
  default:
    return py::none();
  }
}

} // namespace vorion::splat::python
