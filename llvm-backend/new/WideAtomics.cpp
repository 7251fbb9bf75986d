//===- WideAtomics.cpp - atomics of 64 bits -------------------------------===//
//
// amocas.d works on two neighbouring registers. Upstream's assembler knows it,
// its code generation does not. All other atomics of 64 bits become loops
// around it in IR; a load compares with 0 and writes 0.
//
//===----------------------------------------------------------------------===//

#include "MCTargetDesc/RISCVMCTargetDesc.h"
#include "RISCVSubtarget.h"
#include "Vorion.h"
#include "llvm/CodeGen/SelectionDAG.h"
#include "llvm/IR/Instructions.h"

using namespace llvm;

namespace {

/// The instruction with the ordering bits of \p Order.
unsigned opcodeFor(AtomicOrdering Order) {
  switch (Order) {
  case AtomicOrdering::Acquire:
    return RISCV::AMOCAS_D_RV32_AQ;
  case AtomicOrdering::Release:
    return RISCV::AMOCAS_D_RV32_RL;
  case AtomicOrdering::AcquireRelease:
  case AtomicOrdering::SequentiallyConsistent:
    return RISCV::AMOCAS_D_RV32_AQ_RL;
  default:
    return RISCV::AMOCAS_D_RV32;
  }
}

/// \p Value of 64 bits in a pair of registers.
SDValue inPair(SDValue Value, SelectionDAG &DAG, const SDLoc &DL) {
  auto [Low, High] = DAG.SplitScalar(Value, DL, MVT::i32, MVT::i32);
  SDValue Parts[] = {
      DAG.getTargetConstant(RISCV::GPRPairRegClassID, DL, MVT::i32), Low,
      DAG.getTargetConstant(RISCV::sub_gpr_even, DL, MVT::i32), High,
      DAG.getTargetConstant(RISCV::sub_gpr_odd, DL, MVT::i32)};
  return SDValue(
      DAG.getMachineNode(TargetOpcode::REG_SEQUENCE, DL, MVT::Untyped, Parts),
      0);
}

} // namespace

bool vorion::hasWideAtomics(const RISCVSubtarget &Subtarget) {
  return Subtarget.hasVendorXVortex() && !Subtarget.is64Bit();
}

bool vorion::isWideAtomic(const Instruction &Access,
                          const RISCVSubtarget &Subtarget) {
  const auto *Store = dyn_cast<StoreInst>(&Access);
  const Type *Of =
      Store ? Store->getValueOperand()->getType() : Access.getType();
  return hasWideAtomics(Subtarget) && Of->getPrimitiveSizeInBits() == 64;
}

bool vorion::replaceWideCompareExchange(SDNode *Node,
                                        SmallVectorImpl<SDValue> &Results,
                                        SelectionDAG &DAG) {
  if (Node->getOpcode() != ISD::ATOMIC_CMP_SWAP)
    return false;
  const auto *Atomic = cast<AtomicSDNode>(Node);
  SDLoc DL(Node);
  SDValue New = Atomic->getOperand(3);
  SDValue Operands[] = {
      inPair(Atomic->getOperand(2), DAG, DL), Atomic->getBasePtr(),
      isNullConstant(New) ? DAG.getRegister(RISCV::X0_Pair, MVT::Untyped)
                          : inPair(New, DAG, DL),
      Atomic->getChain()};
  MachineSDNode *Swap =
      DAG.getMachineNode(opcodeFor(Atomic->getMergedOrdering()), DL,
                         MVT::Untyped, MVT::Other, Operands);
  DAG.setNodeMemRefs(Swap, {Atomic->getMemOperand()});
  SDValue Pair(Swap, 0);
  SDValue Low =
      DAG.getTargetExtractSubreg(RISCV::sub_gpr_even, DL, MVT::i32, Pair);
  SDValue High =
      DAG.getTargetExtractSubreg(RISCV::sub_gpr_odd, DL, MVT::i32, Pair);
  Results.push_back(DAG.getNode(ISD::BUILD_PAIR, DL, MVT::i64, Low, High));
  Results.push_back(SDValue(Swap, 1));
  return true;
}
