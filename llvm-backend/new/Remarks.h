//===- Remarks.h - what our passes tell of their decisions ------*- C++ -*-===//
//
// Through LLVM's own remarks: -Rpass=vorion, -Rpass-missed=vorion and
// -Rpass-analysis=vorion show them, -fsave-optimization-record writes them. A
// text is made only if somebody listens. docs/backend.md lists the names.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_REMARKS_H
#define VORION_LLVM_BACKEND_REMARKS_H

#include "llvm/Analysis/OptimizationRemarkEmitter.h"
#include "llvm/IR/DiagnosticInfo.h"
#include "llvm/IR/Instructions.h"
#include <string>

namespace llvm::vorion {

/// What a remark is about: the name that -Rpass= takes.
namespace remarks {
inline constexpr const char *Atomic = "vorion-atomic";
inline constexpr const char *Barrier = "vorion-barrier";
inline constexpr const char *Constant = "vorion-constant";
inline constexpr const char *Loop = "vorion-loop";
inline constexpr const char *Raise = "vorion-raise";
inline constexpr const char *Repeat = "vorion-repeat";
inline constexpr const char *Select = "vorion-select";
inline constexpr const char *Split = "vorion-split";
inline constexpr const char *Switch = "vorion-switch";
inline constexpr const char *Uniform = "vorion-uniform";
} // namespace remarks

/// Tells \p Text, a function that gives it, of the code at \p Place, which lies
/// in \p Block. \p Kind is OptimizationRemark, OptimizationRemarkMissed or
/// OptimizationRemarkAnalysis; \p Name tells decisions of one pass apart.
template <typename Kind, typename Function>
void remark(const char *Pass, StringRef Name, const DebugLoc &Place,
            const BasicBlock &Block, Function Text) {
  OptimizationRemarkEmitter(Block.getParent()).emit([&] {
    return Kind(Pass, Name, Place, &Block) << std::string(Text());
  });
}

/// The same of one instruction.
template <typename Kind, typename Function>
void remark(const char *Pass, StringRef Name, const Instruction &At,
            Function Text) {
  remark<Kind>(Pass, Name, At.getDebugLoc(), *At.getParent(), Text);
}

} // namespace llvm::vorion

#endif
