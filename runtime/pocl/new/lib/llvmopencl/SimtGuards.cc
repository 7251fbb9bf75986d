#include "SimtGuards.h"

#include "Barrier.h"
#include "SimtAgreement.h"
#include "SimtGroupCode.h"

#include <llvm/ADT/SetVector.h>
#include <llvm/Analysis/CycleAnalysis.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>
#include <llvm/Transforms/Utils/Cloning.h>
#include <llvm/Transforms/Utils/Local.h>
#include <llvm/Transforms/Utils/PromoteMemToReg.h>

#include <optional>

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
  BasicBlock *goOnIfAnybodyIsLeft(BasicBlock *Rest, BasicBlock *Return);
  BasicBlock *tell(Instruction *I, BasicBlock *Return);
  void endIfAllReturned(BasicBlock *Block, BasicBlock *Return);
  BlockSet headsOfRounds() const;
  void join(BasicBlock *From, BasicBlock *Like, BasicBlock *Next);
  Value *isGone(IRBuilder<> &Builder) const {
    return Builder.CreateLoad(Builder.getInt1Ty(), Gone, "is_gone");
  }

  Function &F;
  const GroupCode &Code;
  AllocaInst *Gone = nullptr;
  std::vector<AllocaInst *> Slots;
  /// Tells those that have returned what they must not compute.
  std::optional<Agreement> Common;
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
    if ((!Code.isKnown(&I) || Code.isTold(&I)) && !I.isTerminator() &&
        !isa<PHINode>(I))
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

/// A block with a barrier, behind which the group knows the answers. If nobody
/// is left, it goes to \p Return, else to \p Rest.
BasicBlock *Guards::goOnIfAnybodyIsLeft(BasicBlock *Rest, BasicBlock *Return) {
  BasicBlock *Told = create("told");
  IRBuilder<> Builder(Told);
  Builder.CreateCondBr(Common->hasResult(Builder), Rest, Return);
  Barrier::Create(&Told->front());
  return Told;
}

/// Those that have not returned tell the others what \p I, which all come to,
/// computes. If nobody is left, the group goes to \p Return. The block behind.
BasicBlock *Guards::tell(Instruction *I, BasicBlock *Return) {
  Type *Word = Type::getInt32Ty(F.getContext());
  BasicBlock *Block = I->getParent();
  BasicBlock *Rest = SplitBlock(Block, I->getNextNode());
  IRBuilder<> Builder(&F.getEntryBlock().front());
  AllocaInst *Own = Builder.CreateAlloca(Word, nullptr, "own");
  Slots.push_back(Own);
  Builder.SetInsertPoint(Block->getTerminator());
  Builder.CreateStore(Builder.CreateZExt(I, Word), Own);
  guard(Block, nullptr);

  BasicBlock *Vote = Rest->getSinglePredecessor();
  BasicBlock *Told = goOnIfAnybodyIsLeft(Rest, Return);
  Vote->getTerminator()->eraseFromParent();
  Builder.SetInsertPoint(Vote);
  Value *Said = Builder.CreateLoad(Word, Own);
  Value *Goes = Builder.CreateNot(isGone(Builder));
  BranchInst::Create(Told, Common->vote(Vote, Said, Goes, I->getDebugLoc()));

  Builder.SetInsertPoint(Told->front().getNextNode());
  Value *Result = Builder.CreateZExtOrTrunc(
      Common->result(Builder, Constant::getNullValue(Word)), I->getType());
  I->replaceUsesWithIf(Result, [I](const Use &U) {
    return cast<Instruction>(U.getUser())->getParent() != I->getParent();
  });
  return Rest;
}

/// Puts a test behind the choices of \p Block: if nobody is left, the group
/// goes to \p Return.
void Guards::endIfAllReturned(BasicBlock *Block, BasicBlock *Return) {
  BasicBlock *Rest = SplitBlock(Block, Block->getFirstNonPHI());
  Block->getTerminator()->eraseFromParent();
  IRBuilder<> Builder(Block);
  Common->ask(Builder, Builder.CreateNot(isGone(Builder)));
  Builder.CreateBr(goOnIfAnybodyIsLeft(Rest, Return));
}

/// Where rounds begin in which work-items return. What ends such a loop for
/// those that do not may never come true for the others: these would go round
/// for ever.
BlockSet Guards::headsOfRounds() const {
  CycleInfo Cycles;
  Cycles.compute(F);
  BlockSet Found;
  for (const Edge &Way : Code.leaving())
    for (const Cycle *C = Cycles.getCycle(Way.first); C;
         C = C->getParentCycle())
      for (BasicBlock *Head : C->getEntries())
        Found.insert(Head);
  return Found;
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
    SmallVector<Instruction *, 1> Told;
    bool Asks;
  };
  std::vector<Place> Places;
  BasicBlock *Return = nullptr;
  const BlockSet After = Code.afterReturns(), Heads = headsOfRounds();
  for (BasicBlock &Block : F) {
    if (isa<ReturnInst>(Block.getTerminator()))
      Return = &Block;
    if (!After.contains(&Block))
      continue;
    Places.push_back(
        {&Block, Code.leadsAll(&Block) ? nullptr : Code.nextOf(&Block), {}});
    for (Instruction &I : Block)
      if (Code.isTold(&I))
        Places.back().Told.push_back(&I);
    // What is told ends the loop as well.
    Places.back().Asks = Heads.contains(&Block) && Places.back().Told.empty();
  }
  if (any_of(Places, [](const Place &P) { return P.Asks || !P.Told.empty(); }))
    Common.emplace(Builder);
  for (const Edge &Way : Code.leaving())
    lead(Way, Code.nextOf(Way.first));
  for (const Place &P : Places) {
    if (!P.Next)
      skip(P.Block);
    BasicBlock *Block = P.Block;
    for (Instruction *I : P.Told)
      Block = tell(I, Return);
    if (!Barrier::hasBarrier(Block))
      guard(Block, P.Next);
    if (P.Asks)
      endIfAllReturned(P.Block, Return);
  }
  EliminateUnreachableBlocks(F);
  DominatorTree Dominators(F);
  PromoteMemToReg(Slots, Dominators);
  joinWaysBack(F);
}

} // namespace

bool guardReturned(Function &F, DebugLoc &Obstacle) {
  separateReturnAndBarriers(F);
  // Nobody goes around a variable that others know.
  if (any_of(instructions(F), [&](const Instruction &I) {
        return isa<AllocaInst>(I) && I.getParent() != &F.getEntryBlock();
      }))
    return false;
  const Differences Differ = differencesIn(F);
  for (const bool Tells : {false, true})
    for (const bool Coarse : {true, false}) {
      GroupCode Code(F, Differ, Coarse, Tells);
      if (!Code.find()) {
        Obstacle = Code.obstacle();
        continue;
      }
      Guards(F, Code).add();
      return true;
    }
  return false;
}

} // namespace pocl
