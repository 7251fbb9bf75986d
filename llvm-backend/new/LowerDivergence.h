//===- LowerDivergence.h - the steps of divergence lowering -----*- C++ -*-===//
//
// A warp has one program counter. Where its lanes may disagree about a branch,
// vx_split runs the two sides one after the other and vx_join brings the lanes
// together again; in a loop, vx_pred keeps the lanes that have left waiting for
// the others. docs/backend.md explains the scheme; these are its steps.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_LOWERDIVERGENCE_H
#define VORION_LLVM_BACKEND_LOWERDIVERGENCE_H

#include "llvm/ADT/SmallPtrSet.h"
#include "llvm/ADT/Twine.h"
#include "llvm/Analysis/UniformityAnalysis.h"
#include "llvm/IR/PassManager.h"

namespace llvm {
class BranchInst;
class Function;
class Instruction;
class Loop;
class DominatorTree;
class PostDominatorTree;
class RISCVSubtarget;

namespace vorion {

/// Reports that \p At cannot be compiled for our machine. Compilation goes on
/// to the next error and then fails.
void refuse(const Instruction &At, const Twine &Why);

/// Whether \p Block ends with a branch that lanes may disagree about.
bool branchesApart(UniformityInfo &Uniform, const BasicBlock &Block);

using BlockSet = SmallPtrSet<BasicBlock *, 16>;

/// The blocks that control can come to from \p From, itself included, without
/// passing \p Until (which may be null).
BlockSet blocksBefore(BasicBlock *From, BasicBlock *Until);

/// The blocks that both sides of the branch of \p Block lead to before they
/// meet at \p Meeting (which may be null).
BlockSet sharedBlocks(const BasicBlock &Block, BasicBlock *Meeting);

/// Whether the lanes that start an iteration of \p L also end it together: it
/// has one exit that every iteration passes (where vx_pred can hold lanes
/// back), or lanes leave it only together, and wherever they part they meet
/// again in the same iteration.
bool loopIsInStep(const Loop &L, UniformityInfo &Uniform,
                  const PostDominatorTree &PostDominators,
                  const DominatorTree &Dominators);

/// The conditional branch with which all lanes leave \p L, if it is the only
/// one and every iteration passes it; else null.
BranchInst *soleExit(const Loop &L, const DominatorTree &Dominators);

/// Rebuilds the loops of \p F that are not in step, inner ones first; outer
/// ones wait for the next call. True if there was one. All loops are in
/// loop-simplify and LCSSA form.
bool mergeLoopExits(Function &F, FunctionAnalysisManager &Analyses);

/// Makes basic blocks that both sides of a divergent branch reach execute once,
/// where that is cheaper. True if there was one; \p Analyses are then stale.
/// All loops are in step.
bool reconvergeEarly(Function &F, FunctionAnalysisManager &Analyses);

/// All of them, in order. False if \p F is not to be compiled further.
bool lowerDivergence(Function &F, FunctionAnalysisManager &Analyses,
                     const RISCVSubtarget &Subtarget, bool Optimize);

/// Calls the functions one after the other where lanes may differ in what a
/// pointer calls. True if there was such a call; \p Uniform is then stale.
bool callPointersInTurn(Function &F, UniformityInfo &Uniform);

/// Replaces divergent branches around a few instructions that all lanes may
/// execute by selects. True if there were any; \p Analyses are then stale.
bool selectShortSides(Function &F, FunctionAnalysisManager &Analyses,
                      const RISCVSubtarget &Subtarget);

/// Says why the other divergent branches stay.
void remarkSidesKept(Function &F, FunctionAnalysisManager &Analyses,
                     const RISCVSubtarget &Subtarget);

/// Moves what LLVM sank behind a loop in front of it again, where fewer values
/// are then alive across the loop. True if there was anything.
bool raiseInvariants(Function &F, FunctionAnalysisManager &Analyses);

/// Marks comparisons that lanes agree in although they differ in what is
/// compared. True if there was anything new.
bool markUniformTests(Function &F, FunctionAnalysisManager &Analyses);

/// Marks what may give different results although lanes ask alike: memory reads
/// and calls in blocks that a warp executes in several passes. True if there
/// was anything new.
bool markRepeatedBlocks(Function &F, UniformityInfo &Uniform,
                        const PostDominatorTree &PostDominators);

/// Marks PHI nodes that depend on a divergent branch and that the analysis
/// takes to be uniform. True if there was one.
bool markDivergentJoins(Function &F, UniformityInfo &Uniform,
                        const PostDominatorTree &PostDominators);

/// Marks loads and stores that are atomic, for the section vorion_atomics. True
/// if there was one.
bool markAtomicPlaces(Function &F);

/// Puts the splits, joins and predicates in. Every loop is in step.
void insertSplits(Function &F, FunctionAnalysisManager &Analyses);

} // namespace vorion
} // namespace llvm

#endif
