#include "SimtGuards.h"

#include "Barrier.h"
#include "SimtReturns.h"
#include "SimtWays.h"

#include <llvm/ADT/PostOrderIterator.h>
#include <llvm/ADT/SetVector.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>
#include <llvm/Transforms/Utils/Cloning.h>
#include <llvm/Transforms/Utils/Local.h>
#include <llvm/Transforms/Utils/PromoteMemToReg.h>

using namespace llvm;

namespace pocl {

namespace {

/// All ways end at one return, and a barrier is alone in its block.
void separateReturnAndBarriers(Function &F) {
  SmallVector<BasicBlock *, 4> Returning;
  SmallVector<Instruction *, 8> Barriers;
  for (Instruction &I : instructions(F))
    if (isa<Barrier>(&I))
      Barriers.push_back(&I);
    else if (isa<ReturnInst>(&I))
      Returning.push_back(I.getParent());
  auto *Return = BasicBlock::Create(F.getContext(), "return", &F);
  ReturnInst::Create(F.getContext(), Return);
  for (BasicBlock *Block : Returning)
    ReplaceInstWithInst(Block->getTerminator(), BranchInst::Create(Return));
  for (Instruction *I : Barriers)
    SplitBlock(SplitBlock(I->getParent(), I), I->getNextNode());
}

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

/// What a group does together when those that have returned count as if they
/// had not.
class GroupCode {
public:
  /// \p Coarse: branches that decide about no barrier do not count, although
  /// the whole group may take them alike.
  GroupCode(Function &F, bool Coarse) : F(F), Coarse(Coarse), Ways(F) {}

  /// False if the group's way to a barrier depends on what not all may compute.
  bool find();

  /// The ways on which work-items return before others.
  const std::set<Edge> &leaving() const { return Leaving; }

  /// Whether the whole group passes the block.
  bool passes(const BasicBlock *Block) const { return Passed.contains(Block); }

  /// Whether all may compute the value, and know it.
  bool isKnown(const Value *V) const {
    return isa<Argument>(V) || (isa<Constant>(V) && !isa<UndefValue>(V)) ||
           Known.contains(V);
  }

  /// Whether the group goes on from the block in one direction.
  bool goesOnTogether(const BasicBlock *Block) const {
    Value *Condition = decidingValue(*const_cast<BasicBlock *>(Block));
    return passes(Block) &&
           (Ways.behind(Block).size() < 2 ||
            (Condition && isKnown(Condition) && counts(Block)));
  }

  /// Whether those that have returned know where the group goes on.
  bool leadsAll(const BasicBlock *Block) const {
    const Value *Condition = decidingValue(*const_cast<BasicBlock *>(Block));
    return passes(Block) &&
           (!Condition || (isKnown(Condition) && counts(Block)));
  }

  /// Where the group is together next, behind \p Block.
  BasicBlock *nextOf(const BasicBlock *Block) const {
    for (BasicBlock *Next : Ways.allBehind(Block))
      if (passes(Next))
        return Next;
    return nullptr;
  }

  /// The blocks of the group that work-items that have returned come to.
  BlockSet afterReturns() const;

  ArrayRef<BasicBlock *> behind(const BasicBlock *Block) const {
    return Ways.behind(Block);
  }

private:
  bool counts(const BasicBlock *Branch) const {
    return !Coarse || Deciding.contains(Branch);
  }
  bool dependsOn(const BasicBlock *Block, const BasicBlock *Branch) const;
  void findDeciding();
  void findWays();
  bool isKnownChoice(const PHINode &Phi) const;
  bool dropUnknown();
  bool dropParted();
  bool findLeaving(bool AlsoParted);
  bool mayJoinBehind(const BasicBlock *From) const;

  Function &F;
  const bool Coarse;
  WaysToReturn Ways;
  std::set<Edge> Leaving;
  /// The branches that decide whether the group comes to a barrier.
  SmallPtrSet<const BasicBlock *, 16> Deciding;
  SmallPtrSet<const BasicBlock *, 32> Passed;
  SmallPtrSet<const Value *, 32> Known;
};

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
             : all_of(I.operands(), [&](const Use &U) { return isKnown(U); }));
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
      if (isa<PHINode>(I) || mayBeComputedByAll(I))
        Known.insert(&I);
  }
  while (dropUnknown() || dropParted()) {
  }
}

