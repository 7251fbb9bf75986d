//===- LowerDivergence.cpp - divergence lowering, step by step ------------===//
//
// The last pass over IR: nothing may move a branch after it. In order:
//   1. refuse what has no meaning for a warp;
//   2. branches only: switches become trees of branches;
//   3. no irreducible cycles, one return that every path leads to;
//   4. tests that lanes agree in are marked, and short sides of divergent
//      branches become selects;
//   5. loops that lanes leave apart get one exit, in the latch;
//   6. blocks that several paths reach are executed once, unless short;
//   7. splits, joins and predicates.
// Lanes reconverge at the immediate post-dominator, however paths cross before
// it: what is short may stay executed once for each path.
//
//===----------------------------------------------------------------------===//

#include "LowerDivergence.h"
#include "DivergentBarriers.h"
#include "Intrinsics.h"
#include "RISCVSubtarget.h"
#include "Remarks.h"
#include "UnifyExits.h"
#include "Vorion.h"
#include "llvm/ADT/DepthFirstIterator.h"
#include "llvm/Analysis/AssumptionCache.h"
#include "llvm/Analysis/CycleAnalysis.h"
#include "llvm/Analysis/LazyValueInfo.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/PostDominators.h"
#include "llvm/Analysis/ScalarEvolution.h"
#include "llvm/Analysis/TargetLibraryInfo.h"
#include "llvm/Analysis/TargetTransformInfo.h"
#include "llvm/CodeGen/TargetPassConfig.h"
#include "llvm/IR/DiagnosticInfo.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/Instructions.h"
#include "llvm/IR/PassInstrumentation.h"
#include "llvm/Pass.h"
#include "llvm/Target/TargetMachine.h"
#include "llvm/Transforms/Utils/FixIrreducible.h"
#include "llvm/Transforms/Utils/LCSSA.h"
#include "llvm/Transforms/Utils/LoopSimplify.h"
#include "llvm/Transforms/Utils/LowerSwitch.h"
#include "llvm/Transforms/Utils/Mem2Reg.h"

using namespace llvm;

void vorion::refuse(const Instruction &At, const Twine &Why) {
  At.getContext().diagnose(
      DiagnosticInfoUnsupported(*At.getFunction(), Why, At.getDebugLoc()));
}

bool vorion::branchesApart(UniformityInfo &Uniform, const BasicBlock &Block) {
  // A return of a value that lanes differ in is a divergent terminator, too.
  const auto *Branch = dyn_cast<BranchInst>(Block.getTerminator());
  return Branch && Branch->isConditional() &&
         Uniform.hasDivergentTerminator(Block);
}

vorion::BlockSet vorion::blocksBefore(BasicBlock *From, BasicBlock *Until) {
  df_iterator_default_set<BasicBlock *, 16> Seen;
  if (Until)
    Seen.insert(Until);
  for ([[maybe_unused]] BasicBlock *Block : depth_first_ext(From, Seen))
    ;
  if (Until)
    Seen.erase(Until);
  return Seen;
}

