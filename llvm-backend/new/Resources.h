//===- Resources.h - what a function takes of the machine -------*- C++ -*-===//
//
// For `vorion-clang --resources`, which names a file in the environment, for
// all the processes that it starts: an object of JSON is appended to it for
// each function that is emitted, one a line.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_RESOURCES_H
#define VORION_LLVM_BACKEND_RESOURCES_H

#include "Reasons.h"

namespace llvm {
class MachineFunction;

namespace vorion {

/// The variable that names the file.
inline constexpr const char *ResourcesVariable = "VORION_RESOURCES";

/// Whether anybody wants to know.
bool wantsResources();

/// Keeps of \p Branch, at which lanes part, that it becomes a \p Kind ("split",
/// "predicate") and why, until its function is emitted.
void noteDivergentBranch(const BranchInst &Branch, StringRef Kind,
                         const DebugLoc &Place, const Reason &Why);

/// Writes what \p MF, as it will be emitted, takes.
void writeResources(const MachineFunction &MF);

} // namespace vorion
} // namespace llvm

#endif
