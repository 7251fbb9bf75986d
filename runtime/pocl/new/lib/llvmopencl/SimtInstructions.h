//===- SimtInstructions.h - instructions that only lanes need -------------===//

#ifndef POCL_SIMT_INSTRUCTIONS_H
#define POCL_SIMT_INSTRUCTIONS_H

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Module.h>

namespace pocl {

/// An intrinsic of ours. It may read and write memory for all that the
/// optimiser knows, and is neither copied nor made conditional.
llvm::FunctionCallee intrinsic(llvm::Module &M, llvm::StringRef Name,
                               llvm::Type *Result,
                               llvm::ArrayRef<llvm::Type *> Parameters);

/// A barrier of the machine. The group is one warp, which passes at once; for
/// the optimiser it keeps memory accesses in order and cannot be copied, so
/// that no lane runs ahead of it on a path of its own.
void createGroupBarrier(llvm::IRBuilder<> &Builder);

/// \p Word, a 32-bit integer, with the promise that all lanes agree in it. The
/// optimiser does not know that it is the same value.
llvm::Value *createUniform(llvm::IRBuilder<> &Builder, llvm::Value *Word);

/// A bit for each active lane in which \p Condition holds.
llvm::Value *createBallot(llvm::IRBuilder<> &Builder, llvm::Value *Condition);

/// \p Word of another lane; if that is not active, the lane's own. A lane that
/// there is not is at most 63.
llvm::Value *createFromLane(llvm::IRBuilder<> &Builder, llvm::Value *Word,
                            llvm::Value *Lane);

/// \p Word of the group's first work-item, which is the same for all of them.
llvm::Value *createOfGroup(llvm::IRBuilder<> &Builder, llvm::Value *Word);
bool isOfGroup(const llvm::Value &V);

/// A variable that a lane has once for all its work-items, and keeps from pass
/// to pass and across barriers.
llvm::AllocaInst *createLaneVariable(llvm::IRBuilder<> &Builder, llvm::Type *T,
                                     const char *Name);
bool isLaneVariable(const llvm::AllocaInst &Variable);

/// Ends \p Block with a trap. No lane goes on, but there is a branch to \p
/// Next, because the compiler needs a place where lanes that part meet again.
void createTrap(llvm::BasicBlock &Block, llvm::BasicBlock *Next,
                const llvm::DebugLoc &At);

} // namespace pocl

#endif
