/// What _machine offers the Python files of the package, part by part.
#pragma once

#include "vorion/support/CommandLine.h"

#include "python/Errors.h"

#include <functional>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace vorion::splat::python {

using Words = std::vector<std::string>;

void addScene(pybind11::module_ &M);
void addMesh(pybind11::module_ &M);
void addCamera(pybind11::module_ &M);
void addMachine(pybind11::module_ &M);

/// Parses \p Given by what \p Declare adds; throws what the parser refuses.
inline void parse(Words Given, const std::function<void(CLI::App &)> &Declare) {
  CLI::App App;
  App.set_help_flag();
  Declare(App);
  valueOf(parseOptions(App, std::move(Given)));
}

} // namespace vorion::splat::python
