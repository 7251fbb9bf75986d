//===- UnifyExits.h - one return that every path leads to -------*- C++ -*-===//
//
// Shared with PoCL, whose regions between barriers need the same.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_UNIFYEXITS_H
#define VORION_LLVM_BACKEND_UNIFYEXITS_H

#include "llvm/ADT/STLFunctionalExtras.h"
#include "llvm/IR/IRBuilder.h"

namespace llvm {
class LoopInfo;

namespace vorion {

/// A trap, as an instruction that nothing is known of: the optimiser keeps what
/// follows it.
CallInst *createTrap(IRBuilder<> &Builder);

/// Makes lanes that come to an `unreachable` of \p F trap, unless a call that
/// does not return is in front of it. True if there was one.
bool trapAtUnreachable(Function &F);

/// Gives \p F one return and every path a way to it. What never comes to a
/// return by itself, a loop without end or an `unreachable`, gets an edge to
/// the place where the other paths from the last common branch meet: so the
/// post-dominators of everything else are as if the dead end were not there.
/// The edge is never taken. True if \p F was changed.
/// \p Known: whether the optimiser may know that. If it may not, because it has
/// yet to run, \p MakeTrue makes the condition that keeps to a loop, and values
/// that come along the edge are frozen: where one is used that is poison, the
/// edge could be cut again. Calls that do not return must be none by then.
bool unifyExits(Function &F, const LoopInfo &Loops, bool Known,
                function_ref<Value *(IRBuilder<> &)> MakeTrue);

} // namespace vorion
} // namespace llvm

#endif
