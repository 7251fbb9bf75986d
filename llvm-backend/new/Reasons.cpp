//===- Reasons.cpp - why lanes disagree about a branch --------------------===//

#include "Reasons.h"
#include "Intrinsics.h"
#include "LowerDivergence.h"
#include "Vorion.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/IR/CFG.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/Instructions.h"

using namespace llvm;
using vorion::Reason;
using vorion::ReasonStep;

/// A value on the way, and what led to it.
struct vorion::Reasons::Visit {
  const Value *V;
  int From;        ///< the visit before, -1 of the first
  ReasonStep Step; ///< empty if there is nothing to say of it
};

std::string vorion::Reasons::source(const Value &V) const {
  const bool IsKernel = F.hasFnAttribute("vorion-kernel");
  if (const auto *A = dyn_cast<Argument>(&V))
    return ("argument " + Twine(A->getArgNo() + 1) +
            (A->hasName() ? " (" + A->getName() + ")" : "") + " of " +
            F.getName() + ", in which lanes may differ")
        .str();
  const auto *I = cast<Instruction>(&V);
  if (const IntrinsicRecord *Ours = findIntrinsic(I)) {
    if (Ours->Name == "vx_thread_id")
      return IsKernel ? "the work-item's id" : "the lane's number";
    return ("what " + Ours->Name + " gives each lane").str();
  }
  if (I->hasMetadata(divergentMarker(I->getContext())))
    return isa<PHINode>(I) ? "which way a lane came"
                           : "what is read anew on each way to it";
  if (const auto *Call = dyn_cast<CallBase>(I)) {
    const Function *Callee = Call->getCalledFunction();
    return Callee                ? ("the result of " + Callee->getName()).str()
           : Call->isInlineAsm() ? "inline assembly"
                                 : "the result of a call";
  }
  if (isa<AllocaInst>(I)) {
    // Inlining has appended to the name.
    const StringRef Name = I->getName().split('.').first;
    return ("the private variable" + (Name.empty() ? "" : " " + Name) +
            ", which each lane has for itself")
        .str();
  }
  if (isa<AtomicRMWInst, AtomicCmpXchgInst>(I))
    return "the result of an atomic operation";
  if (isa<LoadInst>(I))
    return "a volatile or atomic load";
  return "a value that may be undefined";
}

const BranchInst *vorion::Reasons::leaving(const Use &Operand) const {
  const auto *Made = dyn_cast<Instruction>(Operand.get());
  const auto *User = dyn_cast<Instruction>(Operand.getUser());
  if (!Made || !User)
    return nullptr;
  for (const Loop *L = Loops.getLoopFor(Made->getParent());
       L && !L->contains(User); L = L->getParentLoop()) {
    SmallVector<BasicBlock *, 4> Exiting;
    L->getExitingBlocks(Exiting);
    for (const BasicBlock *Block : Exiting)
      if (branchesApart(Uniform, *Block))
        return cast<BranchInst>(Block->getTerminator());
  }
  return nullptr;
}

const BranchInst *
vorion::Reasons::partingBefore(const BasicBlock &Block) const {
  SmallPtrSet<const BasicBlock *, 16> Seen;
  SmallVector<const BasicBlock *, 16> Pending(predecessors(&Block));
  for (size_t Next = 0; Next < Pending.size(); ++Next) {
    const BasicBlock *Before = Pending[Next];
    if (!Seen.insert(Before).second)
      continue;
    if (branchesApart(Uniform, *Before))
      return cast<BranchInst>(Before->getTerminator());
    append_range(Pending, predecessors(Before));
  }
  return nullptr;
}

Reason vorion::Reasons::of(const BranchInst &Branch) const {
  std::vector<Visit> Visits = {{Branch.getCondition(), -1, {}}};
  SmallPtrSet<const Value *, 32> Seen;
  for (int Now = 0; Now < int(Visits.size()); ++Now) {
    const Value *V = Visits[Now].V;
    if (!Seen.insert(V).second)
      continue;
    const auto *I = dyn_cast<Instruction>(V);
    // What lanes differ in anyway says more than that it may be undefined.
    const bool IsFrozen =
        isa<FreezeInst>(V) &&
        Uniform.isDivergent(cast<FreezeInst>(V)->getOperand(0));
    if (isSourceOfDivergence(V) && !IsFrozen) {
      Reason Why = {{source(*V), I ? I->getDebugLoc() : DebugLoc(), ""}};
      for (int At = Now; At >= 0; At = Visits[At].From)
        if (!Visits[At].Step.What.empty())
          Why.insert(Why.begin(), Visits[At].Step);
      return Why;
    }
    if (!I)
      continue;
    const auto Follow = [&](const Value *Next, ReasonStep Step) {
      Visits.push_back({Next, Now, std::move(Step)});
    };
    bool FromOperand = false;
    for (const Use &Operand : I->operands()) {
      if (Uniform.isDivergent(Operand.get())) {
        FromOperand = true;
        Follow(Operand.get(), isa<LoadInst>(I)
                                  ? ReasonStep{"a load", I->getDebugLoc(),
                                               "whose address follows from"}
                                  : ReasonStep());
      } else if (const BranchInst *Exit = Uniform.isDivergentUse(Operand)
                                              ? leaving(Operand)
                                              : nullptr) {
        FromOperand = true;
        Follow(Exit->getCondition(),
               {"when a lane leaves the loop", Exit->getDebugLoc(),
                "which follows from"});
      }
    }
    const BranchInst *Parting = isa<PHINode>(I) && !FromOperand
                                    ? partingBefore(*I->getParent())
                                    : nullptr;
    if (Parting)
      Follow(Parting->getCondition(),
             {"the way that a lane takes", Parting->getDebugLoc(),
              "which follows from"});
  }
  return {};
}

std::string vorion::fileOf(const DebugLoc &Place) {
  return Place ? Place->getFilename().str() : std::string();
}

std::string vorion::sentence(const Reason &Why, const DebugLoc &At) {
  if (Why.empty())
    return "lanes may differ in its condition";
  std::string Text = "its condition follows from ";
  for (const ReasonStep &Step : Why) {
    Text += Step.What;
    if (Step.Place && Step.Place.getLine())
      Text += (fileOf(Step.Place) == fileOf(At)
                   ? " in line "
                   : " at " + fileOf(Step.Place) + ":") +
              std::to_string(Step.Place.getLine());
    if (!Step.Next.empty())
      Text += ", " + Step.Next + " ";
  }
  return Text;
}
