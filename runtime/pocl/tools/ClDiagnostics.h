/// PoCL's words about a build in the house's form.
#pragma once

#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion {

/// The warnings in a build log or the compiler's output.
std::vector<Error> compilerWarnings(const std::string &Log);

/// The one error that tells why \p Input was not built: the compiler's first,
/// an unknown option, or a function without definition; else the first words of
/// \p Output.
Error compilerError(const std::string &Input, const std::string &Output);

/// The linker's first error, without the names of the programs that said it.
Error linkerError(const std::string &Image, const std::string &Output);

} // namespace vorion
