//===- KeptLines.h - lines of code that moves -------------------*- C++ -*-===//
//
// What is the same for all work-items leaves the loop over them, and LLVM drops
// the line of what it moves: in a debugger a step shall not go back. In a
// profile, a whole kernel of such code then has no line. So the lines are noted
// before the optimisation, and given back behind it.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_KEPTLINES_H
#define VORION_LLVM_BACKEND_KEPTLINES_H

#include <functional>

namespace llvm {
class Module;
class PassBuilder;

namespace vorion {

/// Nothing happens to a module without lines, or that \p IsOurs refuses.
void registerKeptLines(PassBuilder &PB,
                       std::function<bool(const Module &)> IsOurs);

} // namespace vorion
} // namespace llvm

#endif
