//===- AtomicPlaces.cpp - which plain instructions are atomic accesses ----===//
//
// An atomic load or store of a word is an ordinary lw or sw, so no tool that
// sees instructions alone can tell it from an access that races. The address of
// each goes into the section vorion_atomics (docs/abi.md), by LLVM's
// !pcsections.
//
// A load is atomic, too, if only a compare-exchange of the same place judges
// its value: it fails where the value was not the last one. Such are the loads
// in front of loops that stand for atomics which the machine does not have, and
// in those that programs write themselves.
//
//===----------------------------------------------------------------------===//

#include "LowerDivergence.h"
#include "llvm/ADT/SmallVector.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/Instructions.h"
#include "llvm/IR/MDBuilder.h"

using namespace llvm;

namespace {

constexpr StringLiteral Section = "vorion_atomics";

/// Loads of \p Place that \p Value is, whatever way control came.
void collectLoads(Value *Expected, const Value *Place,
                  SmallVectorImpl<Instruction *> &Loads) {
  SmallPtrSet<Value *, 8> Seen;
  SmallVector<Value *, 8> Left{Expected};
  while (!Left.empty()) {
    Value *V = Left.pop_back_val();
    if (!Seen.insert(V).second)
      continue;
    if (auto *Load = dyn_cast<LoadInst>(V)) {
      if (Load->getPointerOperand()->stripPointerCasts() == Place)
        Loads.push_back(Load);
    } else if (auto *Phi = dyn_cast<PHINode>(V)) {
      append_range(Left, Phi->incoming_values());
    } else if (isa<BitCastInst, FreezeInst>(V)) {
      Left.push_back(cast<Instruction>(V)->getOperand(0));
    }
  }
}

} // namespace

bool vorion::markAtomicPlaces(Function &F) {
  SmallVector<Instruction *, 8> Atomic;
  for (Instruction &I : instructions(F)) {
    if (isa<LoadInst, StoreInst>(I) && I.isAtomic())
      Atomic.push_back(&I);
    else if (auto *Exchange = dyn_cast<AtomicCmpXchgInst>(&I))
      collectLoads(Exchange->getCompareOperand(),
                   Exchange->getPointerOperand()->stripPointerCasts(), Atomic);
  }
  if (Atomic.empty())
    return false;
  MDNode *Places = MDBuilder(F.getContext()).createPCSections({{Section, {}}});
  for (Instruction *I : Atomic)
    I->setMetadata(LLVMContext::MD_pcsections, Places);
  return true;
}
