//===- DivergentBarriers.cpp - barriers that lanes may miss ---------------===//

#include "DivergentBarriers.h"
#include "UnifyExits.h"
#include "llvm/ADT/SmallPtrSet.h"
#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/PostDominators.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/Instructions.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/IR/Module.h"
#include "llvm/Support/Path.h"
#include "llvm/Transforms/Utils/Cloning.h"
#include "llvm/Transforms/Utils/PromoteMemToReg.h"

using namespace llvm;

namespace {

StringRef calledName(const Value *V) {
  const auto *Call = dyn_cast<CallBase>(V);
  const Function *Callee = Call ? Call->getCalledFunction() : nullptr;
  return Callee ? Callee->getName() : StringRef();
}

/// OpenCL C's names are mangled as Itanium C++.
bool isBarrierName(StringRef Name) {
  return Name == "vorion.vx_bar" || Name == "_Z7barrierj" ||
         Name.starts_with("_Z18work_group_barrierj");
}

bool isIdName(StringRef Name) {
  return StringSwitch<bool>(Name)
      .Case("vorion.vx_thread_id", true)
      .Cases("_Z12get_local_idj", "_Z13get_global_idj", true)
      .Cases("_Z19get_local_linear_idv", "_Z20get_global_linear_idv", true)
      .Default(false);
}

/// Whether a call of \p Callee comes to a barrier, itself or in what it calls.
bool hasBarrier(const Function *Callee,
                SmallPtrSetImpl<const Function *> &Seen) {
  if (!Callee || !Seen.insert(Callee).second)
    return false;
  if (isBarrierName(Callee->getName()))
    return true;
  return any_of(instructions(*Callee), [&](const Instruction &I) {
    const auto *Call = dyn_cast<CallBase>(&I);
    return Call && hasBarrier(Call->getCalledFunction(), Seen);
  });
}

/// Whether \p V is computed from a work-item's id, with nothing between that
/// could make it the same for all: memory, votes and other functions could.
bool dependsOnId(const Value *V, SmallPtrSetImpl<const Value *> &Seen) {
  const auto *I = dyn_cast<Instruction>(V);
  if (!I || !Seen.insert(I).second)
    return false;
  if (isIdName(calledName(I)))
    return true;
  const bool IsComputed =
      isa<BinaryOperator, UnaryOperator, CastInst, CmpInst, SelectInst, PHINode,
          FreezeInst, IntrinsicInst>(I) &&
      !I->mayReadOrWriteMemory();
  return IsComputed && any_of(I->operands(), [&](const Use &Operand) {
           return dependsOnId(Operand, Seen);
         });
}

const Value *conditionOf(const BasicBlock &Block) {
  const Instruction *End = Block.getTerminator();
  if (const auto *Branch = dyn_cast<BranchInst>(End))
    return Branch->isConditional() ? Branch->getCondition() : nullptr;
  const auto *Switch = dyn_cast<SwitchInst>(End);
  return Switch ? Switch->getCondition() : nullptr;
}

/// The conditions on the way to a block, and which of them depend on an id.
class Conditions {
public:
  /// \p WithBarrier: the blocks that come to one. \p MayReturn: whether a
  /// work-item that has returned misses none.
  Conditions(Function &F, SmallPtrSet<const BasicBlock *, 16> WithBarrier,
             bool MayReturn)
      : F(F), PostDominators(F), WithBarrier(std::move(WithBarrier)),
        MayReturn(MayReturn) {}

  /// The end of a block that decides by a work-item's id whether \p Block is
  /// reached, or null.
  const Instruction *dividing(const BasicBlock *Block) {
    SmallPtrSet<const BasicBlock *, 16> Seen;
    SmallVector<const BasicBlock *, 8> Pending{Block};
    while (!Pending.empty()) {
      const BasicBlock *Reached = Pending.pop_back_val();
      if (!Seen.insert(Reached).second)
        continue;
      for (const BasicBlock &Decider : F) {
        if (!decides(Decider, Reached))
          continue;
        SmallPtrSet<const Value *, 16> Values;
        if (dependsOnId(conditionOf(Decider), Values) &&
            !(MayReturn && onlyReturns(Decider, Reached)))
          return Decider.getTerminator();
        Pending.push_back(&Decider);
      }
    }
    return nullptr;
  }

private:
  /// Control dependence (Ferrante, Ottenstein, Warren 1987).
  bool decides(const BasicBlock &Decider, const BasicBlock *Reached) const {
    return conditionOf(Decider) && PostDominators.getNode(&Decider) &&
           !PostDominators.properlyDominates(Reached, &Decider) &&
           any_of(successors(&Decider), [&](const BasicBlock *Next) {
             return PostDominators.dominates(Reached, Next);
           });
  }