/// Finds more ways on which work-items return, from branches at which they part
/// or, \p AlsoParted, from the first to which only some of them come.
bool GroupCode::findLeaving(bool AlsoParted) {
  const BlockSet Parting = AlsoParted ? BlockSet() : branchesOfSome(F);
  const ReversePostOrderTraversal<Function *> Order(&F);
  bool Found = false;
  for (BasicBlock *Branch : Order) {
    const bool Parts =
        AlsoParted ? !goesOnTogether(Branch) : Parting.contains(Branch);
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

/// Whether those that join the group behind \p From have what it chooses there
/// by the way on which it comes.
bool GroupCode::mayJoinBehind(const BasicBlock *From) const {
  const BasicBlock *Next = nextOf(From);
  return Next && all_of(Next->phis(), [&](const PHINode &Phi) {
           return !isKnown(&Phi) || Phi.getBasicBlockIndex(From) >= 0;
         });
}

bool GroupCode::find() {
  findLeaving(/*AlsoParted=*/false);
  do
    findWays();
  while (findLeaving(/*AlsoParted=*/true));
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

/// Leads all ways back of a loop through one block. Otherwise LLVM makes a loop
/// of its own of the way on which those go back that have returned: they change
/// nothing there.
void joinWaysBack(Function &F) {
  const LoopInfo Loops{DominatorTree(F)};
  std::vector<std::pair<BasicBlock *, SmallVector<BasicBlock *, 8>>> Found;
  for (const Loop *L : Loops.getLoopsInPreorder()) {
    SmallVector<BasicBlock *, 8> Latches;
    L->getLoopLatches(Latches);
    if (Latches.size() > 1)
      Found.push_back({L->getHeader(), Latches});
  }
  for (const auto &[Head, Latches] : Found)
    SplitBlockPredecessors(Head, Latches, ".back");
}

/// Rewrites a kernel by what GroupCode knows.
class Guards {
public:
  Guards(Function &F, const GroupCode &Code) : F(F), Code(Code) {}
  void add();

private:
  BasicBlock *create(const char *Name) const {
    return BasicBlock::Create(F.getContext(), Name, &F);
  }
  void keepInSlots();
  void lead(const Edge &Way, BasicBlock *Meeting);
  BasicBlock *copyTail(BasicBlock *First, BasicBlock *From, BasicBlock *End);
  void guard(BasicBlock *Block, BasicBlock *Next);
  void skip(BasicBlock *Block);
  void join(BasicBlock *From, BasicBlock *Like, BasicBlock *Next);
  Value *isGone(IRBuilder<> &Builder) const {
    return Builder.CreateLoad(Builder.getInt1Ty(), Gone, "is_gone");
  }

  Function &F;
  const GroupCode &Code;
  AllocaInst *Gone = nullptr;
  std::vector<AllocaInst *> Slots;
};

/// Work-items that have returned pass by what computes values of their own. So
/// these get places, until all ways stand.
void Guards::keepInSlots() {
  const auto Keep = [this](AllocaInst *Slot) {
    if (Slot)
      Slots.push_back(Slot);
  };
  SmallVector<PHINode *, 16> Choices;
  for (Instruction &I : instructions(F))
    if (auto *Phi = dyn_cast<PHINode>(&I); Phi && !Code.isKnown(Phi))
      Choices.push_back(Phi);
  for (PHINode *Phi : Choices)
    Keep(DemotePHIToStack(Phi));
  SmallVector<Instruction *, 32> Leaving;
  for (BasicBlock &Block : F)
    for (Instruction &I : Block)
      if (I.isUsedOutsideOfBlock(&Block) && !Code.isKnown(&I) &&
          !isa<AllocaInst>(I))
        Leaving.push_back(&I);
  for (Instruction *I : Leaving)
    Keep(DemoteRegToStack(*I));
}

/// Makes the choices at \p Next for the new way from \p From, as for \p Like.
void Guards::join(BasicBlock *From, BasicBlock *Like, BasicBlock *Next) {
  for (PHINode &Phi : Next->phis())
    Phi.addIncoming(Phi.getIncomingValueForBlock(Like), From);
}

/// A copy of what a returning work-item runs from \p First on.
BasicBlock *Guards::copyTail(BasicBlock *First, BasicBlock *From,
                             BasicBlock *End) {
  if (isa<ReturnInst>(First->getTerminator()))
    return End;
  SmallSetVector<BasicBlock *, 8> Tail;
  Tail.insert(First);
  for (size_t N = 0; N != Tail.size(); ++N)
    for (BasicBlock *Next : successors(Tail[N]))
      if (!isa<ReturnInst>(Next->getTerminator()))
        Tail.insert(Next);
  ValueToValueMapTy Copies;
  SmallVector<BasicBlock *, 8> Copied;
  for (BasicBlock *Block : Tail) {
    Copied.push_back(CloneBasicBlock(Block, Copies, ".leaving", &F));
    Copies[Block] = Copied.back();
  }
  remapInstructionsInBlocks(Copied, Copies);
  for (BasicBlock *Block : Copied) {
    for (PHINode &Phi : make_early_inc_range(Block->phis()))
      for (unsigned N = Phi.getNumIncomingValues(); N-- != 0;)
        if (!is_contained(Copied, Phi.getIncomingBlock(N)))
          Phi.removeIncomingValue(N, /*DeletePHIIfEmpty=*/false);
    for (unsigned N = 0; N != Block->getTerminator()->getNumSuccessors(); ++N)
      if (isa<ReturnInst>(
              Block->getTerminator()->getSuccessor(N)->getTerminator()))
        Block->getTerminator()->setSuccessor(N, End);
  }
  return Copied.front();
}

/// Who returns on this way goes to where the group is together next.
void Guards::lead(const Edge &Way, BasicBlock *Meeting) {
  auto [From, First] = Way;
  BasicBlock *Leave = create("returned");
  IRBuilder<> Builder(Leave);
  Builder.CreateStore(Builder.getTrue(), Gone);
  Builder.CreateBr(Meeting);
  join(Leave, From, Meeting);
  From->getTerminator()->replaceSuccessorWith(First,
                                              copyTail(First, From, Leave));
}

/// Work-items that have returned do only what all may in \p Block, and go on
/// with the others, or to \p Next where these part.
void Guards::guard(BasicBlock *Block, BasicBlock *Next) {
  SmallVector<Instruction *, 16> Own;
  for (Instruction &I : *Block)
    if (!Code.isKnown(&I) && !I.isTerminator() && !isa<PHINode>(I))
      Own.push_back(&I);
  if (Own.empty() && !Next)
    return;
  BasicBlock *Rest = SplitBlock(Block, Block->getTerminator());
  BasicBlock *Guarded = Rest;
  if (!Next) {
    Guarded = create("guarded");
    BranchInst::Create(Rest, Guarded);
  }
  for (Instruction *I : Own)
    I->moveBefore(Guarded->getTerminator());
  if (Next)
    join(Block, Rest, Next);
  Instruction *End = Block->getTerminator();
  IRBuilder<> Builder(End);
  Builder.CreateCondBr(isGone(Builder), Next ? Next : Rest, Guarded);
  End->eraseFromParent();
}

/// Work-items that have returned go around what lies between \p Block and the
/// next place where the group is together.
void Guards::skip(BasicBlock *Block) {
  for (BasicBlock *Next : Code.behind(Block)) {
    if (Code.passes(Next))
      continue;
    BasicBlock *Around = create("around");
    IRBuilder<> Builder(Around);
    Builder.CreateCondBr(isGone(Builder), Code.nextOf(Next), Next);
    Block->getTerminator()->replaceSuccessorWith(Next, Around);
  }
}

void Guards::add() {
  keepInSlots();
  IRBuilder<> Builder(&F.getEntryBlock().front());
  Gone = Builder.CreateAlloca(Builder.getInt1Ty(), nullptr, "gone");
  Slots.push_back(Gone);
  Builder.CreateStore(Builder.getFalse(), Gone);
  struct Place {
    BasicBlock *Block;
    BasicBlock *Next; ///< where the group may part behind it
  };
  std::vector<Place> Places;
  const BlockSet After = Code.afterReturns();
  for (BasicBlock &Block : F)
    if (After.contains(&Block))
      Places.push_back(
          {&Block, Code.leadsAll(&Block) ? nullptr : Code.nextOf(&Block)});
  for (const Edge &Way : Code.leaving())
    lead(Way, Code.nextOf(Way.first));
  for (const Place &P : Places) {
    if (!P.Next)
      skip(P.Block);
    if (!Barrier::hasBarrier(P.Block))
      guard(P.Block, P.Next);
  }
  EliminateUnreachableBlocks(F);
  DominatorTree Dominators(F);
  PromoteMemToReg(Slots, Dominators);
  joinWaysBack(F);
}

} // namespace

bool guardReturned(Function &F) {
  separateReturnAndBarriers(F);
  // Nobody goes around a variable that others know.
  if (any_of(instructions(F), [&](const Instruction &I) {
        return isa<AllocaInst>(I) && I.getParent() != &F.getEntryBlock();
      }))
    return false;
  for (const bool Coarse : {true, false}) {
    GroupCode Code(F, Coarse);
    if (!Code.find())
      continue;
    Guards(F, Code).add();
    return true;
  }
  return false;
}

} // namespace pocl
