//===- PassLoops.h - loops over a group's passes ----------------*- C++ -*-===//
//
// A group that is larger than a warp runs in passes, and PoCL makes a loop over
// them (docs/adr/0006-work-item-loops.md). Shared with PoCL, which marks it.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_PASSLOOPS_H
#define VORION_LLVM_BACKEND_PASSLOOPS_H

#include "llvm/IR/Instructions.h"
#include "llvm/IR/Metadata.h"
#include "llvm/IR/PassManager.h"

namespace llvm {
namespace vorion {

/// The property of the loop of a kernel that has only this one.
inline constexpr char PassLoop[] = "vorion.passes";

/// Says of the loop over passes that \p Back ends: the optimiser shall not
/// unroll it by its own measure, which takes 16 passes with a branch each for
/// short. Instead UnrollPassLoops may, if the kernel has only this loop.
inline void markPassLoop(BranchInst &Back, bool Alone) {
  LLVMContext &Context = Back.getContext();
  const auto Property = [&Context](const char *Name) {
    return MDNode::get(Context, MDString::get(Context, Name));
  };
  SmallVector<Metadata *, 3> Properties = {
      nullptr, Property("llvm.loop.unroll.disable")};
  if (Alone)
    Properties.push_back(Property(PassLoop));
  MDNode *Loop = MDNode::getDistinct(Context, Properties);
  Loop->replaceOperandWith(0, Loop);
  Back.setMetadata(LLVMContext::MD_loop, Loop);
}

/// Asks for a few passes a round where a pass is short (PassLoops.cpp).
class UnrollPassLoops : public PassInfoMixin<UnrollPassLoops> {
public:
  PreservedAnalyses run(Function &F, FunctionAnalysisManager &Analyses);
};

} // namespace vorion
} // namespace llvm

#endif
