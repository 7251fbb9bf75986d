//===- Resources.h - the resources of a function ----------------*- C++ -*-===//
//
// For `vorion-clang --resources`: an object of JSON is appended to the file of
// the option -vorion-resources for each function that is emitted, one a line.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_RESOURCES_H
#define VORION_LLVM_BACKEND_RESOURCES_H

#include "Reasons.h"

namespace llvm {
class MachineFunction;

namespace vorion {

/// The option of LLVM that names the file.
inline constexpr StringLiteral ResourcesOption = "vorion-resources";

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
