//===- Reasons.h - why lanes disagree about a branch ------------*- C++ -*-===//
//
// The uniformity analysis says that lanes may differ in a value. Authors ask
// why: this follows the value back to the nearest thing in which lanes differ
// for a reason of its own, such as the work-item's id.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_REASONS_H
#define VORION_LLVM_BACKEND_REASONS_H

#include "llvm/Analysis/UniformityAnalysis.h"
#include "llvm/IR/DebugLoc.h"
#include <string>
#include <vector>

namespace llvm {
class BranchInst;
class LoopInfo;
class Use;

namespace vorion {

/// One step of a reason, from the branch towards the source.
struct ReasonStep {
  std::string What; ///< "a load", "the work-item's id"
  DebugLoc Place;   ///< none of what has no line
  std::string Next; ///< how the sentence goes on; empty of the source
};
using Reason = std::vector<ReasonStep>;

class Reasons {
public:
  Reasons(const Function &Of, UniformityInfo &Uniform, const LoopInfo &Loops)
      : F(Of), Uniform(Uniform), Loops(Loops) {}

  /// The shortest way from the condition of \p Branch, in which lanes may
  /// differ, to a source; empty if none is found.
  Reason of(const BranchInst &Branch) const;

private:
  struct Visit;
  /// What \p V, in which lanes differ for a reason of its own, is.
  std::string source(const Value &V) const;
  /// The branch that lanes leave the loop of \p Operand's value by apart.
  const BranchInst *leaving(const Use &Operand) const;
  /// The nearest branch before \p Block that lanes part at.
  const BranchInst *partingBefore(const BasicBlock &Block) const;

  const Function &F;
  UniformityInfo &Uniform;
  const LoopInfo &Loops;
};

/// "its condition follows from a load in line 3, whose address follows from the
/// work-item's id". Lines of another file than that of \p At have its name.
std::string sentence(const Reason &Why, const DebugLoc &At);

/// The file of \p Place as the source names it; empty of no place.
std::string fileOf(const DebugLoc &Place);

} // namespace vorion
} // namespace llvm

#endif
