//===- SimtWorkitems.cc - work-items on the lanes of a warp ---------------===//

#include "SimtWorkitems.h"

#include "ComponentStores.h"
#include "LLVMUtils.h"
#include "PassLoops.h"
#include "ProgramVariables.h"
#include "SharedVariables.h"
#include "Workgroup.h"
#include "pocl_llvm_api.h"

#include <vorion_abi.h>

#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>

#include <cstddef>

using namespace llvm;

namespace pocl {

namespace {

/// Passes that the optimiser may unroll by its own measure, which weighs what
/// it copies and suits so few copies.
constexpr unsigned FewPasses = 4;

/// A word of the launch block, which nothing changes during a run.
LoadInst *loadLaunch(IRBuilder<> &Builder, Type *T, Value *Launch,
                     size_t Offset) {
  LoadInst *Load = Builder.CreateLoad(
      T, Builder.CreateConstGEP1_32(Builder.getInt8Ty(), Launch, Offset));
  Load->setMetadata(LLVMContext::MD_invariant_load,
                    MDNode::get(Builder.getContext(), {}));
  return Load;
}

/// Whether anything but loads may happen through \p Pointer.
bool mayBeWritten(const Value *Pointer) {
  for (const User *U : Pointer->users()) {
    if (isa<LoadInst>(U))
      continue;
    if ((isa<GetElementPtrInst>(U) || isa<CastInst>(U)) && !mayBeWritten(U))
      continue;
    // The source of a copy.
    if (const auto *Copy = dyn_cast<MemCpyInst>(U))
      if (Copy->getRawDest() != Pointer)
        continue;
    return true;
  }
  return false;
}

} // namespace

unsigned simtLanes(const Module &M) {
  unsigned long Lanes = 0;
  getModuleIntMetadata(M, "device_simt_lanes", Lanes);
  return Lanes;
}

bool fitsOneWarp(const Module &M) {
  bool Dynamic = true;
  unsigned long X = 0, Y = 0, Z = 0;
  getModuleBoolMetadata(M, "WGDynamicLocalSize", Dynamic);
  getModuleIntMetadata(M, "WGLocalSizeX", X);
  getModuleIntMetadata(M, "WGLocalSizeY", Y);
  getModuleIntMetadata(M, "WGLocalSizeZ", Z);
  return !Dynamic && X * Y * Z <= simtLanes(M);
}

void addFirstSimtPasses(PassBuilder &PB) {
  PB.registerPipelineStartEPCallback(
      [](ModulePassManager &Passes, OptimizationLevel) {
        Passes.addPass(DefineInlineFunctions());
        Passes.addPass(vorion::StoreComponents());
        Passes.addPass(vorion::ShareVariables());
      });
}

void prepareSimtModule(Module &M) {
  dropUnusedVariables(M);
  vorion::storeComponents(M);
  vorion::shareVariables(M);
  for (Function &F : M) {
    if (!isKernelToProcess(F))
      continue;
    for (Argument &A : F.args()) {
      if (!A.hasByValAttr() || !mayBeWritten(&A))
        continue;
      IRBuilder<> Builder(&*F.getEntryBlock().getFirstInsertionPt());
      Type *T = A.getParamByValType();
      const Align Alignment = A.getParamAlign().valueOrOne();
      AllocaInst *Copy = Builder.CreateAlloca(T, nullptr, A.getName() + ".own");
      Copy->setAlignment(std::max(Copy->getAlign(), Alignment));
      A.replaceAllUsesWith(Copy);
      Builder.CreateMemCpy(Copy, Copy->getAlign(), &A, Alignment,
                           M.getDataLayout().getTypeAllocSize(T));
    }
  }
}

/// Stands for what only the loops over work-items know.
static constexpr const char *IsFirstPass = "_simt_is_first_pass";

Value *createIsFirstPass(IRBuilder<> &Builder) {
  return Builder.CreateCall(intrinsic(*Builder.GetInsertBlock()->getModule(),
                                      IsFirstPass, Builder.getInt1Ty(), {}));
}

Value *createLaunchLoad(IRBuilder<> &Builder, Value *Launch, LaunchField Field,
                        int Index) {
  constexpr size_t Offsets[] = {
      offsetof(vx_launch, num_groups), offsetof(vx_launch, global_offset),
      offsetof(vx_launch, local_size), offsetof(vx_launch, work_dim),
      offsetof(vx_launch, variables)};
  Type *T = Field == LaunchField::Variables
                ? static_cast<Type *>(Builder.getPtrTy())
                : Builder.getInt32Ty();
  return loadLaunch(Builder, T, Launch,
                    Offsets[static_cast<int>(Field)] + 4 * std::max(Index, 0));
}

Value *createContextBase(IRBuilder<> &Builder, Module &M, Value *Launch) {
  Type *I32 = Builder.getInt32Ty();
  Value *Core = Builder.CreateCall(intrinsic(M, "vorion.vx_core_id", I32, {}));
  Value *Share =
      Builder.CreateMul(Core, loadLaunch(Builder, I32, Launch,
                                         offsetof(vx_launch, context_stride)));
  Value *Context = loadLaunch(Builder, Builder.getPtrTy(), Launch,
                              offsetof(vx_launch, context));
  return Builder.CreateGEP(Builder.getInt8Ty(), Context, Share, "simt_context");
}

SimtLoops::SimtLoops(Function &F, unsigned Lanes, GroupSize Size, LocalIds Ids)
    : F(F), M(*F.getParent()), Lanes(Lanes), Size(Size), Ids(Ids),
      Straddle(mayStraddle()), SizeT(Type::getInt32Ty(F.getContext())) {}

Constant *SimtLoops::number(uint64_t N) const {
  return ConstantInt::get(SizeT, N);
}

void SimtLoops::begin() {
  IRBuilder<> Builder(&*F.getEntryBlock().getFirstInsertionPt());
  BaseVar = Builder.CreateAlloca(SizeT, nullptr, ".simt_base");
  LinearVar = Builder.CreateAlloca(SizeT, nullptr, ".simt_linear");
  Lane = Builder.CreateCall(intrinsic(M, "vorion.vx_thread_id", SizeT, {}), {},
                            "simt_lane");
  if (Size.Dynamic) {
    auto LocalSize = [&](const char *Name) {
      return Builder.CreateLoad(SizeT, M.getOrInsertGlobal(Name, SizeT));
    };
    SizeX = LocalSize("_local_size_x");
    SizeY = LocalSize("_local_size_y");
    Items = Builder.CreateMul(Builder.CreateMul(SizeX, SizeY),
                              LocalSize("_local_size_z"), "simt_items");
  } else {
    SizeX = number(Size.X);
    SizeY = number(Size.Y);
    Items = number(Size.items());
  }
  // The kernel's entry belongs to no loop; whatever runs there is of the
  // first pass.
  Builder.CreateStore(number(0), BaseVar);
  Builder.CreateStore(Lane, LinearVar);
  store(Builder, divideIds(Builder, number(0)), Ids);
  if (!Straddle)
    return;
  const auto Variable = [&](const char *Name) {
    return Builder.CreateAlloca(SizeT, nullptr, Name);
  };
  NextLinear = Variable(".simt_next");
  Next = {Variable(".simt_next_x"), Variable(".simt_next_y"),
          Variable(".simt_next_z")};
  Value *Rows = Builder.CreateUDiv(number(Lanes), SizeX);
  Step = {Builder.CreateURem(number(Lanes), SizeX),
          Builder.CreateURem(Rows, SizeY), Builder.CreateUDiv(Rows, SizeY)};
}

Value *SimtLoops::linearId(IRBuilder<> &Builder) {
  return Builder.CreateLoad(SizeT, LinearVar, "simt_id");
}

/// Whether a pass may begin or end within a row, so that lanes differ in their
/// place in a row as well as in the row.
bool SimtLoops::mayStraddle() const {
  if (Size.Dynamic)
    return true;
  uint64_t Span = Lanes;
  const auto Straddles = [&Span](uint64_t Row) {
    const bool Uneven = Row % Span != 0 && Span % Row != 0;
    Span = std::max<uint64_t>(Span / Row, 1);
    return Uneven;
  };
  return (Size.Y * Size.Z != 1 && Straddles(Size.X)) ||
         (Size.Z != 1 && Straddles(Size.Y));
}

/// Divides the work-item's number by the group's sizes. As long as the numbers
/// of a pass do not straddle a row unevenly, what they have in common is
/// divided apart from what the lane adds: then lanes are known to agree in the
/// quotient, or passes in the remainder. Otherwise \p Base is 0.
SimtLoops::LocalIds SimtLoops::divideIds(IRBuilder<> &Builder, Value *Base) {
  // Base is a multiple of Span, and Own less than it.
  Value *Own = Lane;
  uint64_t Span = Lanes;
  const auto Divide = [&](Value *By, uint64_t Known) {
    Value *Rest;
    if (!Straddle && Known % Span == 0) {
      Rest = Builder.CreateAdd(Builder.CreateURem(Base, By), Own);
      Own = number(0);
      Span = 1;
    } else {
      Rest = Builder.CreateURem(Own, By);
      Own = Builder.CreateUDiv(Own, By);
      if (!Straddle)
        Span /= Known;
    }
    Base = Builder.CreateUDiv(Base, By);
    return Rest;
  };
  if (!Size.Dynamic && Size.Y * Size.Z == 1)
    return {Builder.CreateAdd(Base, Own), number(0), number(0)};
  Value *X = Divide(SizeX, Size.X);
  if (!Size.Dynamic && Size.Z == 1)
    return {X, Builder.CreateAdd(Base, Own), number(0)};
  Value *Y = Divide(SizeY, Size.Y);
  return {X, Y, Builder.CreateAdd(Base, Own)};
}

/// The ids of the work-item that is a pass behind the one with \p Of. What a
/// pass adds is smaller than the size, so one subtraction takes it back into a
/// row; of an id that fits, the difference is a large number. An id that was
/// taken back is smaller than what was added.
SimtLoops::LocalIds SimtLoops::countIds(IRBuilder<> &Builder,
                                        const LocalIds &Of) {
  const auto Wrapped = [&](Value *Sum, Value *Row) {
    return Builder.CreateBinaryIntrinsic(Intrinsic::umin, Sum,
                                         Builder.CreateSub(Sum, Row));
  };
  const auto Carry = [&](Value *Id, Value *Added) {
    return Builder.CreateZExt(Builder.CreateICmpULT(Id, Added), SizeT);
  };
  Value *X = Wrapped(Builder.CreateAdd(Of.X, Step.X), SizeX);
  Value *Rows = Builder.CreateAdd(Step.Y, Carry(X, Step.X));
  Value *Y = Wrapped(Builder.CreateAdd(Of.Y, Rows), SizeY);
  Value *Planes = Builder.CreateAdd(Step.Z, Carry(Y, Rows));
  return {X, Y, Builder.CreateAdd(Of.Z, Planes)};
}

SimtLoops::LocalIds SimtLoops::load(IRBuilder<> &Builder,
                                    const LocalIds &From) {
  return {Builder.CreateLoad(SizeT, From.X), Builder.CreateLoad(SizeT, From.Y),
          Builder.CreateLoad(SizeT, From.Z)};
}

void SimtLoops::store(IRBuilder<> &Builder, const LocalIds &Values,
                      const LocalIds &To) {
  Builder.CreateStore(Values.X, To.X);
  Builder.CreateStore(Values.Y, To.Y);
  Builder.CreateStore(Values.Z, To.Z);
}

/// Whether the lane has a work-item in the pass that starts at \p Base, where
/// its number would be \p Linear. The same for all lanes, and known to be, if
/// passes are always full.
Value *SimtLoops::anyLeft(IRBuilder<> &Builder, Value *Base, Value *Linear) {
  const bool Full = !Size.Dynamic && Size.items() % Lanes == 0;
  return Builder.CreateICmpULT(Full ? Base : Linear, Items);
}

std::pair<BasicBlock *, BasicBlock *>
SimtLoops::createLoopAround(const std::set<BasicBlock *> &InRegion,
                            BasicBlock *Entry, BasicBlock *Exit,
                            bool PeeledFirst) {
  LLVMContext &C = F.getContext();
  BasicBlock *After = Exit->getTerminator()->getSuccessor(0);
  auto *Init = BasicBlock::Create(C, "pregion_for_init", &F, Entry);
  auto *Pass = BasicBlock::Create(C, "pregion_for_pass", &F, Entry);
  auto *Increment = BasicBlock::Create(C, "pregion_for_inc", &F, Exit);
  auto *End = BasicBlock::Create(C, "pregion_for_end", &F, Exit);

  std::vector<BasicBlock *> Predecessors(pred_begin(Entry), pred_end(Entry));
  for (BasicBlock *P : Predecessors)
    if (P != Pass && !InRegion.count(P))
      P->getTerminator()->replaceSuccessorWith(Entry, Init);

  IRBuilder<> Builder(Init);
  // Also keeps a loop of the kernel that begins with this one apart from it:
  // one header for both would let lanes without a work-item in the last pass go
  // on while others are in it.
  if (!PeeledFirst)
    createGroupBarrier(Builder);
  Constant *First = number(PeeledFirst ? Lanes : 0);
  Builder.CreateStore(First, BaseVar);
  Value *FirstLinear = Builder.CreateAdd(First, Lane);
  if (Straddle) {
    Builder.CreateStore(FirstLinear, NextLinear);
    const LocalIds OfFirst = divideIds(Builder, number(0));
    store(Builder, PeeledFirst ? countIds(Builder, OfFirst) : OfFirst, Next);
  }
  if (PeeledFirst)
    Builder.CreateCondBr(anyLeft(Builder, First, FirstLinear), Pass, End);
  else
    Builder.CreateBr(Pass);

  Builder.SetInsertPoint(Pass);
  Value *Base = Builder.CreateLoad(SizeT, BaseVar, "simt_base");
  Value *Linear = Straddle ? Builder.CreateLoad(SizeT, NextLinear, "simt_id")
                           : Builder.CreateAdd(Base, Lane, "simt_id");
  Builder.CreateStore(Linear, LinearVar);
  store(Builder, Straddle ? load(Builder, Next) : divideIds(Builder, Base),
        Ids);
  Builder.CreateBr(Entry);

  Exit->getTerminator()->replaceSuccessorWith(After, Increment);
  Builder.SetInsertPoint(Increment);
  Value *NextBase = Builder.CreateAdd(
      Builder.CreateLoad(SizeT, BaseVar, "simt_base"), number(Lanes));
  Builder.CreateStore(NextBase, BaseVar);
  Value *NextId;
  if (Straddle) {
    NextId =
        Builder.CreateAdd(Builder.CreateLoad(SizeT, NextLinear), number(Lanes));
    Builder.CreateStore(NextId, NextLinear);
    store(Builder, countIds(Builder, load(Builder, Next)), Next);
  } else {
    NextId = Builder.CreateAdd(NextBase, Lane);
  }
  BranchInst *Back =
      Builder.CreateCondBr(anyLeft(Builder, NextBase, NextId), Pass, End);
  if (!Size.Dynamic && Size.items() > uint64_t{FewPasses} * Lanes)
    vorion::markPassLoop(*Back, /*Alone=*/true);

  Builder.SetInsertPoint(End);
  Builder.CreateBr(After);
  return {Init, End};
}

void SimtLoops::setFirstPass(BasicBlock *Entry) {
  IRBuilder<> Builder(&*Entry->getFirstInsertionPt());
  createGroupBarrier(Builder);
  Builder.CreateStore(Lane, LinearVar);
  store(Builder, divideIds(Builder, number(0)), Ids);
}

void SimtLoops::makeUniform(Instruction *Terminator) {
  IRBuilder<> Builder(Terminator);
  auto Same = [&](Value *Condition) {
    Value *Wide = Builder.CreateZExtOrTrunc(Condition, Builder.getInt32Ty());
    return Builder.CreateZExtOrTrunc(createUniform(Builder, Wide),
                                     Condition->getType());
  };
  if (auto *Branch = dyn_cast<BranchInst>(Terminator)) {
    if (Branch->isConditional() && !isa<Constant>(Branch->getCondition()))
      Branch->setCondition(Same(Branch->getCondition()));
  } else if (auto *Switch = dyn_cast<SwitchInst>(Terminator)) {
    if (Switch->getCondition()->getType()->getIntegerBitWidth() <= 32)
      Switch->setCondition(Same(Switch->getCondition()));
  }
}

void SimtLoops::trapElsewhere(BasicBlock &Block) {
  const auto IsCutOff = [](BasicBlock *Next) {
    return isa<UnreachableInst>(Next->front());
  };
  const auto Ways = successors(&Block);
  const auto Own = find_if_not(Ways, IsCutOff);
  if (Own == Ways.end())
    return;
  for (BasicBlock *Next : Ways) {
    if (!IsCutOff(Next))
      continue;
    Next->front().eraseFromParent();
    createTrap(*Next, *Own, Block.getTerminator()->getDebugLoc());
    for (PHINode &Phi : (*Own)->phis())
      Phi.addIncoming(Phi.getIncomingValueForBlock(&Block), Next);
  }
}

void SimtLoops::checkAgreement(Instruction *Terminator, Instruction *Condition,
                               BasicBlock *Exit) {
  if (!DominatorTree(F).dominates(Condition, Exit->getTerminator()))
    return;
  IRBuilder<> Builder(&*F.getEntryBlock().getFirstInsertionPt());
  Type *T = Condition->getType();
  AllocaInst *FirstWay = Builder.CreateAlloca(T, nullptr, ".simt_way");
  AllocaInst *Differ =
      Builder.CreateAlloca(Builder.getInt1Ty(), nullptr, ".simt_differ");

  Builder.SetInsertPoint(Exit->getTerminator());
  Value *IsFirst = Builder.CreateICmpULT(linearId(Builder), number(Lanes));
  Value *Way =
      Builder.CreateSelect(IsFirst, Condition, Builder.CreateLoad(T, FirstWay));
  Builder.CreateStore(Way, FirstWay);
  Value *Before =
      Builder.CreateSelect(IsFirst, Builder.getFalse(),
                           Builder.CreateLoad(Builder.getInt1Ty(), Differ));
  Builder.CreateStore(
      Builder.CreateOr(Before, Builder.CreateICmpNE(Condition, Way)), Differ);

  BasicBlock *Block = Terminator->getParent();
  BasicBlock *Decision = SplitBlock(Block, Terminator);
  auto *Other = BasicBlock::Create(F.getContext(), "other_way", &F, Decision);
  createTrap(*Other, Decision, Terminator->getDebugLoc());
  Builder.SetInsertPoint(Block->getTerminator());
  Builder.CreateCondBr(Builder.CreateLoad(Builder.getInt1Ty(), Differ), Other,
                       Decision);
  Block->getTerminator()->eraseFromParent();
}

void SimtLoops::tidyAllocas() {
  std::vector<Instruction *> Unused;
  BasicBlock &Entry = F.getEntryBlock();
  for (BasicBlock &Block : F)
    for (Instruction &I : make_early_inc_range(Block)) {
      auto *Alloca = dyn_cast<AllocaInst>(&I);
      if (Alloca && &Block != &Entry &&
          isa<ConstantInt>(Alloca->getArraySize()))
        Alloca->moveBefore(&*Entry.getFirstInsertionPt());
      // A context array is no stack slot.
      if (I.isLifetimeStartOrEnd() && !isa<AllocaInst>(I.getOperand(1)))
        Unused.push_back(&I);
    }
  for (Instruction *I : Unused)
    I->eraseFromParent();
}

/// Takes marks of loops back in a kernel that has several, between barriers. A
/// pass of straight code is left to the optimiser's own measure there.
static void measureLoops(Function &F) {
  const DominatorTree Dominators(F);
  const LoopInfo Loops(Dominators);
  SmallVector<Loop *, 8> Marked;
  for (Loop *L : Loops.getLoopsInPreorder())
    if (getBooleanLoopAttribute(L, vorion::PassLoop))
      Marked.push_back(L);
  if (Marked.size() < 2)
    return;
  for (Loop *L : Marked) {
    auto *Back = cast<BranchInst>(L->getLoopLatch()->getTerminator());
    const unsigned Ways = count_if(L->blocks(), [](const BasicBlock *Block) {
      return succ_size(Block) > 1;
    });
    if (Ways > 1)
      vorion::markPassLoop(*Back, /*Alone=*/false);
    else
      Back->setMetadata(LLVMContext::MD_loop, nullptr);
  }
}

void SimtLoops::answerFirstPass() {
  Function *Question = M.getFunction(IsFirstPass);
  if (!Question)
    return;
  for (User *U : make_early_inc_range(Question->users())) {
    auto *Call = cast<CallInst>(U);
    IRBuilder<> Builder(Call);
    Call->replaceAllUsesWith(
        Builder.CreateICmpULT(linearId(Builder), number(Lanes)));
    Call->eraseFromParent();
  }
  Question->eraseFromParent();
}

void SimtLoops::finish() {
  answerFirstPass();
  measureLoops(F);
  tidyAllocas();
  erase_if(ContextArrays, [](const ContextArray &Array) {
    const bool Unused = Array.Placeholder->use_empty();
    if (Unused)
      Array.Placeholder->eraseFromParent();
    return Unused;
  });
  tellAliases();
  setModuleIntMetadata(&M, SimtContextBytes, placeContextArrays());
}

} // namespace pocl