namespace {

/// Declares wrong calls of our intrinsics to be errors: selection takes their
/// operands as they come.
bool checkIntrinsicCall(const CallBase &Call) {
  const Function *Callee = Call.getCalledFunction();
  if (!Callee || !Callee->getName().starts_with(vorion::IntrinsicPrefix))
    return true;
  const vorion::IntrinsicRecord *I = vorion::findIntrinsic(Callee->getName());
  if (!I) {
    vorion::refuse(Call, "there is no intrinsic " + Callee->getName());
    return false;
  }
  Type *Int = Type::getInt32Ty(Call.getContext());
  Type *Result = Call.getType();
  if (Call.arg_size() == I->Inputs &&
      all_of(Call.args(), [&](const Use &A) { return A->getType() == Int; }) &&
      (I->HasResult ? Result == Int : Result->isVoidTy()))
    return true;
  vorion::refuse(Call, "wrong types in a call of " + I->Name +
                           ", expected them as in vorion.h");
  return false;
}

/// Without optimisation a pointer to a function is kept in the lane's stack,
/// where nothing tells that vx_uniform was its origin.
bool callsThroughVariable(Function &F) {
  return any_of(instructions(F), [](Instruction &I) {
    const auto *Call = dyn_cast<CallBase>(&I);
    return Call && Call->isIndirectCall() &&
           isa<LoadInst>(Call->getCalledOperand());
  });
}

/// False if there is what cannot be handled.
bool checkCode(Function &F, FunctionAnalysisManager &Analyses) {
  bool Good = true;
  auto fail = [&](const Instruction &I, const Twine &Why) {
    vorion::refuse(I, Why);
    Good = false;
  };
  auto &Uniform = Analyses.getResult<UniformityInfoAnalysis>(F);
  for (Instruction &I : make_early_inc_range(instructions(F))) {
    if (isa<IndirectBrInst, CallBrInst>(I))
      fail(I, "a computed jump: lanes cannot be kept together across it");
    else if (isa<InvokeInst, ResumeInst>(I))
      fail(I, "exceptions: the machine has none");
    auto *Call = dyn_cast<CallBase>(&I);
    if (!Call)
      continue;
    if (Call->isMustTailCall() && Call->isIndirectCall() &&
        Uniform.isDivergent(Call->getCalledOperand()))
      fail(I, "a tail call through a pointer in which lanes may differ; use "
              "vx_uniform if they cannot");
    if (!checkIntrinsicCall(*Call)) {
      // Selection would stop at it before the next error is found.
      Good = false;
      if (!Call->getType()->isVoidTy())
        Call->replaceAllUsesWith(PoisonValue::get(Call->getType()));
      Call->eraseFromParent();
    }
  }
  return Good;
}

/// Branches whose sides are the same block would have no side to split.
void removeSameTargetBranches(Function &F) {
  for (BasicBlock &Block : F) {
    auto *Branch = dyn_cast<BranchInst>(Block.getTerminator());
    if (!Branch || !Branch->isConditional() ||
        Branch->getSuccessor(0) != Branch->getSuccessor(1))
      continue;
    BasicBlock *Target = Branch->getSuccessor(0);
    Target->removePredecessor(&Block, /*KeepOneInputPHIs=*/true);
    BranchInst::Create(Target, Branch->getIterator());
    Branch->eraseFromParent();
  }
}

void alignLoops(Function &F, FunctionAnalysisManager &Analyses) {
  // Each round knows more to be divergent, or has fewer loops to merge.
  bool Again = true;
  while (Again) {
    Analyses.invalidate(F, LoopSimplifyPass().run(F, Analyses));
    Analyses.invalidate(F, LCSSAPass().run(F, Analyses));
    auto mark = [&](auto Function) {
      return Function(F, Analyses.getResult<UniformityInfoAnalysis>(F),
                      Analyses.getResult<PostDominatorTreeAnalysis>(F));
    };
    Again = mark(vorion::markDivergentJoins) ||
            vorion::mergeLoopExits(F, Analyses) ||
            vorion::reconvergeEarly(F, Analyses) ||
            mark(vorion::markRepeatedBlocks);
    if (Again)
      Analyses.invalidate(F, PreservedAnalyses::none());
  }
}

/// What is said of code that stays as it is.
void remarkKept(Function &F, UniformityInfo &Uniform) {
  for (const Instruction &I : instructions(F)) {
    const auto *Branch = dyn_cast<BranchInst>(&I);
    const vorion::IntrinsicRecord *Ours = vorion::findIntrinsic(&I);
    if (!I.getDebugLoc())
      continue;
    if (Branch && Branch->isConditional() &&
        !vorion::branchesApart(Uniform, *Branch->getParent()))
      vorion::remark<OptimizationRemarkAnalysis>(
          vorion::remarks::Uniform, "Branch", I,
          [] { return "all lanes agree in this condition: no vx_split"; });
    else if (Ours && Ours->Name == "vx_bar")
      vorion::remark<OptimizationRemarkAnalysis>(
          vorion::remarks::Barrier, "Barrier", I, [] {
            return "vx_bar: the warps of the group wait for each other here";
          });
  }
}

void remarkSwitches(Function &F) {
  for (const Instruction &I : instructions(F))
    if (const auto *Switch = dyn_cast<SwitchInst>(&I))
      vorion::remark<OptimizationRemark>(
          vorion::remarks::Switch, "Branches", I, [&] {
            return "switch of " + std::to_string(Switch->getNumCases()) +
                   " cases made a tree of branches: a jump table cannot be "
                   "split";
          });
}

class LowerDivergence final : public FunctionPass {
public:
  static char ID;
  LowerDivergence() : FunctionPass(ID) {}
  StringRef getPassName() const override {
    return "Vorion divergence lowering";
  }
  void getAnalysisUsage(AnalysisUsage &AU) const override {
    AU.addRequired<TargetPassConfig>();
  }
  bool runOnFunction(Function &F) override;

private:
  static void registerAnalyses(FunctionAnalysisManager &Analyses,
                               const TargetMachine &TM);
};

char LowerDivergence::ID = 0;
// The name is for -print-after and -stop-after.
const RegisterPass<LowerDivergence> Registration("vorion-lower-divergence",
                                                 "Vorion divergence lowering");

/// Nobody asks any more what vx_uniform vouches for; selection makes better
/// branches without it.
void removePromises(Function &F) {
  for (Instruction &I : make_early_inc_range(instructions(F))) {
    const vorion::IntrinsicRecord *Ours = vorion::findIntrinsic(&I);
    if (!Ours || Ours->Name != "vx_uniform")
      continue;
    I.replaceAllUsesWith(I.getOperand(0));
    I.eraseFromParent();
  }
}

} // namespace

