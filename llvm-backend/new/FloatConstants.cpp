//===- FloatConstants.cpp - floats made of integers -----------------------===//
//
// Upstream loads a float constant from memory by two instructions, which no
// allocator puts back: MachineLICM hoists them whatever the pressure, and what
// finds no register is spilled, to a stack of which each lane has its own.
// Here a constant is one pseudo instruction until registers are given, then
// lui, addi and fmv.w.x, as many of them as its bits need.
//
//===----------------------------------------------------------------------===//

#include "RISCVSubtarget.h"
#include "Vorion.h"
#include "llvm/CodeGen/LiveRegUnits.h"
#include "llvm/CodeGen/MachineFunction.h"
#include "llvm/CodeGen/MachineInstrBuilder.h"
#include "llvm/CodeGen/SelectionDAG.h"
#include "llvm/Support/CommandLine.h"

using namespace llvm;

static cl::opt<bool> Enabled("vorion-float-constants", cl::Hidden,
                             cl::init(true),
                             cl::desc("Make float constants of integers"));

namespace {

/// Chooses registers that nothing needs, each time another one, so that the
/// scheduler may mix the code of neighbouring constants.
class FreeRegisters {
public:
  explicit FreeRegisters(const MachineFunction &MF)
      : Order(RISCV::GPRRegClass.getRawAllocationOrder(MF)) {}

  /// None if all that may be used are in \p Live.
  Register choose(const LiveRegUnits &Live, const MachineRegisterInfo &MRI) {
    for (unsigned Tried = 0; Tried != Order.size(); ++Tried) {
      const MCPhysReg Reg = Order[Next++ % Order.size()];
      if (!MRI.isReserved(Reg) && Live.available(Reg))
        return Reg;
    }
    return Register();
  }

private:
  ArrayRef<MCPhysReg> Order;
  unsigned Next = 0;
};

/// Calls \p Visit with every constant of \p MF and the registers that are live
/// behind it. It may erase the constant.
template <typename Function, typename Visitor>
void forEachConstant(Function &MF, Visitor Visit) {
  LiveRegUnits Live(*MF.getRegInfo().getTargetRegisterInfo());
  for (auto &MBB : MF) {
    Live.clear();
    Live.addLiveOuts(MBB);
    for (auto &MI : make_early_inc_range(reverse(MBB))) {
      Live.stepBackward(MI);
      if (MI.getOpcode() == RISCV::PseudoFloatConstant)
        Visit(MI, Live);
    }
  }
}

} // namespace

bool vorion::hasFloatConstants(const RISCVSubtarget &Subtarget) {
  return Enabled && Subtarget.hasVendorXVortex() && Subtarget.hasStdExtF();
}

bool vorion::selectFloatConstant(SDNode *Node, SelectionDAG &DAG,
                                 const RISCVSubtarget &Subtarget) {
  const auto *Constant = dyn_cast<ConstantFPSDNode>(Node);
  if (!Constant || Node->getSimpleValueType(0) != MVT::f32 ||
      !hasFloatConstants(Subtarget))
    return false;
  const APInt Bits = Constant->getValueAPF().bitcastToAPInt();
  const SDLoc DL(Node);
  DAG.SelectNodeTo(Node, RISCV::PseudoFloatConstant, MVT::f32,
                   DAG.getTargetConstant(Bits.getSExtValue(), DL, MVT::i32));
  return true;
}

bool vorion::mayLackRegister(const MachineFunction &MF) {
  const MachineRegisterInfo &MRI = MF.getRegInfo();
  LiveRegUnits Saved(*MRI.getTargetRegisterInfo());
  for (const MCPhysReg *Reg = MRI.getCalleeSavedRegs(); *Reg; ++Reg)
    Saved.addReg(*Reg);
  bool Lacks = false;
  forEachConstant(MF, [&](const MachineInstr &, const LiveRegUnits &Live) {
    Lacks = Lacks || none_of(RISCV::GPRRegClass, [&](MCPhysReg Reg) {
              return !MRI.isReserved(Reg) && Live.available(Reg) &&
                     Saved.available(Reg);
            });
  });
  return Lacks;
}

bool vorion::expandFloatConstants(MachineFunction &MF) {
  const auto &TII = *MF.getSubtarget<RISCVSubtarget>().getInstrInfo();
  MachineRegisterInfo &MRI = MF.getRegInfo();
  FreeRegisters Free(MF);
  bool NeedsSlot = false;
  forEachConstant(MF, [&](MachineInstr &MI, const LiveRegUnits &Live) {
    const Register Chosen = Free.choose(Live, MRI);
    NeedsSlot = NeedsSlot || !Chosen;
    auto build = [&](unsigned Opcode, Register To) {
      return BuildMI(*MI.getParent(), MI, MI.getDebugLoc(), TII.get(Opcode),
                     To);
    };
    // Where no register is free, the frame's scavenger makes one so.
    auto scratch = [&] {
      return Chosen ? Chosen : MRI.createVirtualRegister(&RISCV::GPRRegClass);
    };
    const int64_t Bits = MI.getOperand(1).getImm();
    const int64_t Low = SignExtend64<12>(Bits);
    const int64_t High = ((Bits - Low) >> 12) & 0xFFFFF;
    Register From = RISCV::X0;
    if (High != 0)
      build(RISCV::LUI, From = scratch()).addImm(High);
    if (Low != 0) {
      const Register To = scratch();
      build(RISCV::ADDI, To)
          .addReg(From, getKillRegState(From != RISCV::X0))
          .addImm(Low);
      From = To;
    }
    build(RISCV::FMV_W_X, MI.getOperand(0).getReg())
        .addReg(From, getKillRegState(From != RISCV::X0));
    MI.eraseFromParent();
  });
  return NeedsSlot;
}
