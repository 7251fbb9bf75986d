/// What the programs that build OpenCL C leave, in the house's form.
#pragma once

#include "vorion/support/Expected.h"

#include <string>
#include <vector>
#include <vorion_offline.h>

namespace vorion {

/// The one error that tells why \p Input was not built, after the compiler's
/// \p Log was shown: how many errors are in it, or a function without
/// definition, an option, a file that cannot be written; else the first words
/// of \p Output, which is all that was printed.
Error compilerError(const std::string &Input, const std::string &Log,
                    const std::string &Output);

/// What the machine's compiler said of the first kernel in \p Output that it
/// refused; empty if it refused none.
std::string machineLog(const std::string &Output);

/// The remarks among what was printed, a line each.
std::string remarks(const std::string &Output);

/// What the machine's compiler said in \p Output of -mllvm and -march.
Error optionError(const std::string &Output);

/// Why the kernels of \p Input, which has no errors, could not be compiled for
/// the machine, by what was printed.
Error kernelError(const std::string &Input, const std::string &Output);

/// What lld said in \p Output.
std::string linkerLog(const std::string &Output);

/// The linker's first error, without the names of the programs that said it: of
/// the first of \p Kernels that it names, or of \p Image if it names none.
Error linkerError(const std::string &Image,
                  const std::vector<OfflineKernel> &Kernels,
                  const std::string &Output);

} // namespace vorion
