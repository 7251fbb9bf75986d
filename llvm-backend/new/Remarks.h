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
#include "llvm/IR/DebugInfoMetadata.h"
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
inline constexpr const char *Reconverge = "vorion-reconverge";
inline constexpr const char *Repeat = "vorion-repeat";
inline constexpr const char *Select = "vorion-select";
inline constexpr const char *Split = "vorion-split";
inline constexpr const char *Switch = "vorion-switch";
inline constexpr const char *Uniform = "vorion-uniform";
} // namespace remarks

/// Where the source has \p F; no place without line numbers.
inline DebugLoc placeOf(const Function &F) {
  DISubprogram *Source = F.getSubprogram();
  return Source ? DebugLoc(DILocation::get(F.getContext(), Source->getLine(), 0,
                                           Source))
                : DebugLoc();
}

/// " (line 12)" of the first line of \p Block; empty without line numbers.
inline std::string lineOf(const BasicBlock &Block) {
  for (const Instruction &I : Block)
    if (I.getDebugLoc() && I.getDebugLoc().getLine())
      return " (line " + std::to_string(I.getDebugLoc().getLine()) + ")";
  return {};
}

/// Where \p I is, or else what it is computed from; no place if neither has a
/// line.
inline DebugLoc placeOf(const Instruction &I) {
  const auto HasLine = [](const Instruction &Of) {
    return Of.getDebugLoc() && Of.getDebugLoc().getLine();
  };
  if (HasLine(I))
    return I.getDebugLoc();
  for (const Use &Operand : I.operands())
    if (const auto *From = dyn_cast<Instruction>(Operand);
        From && HasLine(*From))
      return From->getDebugLoc();
  return DebugLoc();
}

/// Tells \p Text, a function that gives it, of the code at \p Place, which lies
/// in \p Block, or of the function where \p Place is none. \p Kind is
/// OptimizationRemark, OptimizationRemarkMissed or OptimizationRemarkAnalysis;
/// \p Name tells decisions of one pass apart.
template <typename Kind, typename Function>
void remark(const char *Pass, StringRef Name, const DebugLoc &Place,
            const BasicBlock &Block, Function Text) {
  OptimizationRemarkEmitter(Block.getParent()).emit([&] {
    return Kind(Pass, Name, Place ? Place : placeOf(*Block.getParent()), &Block)
           << std::string(Text());
  });
}

/// The same of one instruction.
template <typename Kind, typename Function>
void remark(const char *Pass, StringRef Name, const Instruction &At,
            Function Text) {
  remark<Kind>(Pass, Name, placeOf(At), *At.getParent(), Text);
}

} // namespace llvm::vorion

#endif
