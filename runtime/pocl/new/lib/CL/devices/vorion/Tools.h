/// The installation that this library belongs to: its compiler of device code
/// and its headers.
#pragma once

#include "CompilerMessages.h"

#include <string>

namespace vorion {

/// What was made of a kernel's bitcode.
struct MadeImage {
  enum class Cause {
    Kernel,    ///< it has an error, or the compiler has
    Resources, ///< the compiler lacks memory, or cannot be started
  };
  std::string Image;   ///< an ELF file
  std::string Object;  ///< if it was requested
  std::string Problem; ///< why there is no image: a line, and what was printed
  Cause Of = Cause::Kernel; ///< whose problem
};

class Tools {
public:
  /// Looks for bin/vorion-compiler below VORION_ROOT, else below the folders
  /// above this library.
  Tools();

  /// Empty if the compiler was found, else what is missing.
  const std::string &problem() const { return Problem; }

  /// Headers for kernels.
  std::string includeFolder() const { return Root + "/include/vorion"; }

  /// Changes whenever this library, a compiler or the device library does. Part
  /// of the key of cached binaries.
  std::string fingerprint() const;

  /// Compiles with the options of VORION_REMARKS, too, and prints the remarks.
  MadeImage makeImage(ImageRequest Request) const;

private:
  std::string compiler() const;

  std::string Root, Problem;
};

} // namespace vorion