bool LowerDivergence::runOnFunction(Function &F) {
  const auto &TM = getAnalysis<TargetPassConfig>().getTM<TargetMachine>();
  const auto &Subtarget = TM.getSubtarget<RISCVSubtarget>(F);
  if (!Subtarget.hasVendorXVortex())
    return false;
  vorion::markAtomicPlaces(F);
  FunctionAnalysisManager Analyses;
  registerAnalyses(Analyses, TM);
  if (vorion::lowerDivergence(F, Analyses, Subtarget,
                              TM.getOptLevel() != CodeGenOptLevel::None))
    removePromises(F);
  return true;
}

bool vorion::lowerDivergence(Function &F, FunctionAnalysisManager &Analyses,
                             const RISCVSubtarget &Subtarget, bool Optimize) {
  auto run = [&](auto Pass) { Analyses.invalidate(F, Pass.run(F, Analyses)); };
  auto changed = [&] { Analyses.invalidate(F, PreservedAnalyses::none()); };

  remarkSwitches(F);
  run(LowerSwitchPass());
  removeSameTargetBranches(F);
  changed();
  if (callsThroughVariable(F))
    run(PromotePass());
  if (!checkCode(F, Analyses))
    return false;
  if (vorion::callPointersInTurn(F,
                                 Analyses.getResult<UniformityInfoAnalysis>(F)))
    changed();
  vorion::trapAtUnreachable(F);
  run(FixIrreduciblePass());
  vorion::unifyExits(F, Analyses.getResult<LoopAnalysis>(F), /*Known=*/true,
                     [](IRBuilder<> &Builder) { return Builder.getTrue(); });
  changed();
  for (const vorion::DivergentBarrier &B :
       vorion::findDivergentBarriers(F, /*MayReturn=*/false))
    F.getContext().diagnose(DiagnosticInfoUnsupported(
        F, B.Warning, B.Call->getDebugLoc(), DS_Warning));

  const bool Selects = Optimize && !F.hasOptNone();
  auto select = [&] {
    bool Any = false;
    for (; vorion::selectShortSides(F, Analyses, Subtarget); Any = true)
      changed();
    return Any;
  };
  if (Selects) {
    if (vorion::raiseInvariants(F, Analyses))
      changed();
    while (vorion::markUniformTests(F, Analyses))
      changed();
    select();
    vorion::remarkSidesKept(F, Analyses, Subtarget);
  }

  auto &Uniform = Analyses.getResult<UniformityInfoAnalysis>(F);
  remarkKept(F, Uniform);
  if (none_of(F,
              [&](BasicBlock &B) { return vorion::branchesApart(Uniform, B); }))
    return true;
  // Outlining would move splits, joins and their tokens into functions of
  // their own, where VerifySplits.cpp cannot follow them.
  F.addFnAttr("nooutline");
  // Behind a hub, what led to a shared block may be a short side.
  do
    alignLoops(F, Analyses);
  while (Selects && select());
  vorion::insertSplits(F, Analyses);
  return true;
}

void LowerDivergence::registerAnalyses(FunctionAnalysisManager &Analyses,
                                       const TargetMachine &TM) {
  Analyses.registerPass([&] { return TM.getTargetIRAnalysis(); });
  Analyses.registerPass([] { return PassInstrumentationAnalysis(); });
  Analyses.registerPass([] { return AssumptionAnalysis(); });
  Analyses.registerPass([] { return CycleAnalysis(); });
  Analyses.registerPass([] { return DominatorTreeAnalysis(); });
  Analyses.registerPass([] { return LazyValueAnalysis(); });
  Analyses.registerPass([] { return LoopAnalysis(); });
  Analyses.registerPass([] { return PostDominatorTreeAnalysis(); });
  Analyses.registerPass([] { return ScalarEvolutionAnalysis(); });
  Analyses.registerPass([] { return TargetLibraryAnalysis(); });
  Analyses.registerPass([] { return UniformityInfoAnalysis(); });
}

std::vector<Pass *> vorion::createDivergencePasses() {
  return {new LowerDivergence()};
}
