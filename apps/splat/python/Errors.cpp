#include "python/Errors.h"

#include <array>

namespace vorion::splat::python {

namespace py = pybind11;

namespace {

/// A class for each exit code that a user may want to tell from the others.
struct ErrorClass {
  ExitCode Code;
  const char *Name;
  const char *Text;
  PyObject *&Also; ///< the class of Python's own that it is, too; null for none
};

PyObject *NoOther = nullptr;

const std::array<ErrorClass, 4> &classes() {
  static const std::array<ErrorClass, 4> All{
      {{ExitCode::Usage, "UsageError",
        "An argument is invalid: an option, a shape, a size.",
        PyExc_ValueError},
       {ExitCode::InputFile, "InputError",
        "A file cannot be read, or is not a scene or camera file.", NoOther},
       {ExitCode::Trap, "TrapError",
        "A kernel trapped on the simulated machine.", NoOther},
       {ExitCode::LimitReached, "LimitError",
        "The scene or the picture is too large for the machine.",
        PyExc_MemoryError}}};
  return All;
}

/// The class of all errors, then those of classes(). They live as long as the
/// interpreter.
std::array<PyObject *, 5> Made{};

PyObject *classOf(ExitCode Code) {
  for (std::size_t I = 0; I < classes().size(); ++I)
    if (classes()[I].Code == Code)
      return Made[I + 1];
  return Made[0];
}

/// As Python has names of files, which may be no UTF-8.
py::object textOf(const std::string &Text) {
  return py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefaultAndSize(
      Text.data(), static_cast<Py_ssize_t>(Text.size())));
}

void raise(const Failed &F) {
  PyObject *Class = classOf(F.Problem.Code);
  py::object Raised =
      py::reinterpret_borrow<py::object>(Class)(textOf(F.what()));
  Raised.attr("where") = textOf(F.Problem.Where);
  Raised.attr("exit_code") = static_cast<int>(F.Problem.Code);
  Raised.attr("build_log") = F.Log;
  PyErr_SetObject(Class, Raised.ptr());
}

} // namespace

Failed::Failed(Error What, std::string BuildLog)
    : Problem(std::move(What)), Log(std::move(BuildLog)),
      Sentence(Problem.Where.empty() ? Problem.What
                                     : Problem.Where + ": " + Problem.What) {}

void addErrors(py::module_ &M) {
  Made[0] = PyErr_NewExceptionWithDoc(
      "vorion.Error",
      "Something went wrong; the text is splat's sentence.\n\n"
      "where: the file, or an empty text\n"
      "exit_code: what splat would end with\n"
      "build_log: the compiler's messages about a kernel, mostly empty",
      PyExc_RuntimeError, nullptr);
  M.attr("Error") = py::handle(Made[0]);
  // Exceptions that Python code raises have no place and no build log.
  py::handle(Made[0]).attr("where") = "";
  py::handle(Made[0]).attr("build_log") = "";
  for (std::size_t I = 0; I < classes().size(); ++I) {
    const ErrorClass &C = classes()[I];
    const py::handle Base(Made[0]);
    const py::tuple Bases = C.Also ? py::make_tuple(Base, py::handle(C.Also))
                                   : py::make_tuple(Base);
    Made[I + 1] =
        PyErr_NewExceptionWithDoc((std::string("vorion.") + C.Name).c_str(),
                                  C.Text, Bases.ptr(), nullptr);
    M.attr(C.Name) = py::handle(Made[I + 1]);
    py::handle(Made[I + 1]).attr("exit_code") = static_cast<int>(C.Code);
  }
  // NOLINTNEXTLINE(performance-unnecessary-value-param): the type is pybind11's
  py::register_exception_translator([](std::exception_ptr P) {
    try {
      if (P)
        std::rethrow_exception(P);
    } catch (const Failed &F) {
      raise(F);
    }
  });
}

} // namespace vorion::splat::python
