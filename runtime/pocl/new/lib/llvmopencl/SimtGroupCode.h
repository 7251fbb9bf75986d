//===- SimtGroupCode.h - what a group does together -----------------------===//

#ifndef POCL_SIMT_GROUP_CODE_H
#define POCL_SIMT_GROUP_CODE_H

#include "SimtReturns.h"
#include "SimtWays.h"

#include <llvm/ADT/SmallPtrSet.h>
#include <llvm/Analysis/CycleAnalysis.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/Instructions.h>

#include <set>

namespace pocl {

/// What a group does together when those that have returned count as if they
/// had not.
class GroupCode {
public:
  /// \p Coarse: branches that decide about no barrier do not count, although
  /// the whole group may take them alike. \p Tells: those that have not
  /// returned may tell the others values on which the group's way depends.
  /// \p Differ is that of \p F, and outlives this.
  GroupCode(llvm::Function &F, const Differences &Differ, bool Coarse,
            bool Tells)
      : F(F), Coarse(Coarse), Tells(Tells), Differ(Differ), Ways(F) {
    Cycles.compute(F);
  }

  /// False if the group's way to a barrier depends on what not all may compute.
  bool find();

  /// Then, the first place where it does; none if that is not known.
  const llvm::DebugLoc &obstacle() const { return Obstacle; }

  /// The ways on which work-items return before others.
  const std::set<Edge> &leaving() const { return Leaving; }

  /// Whether the whole group passes the block.
  bool passes(const llvm::BasicBlock *Block) const {
    return Passed.contains(Block);
  }

  /// Whether all may compute the value, and know it.
  bool isKnown(const llvm::Value *V) const {
    return llvm::isa<llvm::Argument>(V) ||
           (llvm::isa<llvm::Constant>(V) && !llvm::isa<llvm::UndefValue>(V)) ||
           Known.contains(V);
  }

  /// Whether all know the value because those that have not returned tell it.
  bool isTold(const llvm::Instruction *I) const { return Told.contains(I); }

  /// Whether the group goes on from the block in one direction.
  bool goesOnTogether(const llvm::BasicBlock *Block) const {
    return passes(Block) && (Ways.behind(Block).size() < 2 || knowsWay(Block) ||
                             mayLearnWay(Block));
  }

  /// Whether those that have returned know where the group goes on.
  bool leadsAll(const llvm::BasicBlock *Block) const {
    return passes(Block) && (!conditionOf(Block) || knowsWay(Block));
  }

  /// Where the group is together next, behind \p Block.
  llvm::BasicBlock *nextOf(const llvm::BasicBlock *Block) const {
    for (llvm::BasicBlock *Next : Ways.allBehind(Block))
      if (passes(Next))
        return Next;
    return nullptr;
  }

  /// The blocks of the group that work-items that have returned come to.
  BlockSet afterReturns() const;

  llvm::ArrayRef<llvm::BasicBlock *>
  behind(const llvm::BasicBlock *Block) const {
    return Ways.behind(Block);
  }

private:
  static llvm::Value *conditionOf(const llvm::BasicBlock *Block) {
    return decidingValue(*const_cast<llvm::BasicBlock *>(Block));
  }
  bool knowsWay(const llvm::BasicBlock *Branch) const {
    const llvm::Value *Condition = conditionOf(Branch);
    return Condition && isKnown(Condition) &&
           (!Coarse || Deciding.contains(Branch));
  }
  /// Whether those that have returned may be told.
  bool mayLearnWay(const llvm::BasicBlock *Branch) const {
    auto *Block = const_cast<llvm::BasicBlock *>(Branch);
    return Tells && Ways.behind(Branch).size() > 1 &&
           Deciding.contains(Branch) && conditionOf(Branch) &&
           !Differ.Branches.contains(Block) && !Untold.contains(Branch);
  }
  bool dependsOn(const llvm::BasicBlock *Block,
                 const llvm::BasicBlock *Branch) const;
  void findDeciding();
  void findWays();
  bool isKnownChoice(const llvm::PHINode &Phi) const;
  bool dropUnknown();
  bool dropParted();
  bool findLeaving(bool AlsoParted);
  bool passesHead(const llvm::BasicBlock *From,
                  const llvm::BasicBlock *Next) const;
  bool mayJoinBehind(const llvm::BasicBlock *From) const;
  bool mayBeTold(const llvm::Instruction &I) const;
  bool tell(llvm::Value *V);
  bool tellMore();
  void findObstacle();

  llvm::Function &F;
  const bool Coarse, Tells;
  const Differences &Differ;
  llvm::CycleInfo Cycles;
  WaysToReturn Ways;
  std::set<Edge> Leaving;
  /// The branches that decide whether the group comes to a barrier.
  llvm::SmallPtrSet<const llvm::BasicBlock *, 16> Deciding;
  llvm::SmallPtrSet<const llvm::BasicBlock *, 32> Passed;
  llvm::SmallPtrSet<const llvm::Value *, 32> Known;
  llvm::SmallPtrSet<const llvm::Instruction *, 4> Told;
  /// The branches of which nothing can be told.
  llvm::SmallPtrSet<const llvm::BasicBlock *, 4> Untold;
  /// The values that tell() has come to.
  llvm::SmallPtrSet<const llvm::Value *, 16> Asked;
  llvm::DebugLoc Obstacle;
};

} // namespace pocl

#endif
