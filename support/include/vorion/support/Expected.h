/// A value or an error. Input errors are values of this type; bugs are
/// assertions.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace vorion {

/// Exit codes of every tool of the project, listed in each `--help`.
enum class ExitCode : int {
  Ok = 0,
  GuestFailed = 1, ///< the program on the simulated machine said so
  Usage = 2,       ///< command line
  InputFile = 3,   ///< unreadable or malformed input, unwritable output
  Trap = 4,        ///< a fault on the simulated machine
  LimitReached = 5,
  Internal = 70, ///< a bug of ours (EX_SOFTWARE)
};

/// An error with its location and exit code. \c Where is a file or "file:line"
/// and may be empty; \c What is lower case without a full stop and includes
/// what was expected.
struct Error {
  std::string Where;
  std::string What;
  ExitCode Code = ExitCode::InputFile;
};

/// Either a \p T or an \c Error.
template <typename T> class [[nodiscard]] Expected {
public:
  Expected(T Value) : Storage(std::move(Value)) {}
  Expected(Error E) : Storage(std::move(E)) {}

  explicit operator bool() const { return Storage.index() == 0; }
  T &operator*() { return value(); }
  const T &operator*() const { return value(); }
  T *operator->() { return &value(); }
  const T *operator->() const { return &value(); }
  T &value() {
    assert(*this && "value of a failed Expected");
    return std::get<0>(Storage);
  }
  const T &value() const {
    assert(*this && "value of a failed Expected");
    return std::get<0>(Storage);
  }
  const Error &error() const {
    assert(!*this && "error of a successful Expected");
    return std::get<1>(Storage);
  }

private:
  std::variant<T, Error> Storage;
};

/// Success, for operations without a value.
using Success = std::monostate;

} // namespace vorion
