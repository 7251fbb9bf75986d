//===- StackUse.cpp - what each function takes of a lane's stack ----------===//
//
// vorion-link adds up the stack of a kernel's deepest path of calls
// (libdevice/link/StackDepth.h). For that each function has a record of words
// in the section vorion_stacks (docs/abi.md): its address, the bytes of its
// frame, flags, how many functions it calls, and their addresses.
//
//===----------------------------------------------------------------------===//

#include "StackUse.h"
#include "llvm/ADT/SetVector.h"
#include "llvm/CodeGen/MachineFrameInfo.h"
#include "llvm/CodeGen/MachineFunction.h"
#include "llvm/CodeGen/MachineInstr.h"
#include "llvm/IR/Constants.h"
#include "llvm/IR/InstrTypes.h"
#include "llvm/IR/Module.h"
#include <vorion_abi.h>

using namespace llvm;

namespace {

constexpr StringLiteral Section = "vorion_stacks";

/// Whether something else than a call or one of our tables has the address.
bool isAddressTaken(const Value &Address) {
  return any_of(Address.uses(), [](const Use &U) {
    const User *By = U.getUser();
    if (const auto *Call = dyn_cast<CallBase>(By))
      return !Call->isCallee(&U);
    if (const auto *Table = dyn_cast<GlobalVariable>(By))
      return !Table->getSection().starts_with("vorion_") &&
             !Table->getName().starts_with("llvm.");
    return !isa<Constant>(By) || isAddressTaken(*By);
  });
}

} // namespace

void vorion::recordStackUse(MachineFunction &MF) {
  Function &F = MF.getFunction();
  Module &M = *F.getParent();
  LLVMContext &Context = M.getContext();
  uint32_t Flags = isAddressTaken(F) ? VX_STACK_ADDRESS_TAKEN : 0;
  if (MF.getFrameInfo().hasVarSizedObjects())
    Flags |= VX_STACK_REPEATS;
  SmallSetVector<Constant *, 8> Callees;
  for (const MachineBasicBlock &Block : MF)
    for (const MachineInstr &MI : Block) {
      if (!MI.isCall())
        continue;
      Constant *Callee = nullptr;
      for (const MachineOperand &Operand : MI.operands())
        if (Operand.isGlobal())
          Callee = const_cast<GlobalValue *>(Operand.getGlobal());
        else if (Operand.isSymbol()) // of a library, which IR need not know
          Callee = cast<Constant>(
              M.getOrInsertFunction(
                   Operand.getSymbolName(),
                   FunctionType::get(Type::getVoidTy(Context), false))
                  .getCallee());
      if (Callee)
        Callees.insert(Callee);
      else
        Flags |= VX_STACK_INDIRECT;
    }

  const auto Word = [&](uint64_t N) -> Constant * {
    return ConstantInt::get(Type::getInt32Ty(Context), N);
  };
  SmallVector<Constant *, 16> Words{&F, Word(MF.getFrameInfo().getStackSize()),
                                    Word(Flags), Word(Callees.size())};
  Words.append(Callees.begin(), Callees.end());
  Constant *Record = ConstantStruct::getAnon(Words);
  auto *Table =
      new GlobalVariable(M, Record->getType(), /*isConstant=*/true,
                         GlobalValue::PrivateLinkage, Record, Section);
  Table->setSection(Section);
  Table->setAlignment(Align(4));
  Table->setComdat(F.getComdat());
  // It goes where its function does.
  Table->setMetadata(LLVMContext::MD_associated,
                     MDNode::get(Context, ValueAsMetadata::get(&F)));
}
