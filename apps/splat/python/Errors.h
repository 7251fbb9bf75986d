/// Errors of the project as Python's exceptions, with splat's sentences.
#pragma once

#include "vorion/support/Expected.h"

#include <exception>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>

namespace vorion::splat::python {

/// An error on its way to Python.
class Failed : public std::exception {
public:
  /// \p BuildLog is what the compiler said of a kernel; empty for nothing.
  explicit Failed(Error What, std::string BuildLog = {});
  const char *what() const noexcept override { return Sentence.c_str(); }

  const Error Problem;
  const std::string Log;

private:
  std::string Sentence; ///< as splat says it after "splat: error: "
};

/// What \p E holds; throws the error if it has failed.
template <typename T> T valueOf(Expected<T> E) {
  if (!E)
    throw Failed(E.error());
  return std::move(*E);
}

/// Adds the classes of exceptions to \p M.
void addErrors(pybind11::module_ &M);

} // namespace vorion::splat::python
