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

namespace llvm {
class PassBuilder;

namespace vorion {

/// Nothing happens to a module without lines.
void registerKeptLines(PassBuilder &PB);

} // namespace vorion
} // namespace llvm

#endif
