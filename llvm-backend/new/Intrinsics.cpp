//===- Intrinsics.cpp - our intrinsics, from name to instruction ----------===//
//
// Packaged LLVM's intrinsic tables cannot be extended, but TargetIntrinsicInfo
// lets selection treat plain declarations as intrinsics. Their numbers start
// where LLVM's end.
//
//===----------------------------------------------------------------------===//

#include "Intrinsics.h"
#include "RISCVSubtarget.h"
#include "RISCVTargetMachine.h"
#include "Vorion.h"
#include "llvm/CodeGen/SelectionDAG.h"
#include "llvm/IR/DiagnosticInfo.h"
#include "llvm/IR/Instructions.h"
#include "llvm/IR/Intrinsics.h"

using namespace llvm;
using namespace llvm::vorion;

namespace {

constexpr bool xvortex = false;
constexpr bool xvorion = true;

constexpr IntrinsicRecord Table[] = {
#define VORION_INTRINSIC(NAME, OPCODE, CSR, INPUTS, HAS_RESULT, DIVERGENCE,    \
                         EXTENSION)                                            \
  {#NAME,      unsigned(RISCV::OPCODE), CSR,      INPUTS,                      \
   HAS_RESULT, Divergence::DIVERGENCE,  EXTENSION},
#include "VorionIntrinsics.def"
};

constexpr unsigned FirstID = llvm::Intrinsic::num_intrinsics;

class IntrinsicInfo final : public TargetIntrinsicInfo {
public:
  std::string getName(unsigned ID, Type **, unsigned) const override {
    return (IntrinsicPrefix + Table[ID - FirstID].Name).str();
  }
  unsigned lookupName(const char *Name, unsigned Length) const override {
    const IntrinsicRecord *Found = findIntrinsic(StringRef(Name, Length));
    return Found ? FirstID + unsigned(Found - Table) : 0;
  }
  bool isOverloaded(unsigned) const override { return false; }
  Function *getDeclaration(Module *M, unsigned ID, Type **,
                           unsigned) const override {
    return declareIntrinsic(*M, Table[ID - FirstID].Name);
  }
};

} // namespace

const IntrinsicRecord *vorion::findIntrinsic(StringRef FullName) {
  if (!FullName.consume_front(IntrinsicPrefix))
    return nullptr;
  for (const IntrinsicRecord &I : Table)
    if (I.Name == FullName)
      return &I;
  return nullptr;
}

const IntrinsicRecord *vorion::findIntrinsic(const Value *V) {
  const auto *Call = dyn_cast<CallBase>(V);
  const Function *Callee = Call ? Call->getCalledFunction() : nullptr;
  return Callee ? findIntrinsic(Callee->getName()) : nullptr;
}

Function *vorion::declareIntrinsic(Module &M, StringRef Name) {
  std::string FullName = (IntrinsicPrefix + Name).str();
  const IntrinsicRecord *I = findIntrinsic(FullName);
  assert(I && "not an intrinsic of ours");
  Type *Int = Type::getInt32Ty(M.getContext());
  auto *Signature = FunctionType::get(
      I->HasResult ? Int : Type::getVoidTy(M.getContext()),
      SmallVector<Type *, 2>(I->Inputs, Int), /*isVarArg=*/false);
  auto *F =
      cast<Function>(M.getOrInsertFunction(FullName, Signature).getCallee());
  F->addFnAttr(Attribute::Convergent);
  F->addFnAttr(Attribute::NoMerge);
  F->addFnAttr(Attribute::NoUnwind);
  return F;
}

unsigned vorion::divergentMarker(LLVMContext &Context) {
  return Context.getMDKindID("vorion.divergent");
}

unsigned vorion::uniformMarker(LLVMContext &Context) {
  return Context.getMDKindID("vorion.uniform");
}

const TargetIntrinsicInfo *RISCVTargetMachine::getIntrinsicInfo() const {
  static const IntrinsicInfo Info;
  return &Info;
}

bool vorion::selectIntrinsic(SDNode *Node, SelectionDAG &DAG,
                             const RISCVSubtarget &Subtarget) {
  unsigned Kind = Node->getOpcode();
  if (Kind != ISD::INTRINSIC_VOID && Kind != ISD::INTRINSIC_W_CHAIN &&
      Kind != ISD::INTRINSIC_WO_CHAIN)
    return false;
  bool HasChain = Kind != ISD::INTRINSIC_WO_CHAIN;
  uint64_t ID = Node->getConstantOperandVal(HasChain);
  if (ID < FirstID || ID >= FirstID + std::size(Table))
    return false;
  const IntrinsicRecord &I = Table[ID - FirstID];

  SDLoc DL(Node);
  if (!(I.NeedsXVorion ? Subtarget.hasVendorXVorion()
                       : Subtarget.hasVendorXVortex()))
    DAG.getContext()->diagnose(
        DiagnosticInfoUnsupported(DAG.getMachineFunction().getFunction(),
                                  I.Name + " needs -march with " +
                                      (I.NeedsXVorion ? "xvorion" : "xvortex"),
                                  DL.getDebugLoc()));

  SmallVector<SDValue, 2> Inputs(drop_begin(Node->op_values(), HasChain + 1));
  if (I.Opcode == TargetOpcode::COPY) {
    DAG.ReplaceAllUsesOfValueWith(SDValue(Node, 0), Inputs[0]);
    if (HasChain)
      DAG.ReplaceAllUsesOfValueWith(SDValue(Node, 1), Node->getOperand(0));
    DAG.RemoveDeadNode(Node);
    return true;
  }

  SmallVector<SDValue, 4> Operands;
  if (I.CSR >= 0)
    Operands.push_back(DAG.getTargetConstant(I.CSR, DL, MVT::i32));
  if (I.Opcode == RISCV::CSRRS)
    Operands.push_back(DAG.getRegister(RISCV::X0, MVT::i32));
  // A constant 0 is x0 at every optimisation level; VerifySplits.cpp tells by
  // it the split that only asks for the depth.
  for (SDValue Input : Inputs)
    Operands.push_back(
        isNullConstant(Input) ? DAG.getRegister(RISCV::X0, MVT::i32) : Input);
  if (HasChain)
    Operands.push_back(Node->getOperand(0));

  // csrrw has a destination although the intrinsic has no result; nothing uses
  // it, and dead definitions become x0.
  bool DropsResult = I.Opcode == RISCV::CSRRW;
  SmallVector<EVT, 2> Types;
  if (I.HasResult || DropsResult)
    Types.push_back(MVT::i32);
  if (HasChain)
    Types.push_back(MVT::Other);
  SDNode *Selected =
      DAG.getMachineNode(I.Opcode, DL, DAG.getVTList(Types), Operands);
  for (unsigned Result = 0; Result < Node->getNumValues(); ++Result)
    DAG.ReplaceAllUsesOfValueWith(SDValue(Node, Result),
                                  SDValue(Selected, Result + DropsResult));
  DAG.RemoveDeadNode(Node);
  return true;
}
