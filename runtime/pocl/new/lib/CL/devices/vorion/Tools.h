/// The installation that this library belongs to: its compiler of device code
/// and its headers.
#pragma once

#include "CompilerMessages.h"
#include "CompilerProcess.h"

#include <functional>
#include <optional>
#include <string>

namespace vorion {

class Tools {
public:
  /// Looks for bin/vorion-compiler below VORION_ROOT, else below the folders
  /// above this library.
  Tools();

  /// Empty if the compiler was found, else what is missing.
  const std::string &problem() const { return Problem; }

  /// Headers for kernels.
  std::string includeFolder() const { return Root + "/include/vorion"; }

  /// Changes whenever this library, the compiler or the device library does.
  /// Part of the key of cached binaries.
  std::string fingerprint() const;

  /// Sends \p Request, completed with this process's current folder and the
  /// options of VORION_REMARKS, to the compiler. What the compiler printed goes
  /// to standard error, except for a kernel that has an error; what it says of
  /// files becomes this thread's (pocl_file_problem()). Gives why there is no
  /// answer.
  std::optional<CompilerFailure> ask(CompilerRequest &Request,
                                     CompilerAnswer &Answer) const;

  std::string compiler() const;

  /// Gets each answer whose kernel has no error, and prints what is printed, in
  /// the place of standard error; null for a program of OpenCL.
  static std::function<void(const CompilerAnswer &)> Listener;

private:
  std::string Root, Problem;
};

} // namespace vorion
