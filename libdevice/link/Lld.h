/// LLVM's linker lld, which is a part of this program: as a process of its own
/// it would take 20 ms to start.
#pragma once

#include <string>
#include <vector>

namespace llvm {
class raw_ostream;
} // namespace llvm

namespace vorion::link {

/// Does what `ld.lld` does with these arguments, of which the first is its name
/// in messages. Ends the process with lld's exit code.
[[noreturn]] void runLld(const std::vector<std::string> &Arguments);

/// The same, but returns whether lld succeeded, and \p Messages gets what it
/// says: each message, with all its lines, by one call. The process ends all
/// the same after a fatal error of lld.
bool callLld(const std::vector<std::string> &Arguments,
             llvm::raw_ostream &Messages);

} // namespace vorion::link
