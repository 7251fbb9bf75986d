// `vorion-objdump --profile PROFILE`: llvm-objdump's listing of a program with
// what the simulator's profile says of each instruction beside it.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"

#include <optional>
#include <string>
#include <vector>

namespace vorion {

/// The value of --profile, if it is among \p Arguments; it is taken out. Empty
/// if nothing follows.
std::optional<std::string>
takeCyclesOption(std::vector<llvm::StringRef> &Arguments);

/// Runs \p Tool with \p Arguments and prints the functions that were executed
/// with the figures of \p Profile, a file. Without a program among the
/// arguments, those that the profile names. The exit code.
int runWithCycles(llvm::StringRef Tool, std::vector<llvm::StringRef> Arguments,
                  bool HasProgram, const std::string &Profile);

} // namespace vorion
