//===- KeptLines.cpp - lines of code that moves ---------------------------===//
//
// The note is metadata of the instruction, a number in a table. LLVM keeps it
// where an instruction moves as a whole, and drops it, as all metadata that it
// does not know, from one that comes to stand for several or is executed where
// it was not before: those stay without a line.
//
//===----------------------------------------------------------------------===//

#include "KeptLines.h"
#include "llvm/IR/Constants.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/Instructions.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/IR/Module.h"
#include "llvm/Passes/PassBuilder.h"
#include <memory>
#include <vector>

using namespace llvm;

namespace {

constexpr char Note[] = "vorion.line";

/// By the number of the note. Of the module between the two passes.
using Lines = std::vector<DebugLoc>;

bool hasLine(const Instruction &I) {
  return I.getDebugLoc() && I.getDebugLoc().getLine() != 0;
}

class NoteLines : public PassInfoMixin<NoteLines> {
public:
  NoteLines(std::shared_ptr<Lines> Noted,
            std::function<bool(const Module &)> IsOurs)
      : Noted(std::move(Noted)), IsOurs(std::move(IsOurs)) {}

  PreservedAnalyses run(Module &M, ModuleAnalysisManager &) {
    Noted->clear();
    if (!IsOurs(M))
      return PreservedAnalyses::all();
    Type *I32 = Type::getInt32Ty(M.getContext());
    const unsigned Kind = M.getMDKindID(Note);
    for (Function &F : M)
      for (Instruction &I : instructions(F)) {
        if (!hasLine(I) || isa<PHINode>(I) || isa<DbgInfoIntrinsic>(I))
          continue;
        Metadata *Number =
            ConstantAsMetadata::get(ConstantInt::get(I32, Noted->size()));
        I.setMetadata(Kind, MDNode::get(M.getContext(), Number));
        Noted->push_back(I.getDebugLoc());
      }
    return PreservedAnalyses::all();
  }

private:
  std::shared_ptr<Lines> Noted;
  std::function<bool(const Module &)> IsOurs;
};

class RestoreLines : public PassInfoMixin<RestoreLines> {
public:
  explicit RestoreLines(std::shared_ptr<Lines> Noted)
      : Noted(std::move(Noted)) {}

  PreservedAnalyses run(Module &M, ModuleAnalysisManager &) {
    const unsigned Kind = M.getMDKindID(Note);
    for (Function &F : M)
      for (Instruction &I : instructions(F)) {
        const MDNode *Number = I.getMetadata(Kind);
        if (!Number)
          continue;
        const DebugLoc &Line =
            (*Noted)[mdconst::extract<ConstantInt>(Number->getOperand(0))
                         ->getZExtValue()];
        if (!hasLine(I) && isOf(F, Line))
          I.setDebugLoc(Line);
        I.setMetadata(Kind, nullptr);
      }
    Noted->clear();
    return PreservedAnalyses::all();
  }

private:
  /// Not of a function that was inlined since, whose place is not noted.
  static bool isOf(const Function &F, const DebugLoc &Line) {
    const auto *Scope = cast<DILocalScope>(Line.getInlinedAtScope());
    return F.getSubprogram() && Scope->getSubprogram() == F.getSubprogram();
  }

  std::shared_ptr<Lines> Noted;
};

} // namespace

void vorion::registerKeptLines(PassBuilder &PB,
                               std::function<bool(const Module &)> IsOurs) {
  const auto Noted = std::make_shared<Lines>();
  PB.registerPipelineStartEPCallback(
      [Noted, IsOurs](ModulePassManager &Passes, OptimizationLevel) {
        Passes.addPass(NoteLines(Noted, IsOurs));
      });
  PB.registerOptimizerLastEPCallback(
      [Noted](ModulePassManager &Passes, OptimizationLevel) {
        Passes.addPass(RestoreLines(Noted));
      });
}
