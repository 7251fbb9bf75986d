//===- SimtGroupCode.cc - what a group does together ----------------------===//

#include "SimtGroupCode.h"

#include "Barrier.h"

#include <llvm/ADT/PostOrderIterator.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>

using namespace llvm;

namespace pocl {

namespace {

/// A word that is set for the whole group.
bool isGroupWord(const Value *Pointer) {
  const StringRef Name = Pointer->getName();
  return isa<GlobalVariable>(Pointer) &&
         any_of(ArrayRef<StringRef>{"_group_id_", "_num_groups_",
                                    "_local_size_", "_global_offset_",
                                    "_work_dim"},
                [&](StringRef Prefix) { return Name.starts_with(Prefix); });
}

/// Whether a value that is computed for a group's own sake may be computed by
/// work-items that would not come to it: nothing else happens by that.
bool mayBeComputedByAll(const Instruction &I) {
  if (const auto *Load = dyn_cast<LoadInst>(&I))
    return isGroupWord(Load->getPointerOperand());
  if (isa<AllocaInst, FreezeInst, PHINode>(I) || I.isTerminator() ||
      I.getType()->isVoidTy() || I.mayReadOrWriteMemory())
    return false;
  if (const auto *Call = dyn_cast<CallBase>(&I); Call && !isa<IntrinsicInst>(I))
    return false;
  // The sizes of a launch are not 0.
  if (I.getOpcode() == Instruction::UDiv || I.getOpcode() == Instruction::URem)
    if (const auto *By = dyn_cast<LoadInst>(I.getOperand(1)))
      if (By->getPointerOperand()->getName().starts_with("_local_size_"))
        return true;
  return isSafeToSpeculativelyExecute(&I);
}
} // namespace

/// The choice is the same for all if the whole group comes by the same way.
bool GroupCode::isKnownChoice(const PHINode &Phi) const {
  return all_of(Phi.blocks(), [&](BasicBlock *Before) {
    return goesOnTogether(Before) &&
           !Leaving.count(
               {Before, const_cast<BasicBlock *>(Phi.getParent())}) &&
           isKnown(Phi.getIncomingValueForBlock(Before));
  });
}

bool GroupCode::dropUnknown() {
  bool Changed = false;
  for (const Instruction &I : instructions(F)) {
    if (!Known.contains(&I))
      continue;
    const auto *Phi = dyn_cast<PHINode>(&I);
    const bool Is =
        passes(I.getParent()) &&
        (Phi ? isKnownChoice(*Phi)
             : isTold(&I) || all_of(I.operands(),
                                    [&](const Use &U) { return isKnown(U); }));
    if (!Is)
      Changed |= Known.erase(&I);
  }
  return Changed;
}

/// Whether the branch decides if \p Block is passed (Ferrante, Ottenstein,
/// Warren 1987).
bool GroupCode::dependsOn(const BasicBlock *Block,
                          const BasicBlock *Branch) const {
  return Ways.behind(Branch).size() > 1 &&
         (Block == Branch || !Ways.leadTo(Branch, Block)) &&
         any_of(Ways.behind(Branch), [&](const BasicBlock *Next) {
           return Ways.leadTo(Next, Block);
         });
}

void GroupCode::findDeciding() {
  Deciding.clear();
  SmallVector<const BasicBlock *, 16> Pending;
  for (const BasicBlock &Block : F)
    if (Barrier::hasBarrier(&Block))
      Pending.push_back(&Block);
  while (!Pending.empty()) {
    const BasicBlock *Block = Pending.pop_back_val();
    for (const BasicBlock &Branch : F)
      if (dependsOn(Block, &Branch) && Deciding.insert(&Branch).second)
        Pending.push_back(&Branch);
  }
}

/// What depends on a branch at which the group may part is not of the whole
/// group.
bool GroupCode::dropParted() {
  bool Changed = false;
  for (const BasicBlock &Branch : F)
    if (!goesOnTogether(&Branch))
      for (const BasicBlock &Block : F)
        if (passes(&Block) && dependsOn(&Block, &Branch))
          Changed |= Passed.erase(&Block);
  return Changed;
}

void GroupCode::findWays() {
  Ways = WaysToReturn(F, Leaving);
  findDeciding();
  Passed.clear();
  Known.clear();
  for (BasicBlock &Block : F) {
    if (Ways.leadTo(&F.getEntryBlock(), &Block) || !Ways.behind(&Block).empty())
      Passed.insert(&Block);
    for (Instruction &I : Block)
      if (isa<PHINode>(I) || mayBeComputedByAll(I) || isTold(&I))
        Known.insert(&I);
  }
  while (dropUnknown() || dropParted()) {
  }
}

/// Finds more ways on which work-items return, from branches at which they part
/// or, \p AlsoParted, from the first to which only some of them come.
bool GroupCode::findLeaving(bool AlsoParted) {
  const ReversePostOrderTraversal<Function *> Order(&F);
  bool Found = false;
  for (BasicBlock *Branch : Order) {
    const bool Parts =
        AlsoParted ? !goesOnTogether(Branch) : Differ.Branches.contains(Branch);
    if (!Parts || Ways.behind(Branch).size() < 2 ||
        !Ways.mayReachBarrier(Branch))
      continue;
    for (BasicBlock *Next : Ways.behind(Branch))
      if (!Ways.mayReachBarrier(Next))
        Found |= Leaving.insert({Branch, Next}).second;
    if (Found && AlsoParted)
      return true;
  }
  return Found;
}

/// Whether a way from \p From to \p Next passes the head of a loop in which
/// that lies. Who goes there at once would be in another round than the others,
/// or would enter the loop beside its head.
bool GroupCode::passesHead(const BasicBlock *From,
                           const BasicBlock *Next) const {
  SmallPtrSet<const BasicBlock *, 16> Seen{Next};
  SmallVector<const BasicBlock *, 16> Pending{From};
  while (!Pending.empty())
    for (const BasicBlock *Behind : Ways.behind(Pending.pop_back_val()))
      if (Seen.insert(Behind).second)
        Pending.push_back(Behind);
  for (const Cycle *C = Cycles.getCycle(Next); C; C = C->getParentCycle())
    if (any_of(C->getEntries(), [&](const BasicBlock *Head) {
          return Head != Next && Seen.contains(Head);
        }))
      return true;
  return false;
}

/// Whether those that join the group behind \p From come to it in the same
/// round of each loop, and have what it chooses there by the way on which it
/// comes.
bool GroupCode::mayJoinBehind(const BasicBlock *From) const {
  const BasicBlock *Next = nextOf(From);
  return Next && !passesHead(From, Next) &&
         all_of(Next->phis(), [&](const PHINode &Phi) {
           return !isKnown(&Phi) || Phi.getBasicBlockIndex(From) >= 0;
         });
}

/// What tells a value is a word, and all that have not returned come there.
bool GroupCode::mayBeTold(const Instruction &I) const {
  return I.getType()->isIntegerTy() &&
         I.getType()->getIntegerBitWidth() <= 32 && !isa<PHINode>(I) &&
         passes(I.getParent()) && !Differ.Values.contains(&I);
}

/// Has those values told from which all may compute \p V, as early ones as
/// possible: they stay the same in more rounds of a loop. False if not all are
/// to be had.
bool GroupCode::tell(Value *V) {
  auto *I = dyn_cast<Instruction>(V);
  if (isKnown(V) || !I || !Asked.insert(I).second)
    return isKnown(V) || I;
  const bool IsComputed = isa<PHINode>(I) || mayBeComputedByAll(*I);
  if (IsComputed && all_of(I->operands(), [&](Use &U) { return tell(U); }))
    return true;
  return mayBeTold(*I) && Told.insert(I).second;
}

/// Has more values told, of those on which the whole group's ways to barriers
/// depend: at the latest, the condition itself. False if all are known.
bool GroupCode::tellMore() {
  for (BasicBlock &Branch : F) {
    if (!passes(&Branch) || knowsWay(&Branch) || !mayLearnWay(&Branch))
      continue;
    const size_t Before = Told.size();
    tell(conditionOf(&Branch));
    auto *I = dyn_cast<Instruction>(conditionOf(&Branch));
    if (Told.size() == Before && I && mayBeTold(*I))
      Told.insert(I);
    if (Told.size() == Before)
      Untold.insert(&Branch);
    return true;
  }
  return false;
}

/// Keeps the first place where the group's way to a barrier is not known.
void GroupCode::findObstacle() {
  for (const BasicBlock &Branch : F)
    if (!Obstacle && Deciding.contains(&Branch) && !goesOnTogether(&Branch))
      Obstacle = Branch.getTerminator()->getDebugLoc();
  // A loop that each leaves on its own does not end for the group.
  for (BasicBlock &Branch : reverse(F))
    if (!Obstacle && Differ.Branches.contains(&Branch) &&
        Ways.behind(&Branch).empty())
      Obstacle = Branch.getTerminator()->getDebugLoc();
}

bool GroupCode::find() {
  findLeaving(/*AlsoParted=*/false);
  do {
    do
      findWays();
    while (tellMore());
    findObstacle();
  } while (findLeaving(/*AlsoParted=*/true));
  for (BasicBlock &Block : F)
    if ((Barrier::hasBarrier(&Block) ||
         isa<ReturnInst>(Block.getTerminator())) &&
        !passes(&Block))
      return false;
  for (const Edge &Way : Leaving)
    if (!mayJoinBehind(Way.first))
      return false;
  return all_of(afterReturns(), [&](const BasicBlock *Block) {
    if (!leadsAll(Block))
      return mayJoinBehind(Block);
    return all_of(behind(Block), [&](const BasicBlock *Next) {
      return passes(Next) || mayJoinBehind(Next);
    });
  });
}

BlockSet GroupCode::afterReturns() const {
  BlockSet Seen;
  SmallVector<BasicBlock *, 16> Pending;
  const auto Add = [&](BasicBlock *Block) {
    if (Seen.insert(Block).second)
      Pending.push_back(Block);
  };
  for (const Edge &Way : Leaving)
    if (BasicBlock *Next = nextOf(Way.first))
      Add(Next);
  while (!Pending.empty())
    for (BasicBlock *Next : behind(Pending.pop_back_val()))
      Add(Next);
  BlockSet Found;
  for (BasicBlock *Block : Seen)
    if (passes(Block))
      Found.insert(Block);
  return Found;
}
} // namespace pocl
