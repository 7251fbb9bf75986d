//===- DivergentJoins.cpp - values that depend on the way to a block ------===//
//
// Where two ways from a divergent branch meet first, a PHI node differs between
// lanes even if its operands do not. LLVM 19's uniformity analysis finds these
// blocks, but stops early: it takes what is left to hold one label when the
// last two labels that it passed on are the same, so if a side of the branch is
// three blocks long, the meeting may never be seen. This finds them in full.
//
//===----------------------------------------------------------------------===//

#include "Intrinsics.h"
#include "LowerDivergence.h"
#include "llvm/ADT/PostOrderIterator.h"
#include "llvm/Analysis/PostDominators.h"
#include "llvm/IR/CFG.h"
#include "llvm/IR/Instructions.h"

using namespace llvm;

namespace {

using Order = ReversePostOrderTraversal<Function *>;

/// The blocks that two ways from \p From, which part there, reach without
/// having met before: each block is labelled with the last such meeting, or the
/// first block of the way, and where two labels come together is another.
vorion::BlockSet meetings(BasicBlock *From, BasicBlock *Until, Order &Blocks) {
  vorion::BlockSet Region;
  for (BasicBlock *Way : successors(From))
    for (BasicBlock *Block : vorion::blocksBefore(Way, Until))
      Region.insert(Block);
  if (Until)
    Region.insert(Until);
  Region.erase(From);

  vorion::BlockSet Found;
  DenseMap<BasicBlock *, BasicBlock *> Labels;
  bool Changed = true;
  while (Changed) {
    Changed = false;
    for (BasicBlock *Block : Blocks) {
      if (!Region.count(Block) || Found.count(Block))
        continue;
      BasicBlock *Label = nullptr;
      for (BasicBlock *Before : predecessors(Block)) {
        BasicBlock *Incoming = Before == From ? Block : Labels.lookup(Before);
        // Nothing is passed on behind the block where all ways have met.
        if (!Incoming || Before == Until)
          continue;
        if (Label && Label != Incoming)
          Found.insert(Block);
        Label = Incoming;
      }
      if (Found.count(Block))
        Label = Block;
      Changed |= Label && Labels[Block] != Label;
      Labels[Block] = Label;
    }
  }
  return Found;
}

} // namespace

bool vorion::markDivergentJoins(Function &F, UniformityInfo &Uniform,
                                const PostDominatorTree &PostDominators) {
  unsigned Marker = divergentMarker(F.getContext());
  Order Blocks(&F);
  bool Changed = false;
  for (BasicBlock *Block : Blocks) {
    if (!branchesApart(Uniform, *Block))
      continue;
    const auto *Node = PostDominators.getNode(Block);
    BasicBlock *Until =
        Node && Node->getIDom() ? Node->getIDom()->getBlock() : nullptr;
    for (BasicBlock *Meeting : meetings(Block, Until, Blocks))
      for (PHINode &Phi : Meeting->phis())
        if (Uniform.isUniform(&Phi) && !Phi.hasMetadata(Marker) &&
            !Phi.hasConstantOrUndefValue()) {
          Phi.setMetadata(Marker, MDNode::get(F.getContext(), {}));
          Changed = true;
        }
  }
  return Changed;
}
