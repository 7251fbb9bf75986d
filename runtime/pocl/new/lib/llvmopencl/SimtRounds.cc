//===- SimtRounds.cc - a kernel as rounds from barrier to barrier ---------===//

#include "SimtRounds.h"

#include "Barrier.h"
#include "SimtAgreement.h"
#include "SimtInstructions.h"
#include "SimtWorkitems.h"
#include "pocl_llvm_api.h"

#include <llvm/ADT/MapVector.h>
#include <llvm/ADT/SetVector.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>
#include <llvm/Transforms/Utils/Cloning.h>
#include <llvm/Transforms/Utils/Local.h>
#include <llvm/Transforms/Utils/PromoteMemToReg.h>

#include <optional>

using namespace llvm;

namespace pocl {

namespace {

using BlockList = SmallSetVector<BasicBlock *, 16>;

class Rounds {
public:
  Rounds(Function &F, bool OfSome)
      : F(F), OfSome(OfSome), Entry(&F.getEntryBlock()),
        Number(Type::getInt32Ty(F.getContext())) {}

  void run();

private:
  BasicBlock *create(const char *Name) const {
    return BasicBlock::Create(F.getContext(), Name, &F);
  }
  void clearEntry();
  void separateWhatIsTold() const;
  void separateBarriers();
  void keepValuesInSlots();
  BasicBlock *copyFrom(BasicBlock *Start, BasicBlock *End);
  BasicBlock *leaveTo(BasicBlock *At, BasicBlock *End);
  void addRound(SwitchInst &Choice, BasicBlock *From);
  /// The place of a work-item that has returned; the start is 0, and barriers
  /// have the numbers between.
  Constant *ended() const {
    return ConstantInt::get(Number, Barriers.size() + 1);
  }

