// `vorion-clang --resources`: what each function of a compilation takes of the
// machine, for its author. The compiler itself collects it
// (new/Resources.h); here it becomes a table or a report.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"

#include <optional>
#include <string>
#include <vector>

namespace vorion {

/// What stands behind `--resources=`, empty if nothing does, if the option is
/// among \p Arguments; it is taken out.
std::optional<std::string>
takeResourcesOption(std::vector<llvm::StringRef> &Arguments);

/// Runs \p Tool with \p Arguments, then tells what its functions take: as a
/// table if \p Form is empty, as a report to standard output if it is "json",
/// else as a report to the file of that name. The exit code.
int runWithResources(llvm::StringRef Tool,
                     llvm::ArrayRef<llvm::StringRef> Arguments,
                     const std::string &Form);

} // namespace vorion
