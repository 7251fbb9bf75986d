#include "SimtReturns.h"

#include "Barrier.h"
#include "SimtWays.h"

#include <llvm/Analysis/CycleAnalysis.h>
#include <llvm/Analysis/TargetTransformInfo.h>
#include <llvm/Analysis/TargetTransformInfoImpl.h>
#include <llvm/Analysis/UniformityAnalysis.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/Module.h>
#include <llvm/IR/PassInstrumentation.h>
#include <llvm/IR/PassManager.h>

#include <vector>

using namespace llvm;

namespace pocl {

namespace {

/// An intrinsic of ours that gives all lanes the same.
bool isSameForLanes(StringRef Name) {
  return Name.starts_with("vorion.vx_vote_") || Name == "vorion.vx_uniform" ||
         Name == "vorion.vx_core_id";
}

/// Tells LLVM's uniformity analysis where work-items begin to differ. Loads are
/// no such place: what differs is their address.
class WorkitemValues : public TargetTransformInfoImplCRTPBase<WorkitemValues> {
public:
  explicit WorkitemValues(const DataLayout &Layout)
      : TargetTransformInfoImplCRTPBase<WorkitemValues>(Layout) {}

  bool hasBranchDivergence(const Function * = nullptr) const { return true; }

  bool isSourceOfDivergence(const Value *V) const {
    if (const auto *Load = dyn_cast<LoadInst>(V))
      return isWorkitemId(Load->getPointerOperand()) || Load->isVolatile() ||
             Load->isAtomic();
    const StringRef Name = nameOfCalled(V);
    return isa<AllocaInst, AtomicRMWInst, AtomicCmpXchgInst>(V) ||
           (Name.starts_with("vorion.") && !isSameForLanes(Name));
  }

  bool isAlwaysUniform(const Value *V) const {
    return isSameForLanes(nameOfCalled(V));
  }

private:
  static bool isWorkitemId(const Value *Pointer) {
    const StringRef Name = Pointer->getName();
    return isa<GlobalVariable>(Pointer) &&
           (Name.starts_with("_local_id_") || Name.starts_with("_global_id_"));
  }
};

/// What a way may come to before \p Meeting: a barrier, or a place behind all
/// barriers.
struct Prospect {
  bool Barrier = false, End = false;
};

Prospect prospectOf(BasicBlock *First, BasicBlock *Meeting,
                    const WaysToReturn &Ways) {
  Prospect Found;
  BlockSet Seen{First};
  SmallVector<BasicBlock *, 16> Pending{First};
  while (!Pending.empty()) {
    BasicBlock *Block = Pending.pop_back_val();
    if (!Ways.mayReachBarrier(Block))
      Found.End = true;
    else if (Block != Meeting && Barrier::hasBarrier(Block))
      Found.Barrier = true;
    else if (Block != Meeting)
      for (BasicBlock *Next : Ways.behind(Block))
        if (Seen.insert(Next).second)
          Pending.push_back(Next);
  }
  return Found;
}

/// Whether one way of the branch may come to the kernel's end while another
/// comes to a barrier.
bool partsForGood(BasicBlock &Branch, const WaysToReturn &Ways) {
  if (Ways.behind(&Branch).size() < 2)
    return false;
  BasicBlock *Meeting = Ways.meetingOf(&Branch);
  BlockSet ToBarrier, ToEnd;
  for (BasicBlock *Next : Ways.behind(&Branch)) {
    const Prospect Found = prospectOf(Next, Meeting, Ways);
    if (Found.Barrier)
      ToBarrier.insert(Next);
    if (Found.End)
      ToEnd.insert(Next);
  }
  return any_of(ToEnd, [&](BasicBlock *Next) {
    return ToBarrier.size() > ToBarrier.count(Next);
  });
}

} // namespace

Differences differencesIn(Function &F) {
  FunctionAnalysisManager Analyses;
  Analyses.registerPass([] { return PassInstrumentationAnalysis(); });
  Analyses.registerPass([] { return DominatorTreeAnalysis(); });
  Analyses.registerPass([] { return CycleAnalysis(); });
  Analyses.registerPass([] {
    return TargetIRAnalysis([](const Function &Of) {
      return TargetTransformInfo(
          WorkitemValues(Of.getParent()->getDataLayout()));
    });
  });
  UniformityInfo Uniformity = UniformityInfoAnalysis().run(F, Analyses);
  Differences Found;
  for (BasicBlock &Block : F) {
    if (Uniformity.hasDivergentTerminator(Block))
      Found.Branches.insert(&Block);
    for (const Instruction &I : Block)
      if (Uniformity.isDivergent(&I))
        Found.Values.insert(&I);
  }
  return Found;
}

BasicBlock *returnBeforeBarrier(Function &F) {
  const WaysToReturn Ways(F);
  const BlockSet Branches = differencesIn(F).Branches;
  const auto Found = find_if(F, [&](BasicBlock &Block) {
    return Branches.contains(&Block) && partsForGood(Block, Ways);
  });
  return Found == F.end() ? nullptr : &*Found;
}

} // namespace pocl