  Function &F;
  /// Whether work-items that have returned wait for the others.
  const bool OfSome;
  BasicBlock *Entry;
  IntegerType *Number;
  AllocaInst *Place = nullptr;
  /// Where those of the group are that have not returned; none if all go on.
  std::optional<Agreement> Common;
  /// Values that live in more than one block, until the rounds stand.
  std::vector<AllocaInst *> Slots;
  /// The block that is a barrier, and the one that follows it.
  MapVector<BasicBlock *, BasicBlock *> Barriers;
};

/// Leaves variables alone in the entry, and returns nothing.
void Rounds::clearEntry() {
  SmallVector<AllocaInst *, 16> Variables;
  for (Instruction &I : make_early_inc_range(instructions(F))) {
    auto *Variable = dyn_cast<AllocaInst>(&I);
    if (Variable && isa<ConstantInt>(Variable->getArraySize()))
      Variables.push_back(Variable);
    // A variable's life may go on in a round that lies before its start.
    else if (I.isLifetimeStartOrEnd())
      I.eraseFromParent();
  }
  SplitBlock(Entry, Entry->begin());
  for (AllocaInst *Variable : Variables)
    Variable->moveBefore(Entry->getTerminator());
}

/// All passes read what the work-items of the group have told each other before
/// any pass tells the next.
void Rounds::separateWhatIsTold() const {
  for (BasicBlock &Block : F)
    if (any_of(Block, [](const Instruction &I) { return isOfGroup(I); }))
      for (BasicBlock *Next : successors(&Block))
        if (Next->getSinglePredecessor())
          Barrier::Create(&*Next->getFirstInsertionPt());
}

void Rounds::separateBarriers() {
  SmallVector<Instruction *, 8> Found;
  for (Instruction &I : instructions(F))
    if (isa<Barrier>(&I))
      Found.push_back(&I);
  for (Instruction *I : Found) {
    BasicBlock *At = SplitBlock(I->getParent(), I);
    Barriers[At] = SplitBlock(At, I->getNextNode());
  }
}

/// So that a block can be copied alone.
void Rounds::keepValuesInSlots() {
  const auto Keep = [this](AllocaInst *Slot) {
    if (Slot)
      Slots.push_back(Slot);
  };
  const auto Top = Entry->getTerminator()->getIterator();
  for (BasicBlock &Block : F)
    while (auto *Phi = dyn_cast<PHINode>(&Block.front()))
      Keep(DemotePHIToStack(Phi, Top));
  SmallVector<Instruction *, 32> Leaving;
  for (BasicBlock &Block : F)
    for (Instruction &I : Block)
      if (&Block != Entry && I.isUsedOutsideOfBlock(&Block))
        Leaving.push_back(&I);
  for (Instruction *I : Leaving)
    Keep(DemoteRegToStack(*I, /*VolatileLoads=*/false, Top));
}

/// A block that ends the round at the barrier \p At, or for good if that is
/// null.
BasicBlock *Rounds::leaveTo(BasicBlock *At, BasicBlock *End) {
  auto *Leave = create(At ? "to_barrier" : "to_end");
  const auto Found = Barriers.find(At);
  IRBuilder<> Builder(Leave);
  Builder.CreateStore(ConstantInt::get(Number, Found - Barriers.begin() + 1),
                      Place);
  Builder.CreateBr(End);
  return Leave;
}

/// Copies what is reached from \p Start up to barriers and returns, which lead
/// to \p End.
BasicBlock *Rounds::copyFrom(BasicBlock *Start, BasicBlock *End) {
  BlockList Reached;
  Reached.insert(Start);
  for (size_t N = 0; N != Reached.size(); ++N)
    for (BasicBlock *Next : successors(Reached[N]))
      if (!Barriers.contains(Next))
        Reached.insert(Next);
  ValueToValueMapTy Copies;
  SmallVector<BasicBlock *, 16> Copied;
  for (BasicBlock *Block : Reached) {
    Copied.push_back(CloneBasicBlock(Block, Copies, ".round", &F));
    Copies[Block] = Copied.back();
  }
  remapInstructionsInBlocks(Copied, Copies);
  DenseMap<BasicBlock *, BasicBlock *> Leaves;
  const auto WayTo = [&](BasicBlock *At) {
    BasicBlock *&Leave = Leaves[At];
    if (!Leave)
      Leave = leaveTo(At, End);
    return Leave;
  };
  for (BasicBlock *Block : Copied) {
    Instruction *Terminator = Block->getTerminator();
    if (isa<ReturnInst>(Terminator)) {
      ReplaceInstWithInst(Terminator, BranchInst::Create(WayTo(nullptr)));
      continue;
    }
    for (unsigned N = 0; N != Terminator->getNumSuccessors(); ++N)
      if (BasicBlock *Next = Terminator->getSuccessor(N);
          Barriers.contains(Next))
        Terminator->setSuccessor(N, WayTo(Next));
  }
  return Copied.front();
}

/// The first place in the source that is known of what \p Block has.
DebugLoc placeOf(const BasicBlock &Block) {
  const auto Found = find_if(Block, [](const Instruction &I) {
    return I.getDebugLoc() && I.getDebugLoc().getLine() != 0;
  });
  return Found == Block.end() ? DebugLoc() : Found->getDebugLoc();
}

/// Adds the round that begins with \p From as the next choice.
void Rounds::addRound(SwitchInst &Choice, BasicBlock *From) {
  ConstantInt *Own = ConstantInt::get(Number, Choice.getNumCases());
  auto *Begin = create("round_begin"), *End = create("round_end");
  BasicBlock *Copy = copyFrom(From, End);
  IRBuilder<> Builder(Begin);
  Barrier::Create(Builder.CreateBr(Copy));
  Choice.addCase(Own, Begin);
  BasicBlock *Last = End;
  if (OfSome) {
    // Who has returned goes straight to the end.
    Instruction *ToCopy = Begin->getTerminator();
    Builder.SetInsertPoint(ToCopy);
    Builder.CreateCondBr(
        Builder.CreateICmpEQ(Builder.CreateLoad(Number, Place), Own), Copy,
        End);
    ToCopy->eraseFromParent();
    Builder.SetInsertPoint(End);
    Value *Said = Builder.CreateLoad(Number, Place);
    Last = Common->vote(End, Said, Builder.CreateICmpNE(Said, ended()),
                        placeOf(*From));
  }
  Barrier::Create(BranchInst::Create(Choice.getParent(), Last));
}

void Rounds::run() {
  clearEntry();
  separateWhatIsTold();
  separateBarriers();
  keepValuesInSlots();
  BasicBlock *Start = Entry->getSingleSuccessor();
  BasicBlock *Head = create("round"), *Done = create("rounds_end");
  IRBuilder<> Builder(Entry->getTerminator());
  Place = Builder.CreateAlloca(Number, nullptr, "place");
  Slots.push_back(Place);
  Builder.CreateStore(ConstantInt::get(Number, 0), Place);
  if (OfSome)
    Common.emplace(Builder).begin(Builder, ConstantInt::get(Number, 0));
  Entry->getTerminator()->setSuccessor(0, Head);
  ReturnInst::Create(F.getContext(), Done);

  Builder.SetInsertPoint(Head);
  Value *Next = Common
                    ? Common->result(Builder, ended())
                    : createUniform(Builder, Builder.CreateLoad(Number, Place));
  SwitchInst *Choice = Builder.CreateSwitch(Next, Done, Barriers.size() + 1);
  addRound(*Choice, Start);
  for (const auto &[At, Behind] : Barriers)
    addRound(*Choice, Behind);
  Barrier::Create(&*Head->getFirstInsertionPt());

  EliminateUnreachableBlocks(F);
  DominatorTree Dominators(F);
  PromoteMemToReg(Slots, Dominators);
}

} // namespace

/// Metadata: what keepReasonOfRounds() says, for each kernel.
static constexpr const char *Reasons = "vorion.rounds";

/// Module property: the kernel is to run in rounds.
static constexpr const char *Asked = "simt_rounds";

void keepReasonOfRounds(Module &M, StringRef Reason, unsigned Line) {
  LLVMContext &Context = M.getContext();
  M.getOrInsertNamedMetadata(Reasons)->addOperand(
      MDNode::get(Context, {MDString::get(Context, Reason),
                            ConstantAsMetadata::get(ConstantInt::get(
                                Type::getInt32Ty(Context), Line))}));
}

bool needsRounds(const Module &M) {
  unsigned long Failure = 0;
  getModuleIntMetadata(M, SimtFailure, Failure);
  return Failure && !M.getNamedMetadata(Reasons);
}

void askForRounds(Module &M) { setModuleIntMetadata(&M, Asked, 1); }

bool areRoundsAskedFor(const Module &M) {
  unsigned long Found = 0;
  return getModuleIntMetadata(M, Asked, Found) && Found;
}

void runInRounds(Function &F) { Rounds(F, /*OfSome=*/false).run(); }

void runInRoundsOfSome(Function &F) { Rounds(F, /*OfSome=*/true).run(); }

} // namespace pocl