  /// Whether a work-item that does not go from \p Decider to \p Reached comes
  /// to no other barrier, nor to \p Decider again.
  bool onlyReturns(const BasicBlock &Decider, const BasicBlock *Reached) const {
    SmallPtrSet<const BasicBlock *, 16> Seen{Reached};
    SmallVector<const BasicBlock *, 8> Pending{&Decider};
    while (!Pending.empty())
      for (const BasicBlock *Next : successors(Pending.pop_back_val())) {
        if (!Seen.insert(Next).second)
          continue;
        if (Next == &Decider || WithBarrier.contains(Next))
          return false;
        Pending.push_back(Next);
      }
    return true;
  }

  Function &F;
  PostDominatorTree PostDominators;
  SmallPtrSet<const BasicBlock *, 16> WithBarrier;
  bool MayReturn;
};

std::string lineOf(const DebugLoc &Place) {
  return Place ? " in line " + std::to_string(Place.getLine()) : std::string();
}

/// "file:line:column: ", the file as it can be found from anywhere.
std::string placeOf(const DILocation *Place) {
  if (!Place)
    return {};
  SmallString<128> File;
  if (!sys::path::is_absolute(Place->getFilename()))
    File = Place->getDirectory();
  sys::path::append(File, Place->getFilename());
  return (File + ":" + Twine(Place->getLine()) + ":" +
          Twine(Place->getColumn()) + ": ")
      .str();
}

void promoteVariables(Function &F) {
  SmallVector<AllocaInst *, 16> Variables;
  for (Instruction &I : F.getEntryBlock())
    if (auto *Alloca = dyn_cast<AllocaInst>(&I);
        Alloca && isAllocaPromotable(Alloca))
      Variables.push_back(Alloca);
  if (Variables.empty())
    return;
  DominatorTree Dominators(F);
  PromoteMemToReg(Variables, Dominators);
}

} // namespace

std::vector<vorion::DivergentBarrier>
vorion::findDivergentBarriers(Function &F, bool MayReturn) {
  std::vector<DivergentBarrier> Found;
  std::vector<const CallBase *> Barriers;
  SmallPtrSet<const BasicBlock *, 16> WithBarrier;
  for (const Instruction &I : instructions(F)) {
    const auto *Call = dyn_cast<CallBase>(&I);
    SmallPtrSet<const Function *, 8> Seen{&F};
    if (!Call || !hasBarrier(Call->getCalledFunction(), Seen))
      continue;
    Barriers.push_back(Call);
    WithBarrier.insert(Call->getParent());
  }
  if (Barriers.empty())
    return Found;
  Conditions Ways(F, std::move(WithBarrier), MayReturn);
  for (const CallBase *Call : Barriers)
    if (const Instruction *Decision = Ways.dividing(Call->getParent()))
      Found.push_back(
          {Call, "a barrier that not all work-items of the group may reach: "
                 "the condition" +
                     lineOf(Decision->getDebugLoc()) +
                     " depends on the work-item's id"});
  return Found;
}

std::string vorion::divergentBarrierLog(const Module &M, StringRef Kind) {
  // Most programs are done here.
  if (none_of(M, [](const Function &F) { return isBarrierName(F.getName()); }))
    return {};
  std::string Log;
  const std::unique_ptr<Module> Copy = CloneModule(M);
  for (Function &F : *Copy) {
    if (F.isDeclaration())
      continue;
    promoteVariables(F);
    // A work-item that stays in an endless loop or traps misses what follows,
    // whatever decides about that.
    unifyExits(F, LoopInfo(DominatorTree(F)), /*Known=*/true,
               [](IRBuilder<> &Builder) { return Builder.getTrue(); });
    const bool IsKernel = F.hasMetadata("kernel_arg_addr_space");
    for (const DivergentBarrier &B : findDivergentBarriers(F, IsKernel)) {
      Log +=
          placeOf(B.Call->getDebugLoc()) + Kind.str() + ": " + B.Warning + "\n";
    }
  }
  return Log;
}
