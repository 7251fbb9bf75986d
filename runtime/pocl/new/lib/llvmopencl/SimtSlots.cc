//===- SimtSlots.cc - fewer values to keep across barriers ----------------===//

#include "SimtSlots.h"

#include "SimtBlocks.h"

#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/PostDominators.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/Instructions.h>

#include <set>
#include <vector>

using namespace llvm;

namespace pocl {

namespace {

/// Nothing but whole reads and writes of one type.
bool isSlot(const AllocaInst &Alloca) {
  Type *T = Alloca.getAllocatedType();
  if (Alloca.isArrayAllocation() || T->isAggregateType())
    return false;
  return all_of(Alloca.users(), [&](const User *U) {
    if (const auto *Load = dyn_cast<LoadInst>(U))
      return Load->isSimple() && Load->getType() == T;
    const auto *Store = dyn_cast<StoreInst>(U);
    return Store && Store->isSimple() &&
           Store->getPointerOperand() == &Alloca &&
           Store->getValueOperand()->getType() == T;
  });
}

/// Whether \p Accesses of a slot lie on a way from \p From, which dominates
/// \p To, to \p To that does not come by \p From again. The two are in
/// different blocks.
bool liesBetween(const Instruction *From, const Instruction *To,
                 ArrayRef<Instruction *> Accesses) {
  const BasicBlock *First = From->getParent(), *Last = To->getParent();
  std::set<const BasicBlock *> Whole;
  std::vector<const BasicBlock *> Pending(pred_begin(Last), pred_end(Last));
  while (!Pending.empty()) {
    const BasicBlock *Block = Pending.back();
    Pending.pop_back();
    if (Block != First && Whole.insert(Block).second)
      Pending.insert(Pending.end(), pred_begin(Block), pred_end(Block));
  }
  return any_of(Accesses, [&](const Instruction *I) {
    const BasicBlock *Block = I->getParent();
    return Whole.count(Block) || (Block == First && From->comesBefore(I)) ||
           (Block == Last && I->comesBefore(To));
  });
}

/// Reads where the value is used. The old ones stay, even if nobody needs them:
/// the uniformity analysis knows values by address.
void readLate(AllocaInst &Slot, const DominatorTree &Dominators,
              const ShareRegion &Share) {
  std::vector<Instruction *> Stores;
  std::vector<LoadInst *> Loads;
  for (User *U : Slot.users())
    if (auto *Load = dyn_cast<LoadInst>(U))
      Loads.push_back(Load);
    else
      Stores.push_back(cast<Instruction>(U));
  for (LoadInst *Load : Loads) {
    BasicBlock *From = Load->getParent();
    if (!Share(From, From))
      continue;
    std::vector<Use *> Uses;
    for (Use &U : Load->uses())
      Uses.push_back(&U);
    for (Use *U : Uses) {
      auto *User = cast<Instruction>(U->getUser());
      BasicBlock *To = User->getParent();
      if (!Share(To, To) || Share(From, To) || isa<PHINode>(User) ||
          !Dominators.dominates(Load, User) || liesBetween(Load, User, Stores))
        continue;
      Instruction *Late = Load->clone();
      Late->insertBefore(User);
      U->set(Late);
    }
  }
}

/// Writes where the value is computed.
void writeEarly(AllocaInst &Slot, const DominatorTree &Dominators,
                const PostDominatorTree &PostDominators, const LoopInfo &Loops,
                const ShareRegion &Share) {
  std::vector<Instruction *> Accesses;
  for (User *U : Slot.users())
    Accesses.push_back(cast<Instruction>(U));
  for (Instruction *I : Accesses) {
    auto *Store = dyn_cast<StoreInst>(I);
    auto *Value =
        Store ? dyn_cast<Instruction>(Store->getValueOperand()) : nullptr;
    if (!Value || isa<AllocaInst>(Value) || isa<PHINode>(Value))
      continue;
    BasicBlock *From = Value->getParent(), *To = Store->getParent();
    if (!Share(From, From) || !Share(To, To) || Share(From, To) ||
        Loops.getLoopFor(From) != Loops.getLoopFor(To) ||
        !Dominators.dominates(From, To) ||
        !PostDominators.dominates(To, From) ||
        liesBetween(Value, Store, Accesses))
      continue;
    Store->moveAfter(Value);
  }
}

} // namespace

void shortenSlots(Function &F, LoopInfo &Loops, const ShareRegion &Share,
                  const std::function<bool(AllocaInst *)> &IsKept) {
  if (hasIrreducibleLoops(F, Loops))
    return;
  const DominatorTree Dominators(F);
  const PostDominatorTree PostDominators(F);
  std::vector<AllocaInst *> Slots;
  for (BasicBlock &Block : F)
    for (Instruction &I : Block)
      if (auto *Alloca = dyn_cast<AllocaInst>(&I);
          Alloca && isSlot(*Alloca) && IsKept(Alloca))
        Slots.push_back(Alloca);
  for (AllocaInst *Slot : Slots) {
    readLate(*Slot, Dominators, Share);
    writeEarly(*Slot, Dominators, PostDominators, Loops, Share);
  }
}

bool readsApartFromWrites(AllocaInst *Slot, const ShareRegion &Share) {
  if (!isSlot(*Slot))
    return false;
  return none_of(Slot->users(), [&](User *Reader) {
    return isa<LoadInst>(Reader) && any_of(Slot->users(), [&](User *Writer) {
             return isa<StoreInst>(Writer) &&
                    Share(cast<Instruction>(Reader)->getParent(),
                          cast<Instruction>(Writer)->getParent());
           });
  });
}

} // namespace pocl
