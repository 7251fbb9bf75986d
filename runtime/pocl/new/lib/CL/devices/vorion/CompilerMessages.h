/// What the driver and vorion-compiler, which makes images of kernels, send
/// each other (vorion/support/ToolMessages.h).
#pragma once

#include "vorion/support/ToolMessages.h"

#include <string>
#include <vector>

namespace vorion {

/// Asks for a kernel's image.
struct ImageRequest {
  std::string Bitcode; ///< with the kernel's entry in the table of kernels
  bool Optimize = true;
  /// Whether the object is wanted, too, from which images of several kernels
  /// are linked.
  bool WantsObject = false;
  /// Further options of vorion-clang.
  std::vector<std::string> Options;
};
template <typename Archive> void visit(Archive &A, ImageRequest &Request) {
  A.text(Request.Bitcode);
  A.number(Request.Optimize);
  A.number(Request.WantsObject);
  A.list(Request.Options);
}

struct ImageAnswer {
  std::string Image; ///< an ELF file; empty if the kernel has an error
  std::string Object;
  bool IsCompiled = false; ///< there is no image because of the link
  std::string Printed;     ///< errors, warnings and remarks
};
template <typename Archive> void visit(Archive &A, ImageAnswer &Answer) {
  A.text(Answer.Image);
  A.text(Answer.Object);
  A.number(Answer.IsCompiled);
  A.text(Answer.Printed);
}

} // namespace vorion
