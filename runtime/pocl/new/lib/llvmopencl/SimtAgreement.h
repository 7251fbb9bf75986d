//===- SimtAgreement.h - what the work-items of a group agree on ----------===//

#ifndef POCL_SIMT_AGREEMENT_H
#define POCL_SIMT_AGREEMENT_H

#include <llvm/IR/IRBuilder.h>

namespace pocl {

/// Tells all work-items of a group, those that have returned among them, a
/// number of 32 bits that is the same for all that have not.
class Agreement {
public:
  /// \p Builder: in the kernel's entry.
  explicit Agreement(llvm::IRBuilder<> &Builder);

  /// The number before any vote. A barrier must follow.
  void begin(llvm::IRBuilder<> &Builder, llvm::Value *With) const;

  /// Adds to \p Block, which has no end yet and which all work-items of a pass
  /// come to, that each for which \p Goes holds says its \p Own number. They
  /// trap at \p At if these differ. The block that goes on, behind which a
  /// barrier must follow.
  llvm::BasicBlock *vote(llvm::BasicBlock *Block, llvm::Value *Own,
                         llvm::Value *Goes, const llvm::DebugLoc &At) const;

  /// Notes for a pass whether \p Goes holds for any of its work-items, all of
  /// which come there. A barrier must follow.
  void ask(llvm::IRBuilder<> &Builder, llvm::Value *Goes) const;

  /// Behind that barrier: the number, or \p None if nobody said one.
  llvm::Value *result(llvm::IRBuilder<> &Builder, llvm::Value *None) const;

  /// Whether anybody said one, or goes.
  llvm::Value *hasResult(llvm::IRBuilder<> &Builder) const;

private:
  llvm::Value *noteAny(llvm::IRBuilder<> &Builder, llvm::Value *PassGoes) const;

  llvm::AllocaInst *Number, *Any;
};

} // namespace pocl

#endif
