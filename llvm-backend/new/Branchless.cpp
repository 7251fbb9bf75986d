//===- Branchless.cpp - no branches out of selection ----------------------===//
//
// Upstream expands some operations into branches after divergence has been
// lowered, when nobody can put splits around them: selects of floats, rounding
// to an integral float, and read-modify-writes. These get code without.
//
//===----------------------------------------------------------------------===//

#include "MCTargetDesc/RISCVBaseInfo.h"
#include "RISCVSubtarget.h"
#include "Remarks.h"
#include "Vorion.h"
#include "llvm/CodeGen/MachineInstrBuilder.h"
#include "llvm/CodeGen/SelectionDAG.h"
#include "llvm/IR/Instructions.h"

using namespace llvm;

namespace {

/// Emits straight code in place of one pseudo instruction.
class Expander {
public:
  explicit Expander(MachineInstr &MI, const RISCVSubtarget &Subtarget)
      : MI(MI), MRI(MI.getMF()->getRegInfo()), TII(*Subtarget.getInstrInfo()),
        HasConditionalZero(Subtarget.hasStdExtZicond()) {}

  /// An instruction with a new integer register as its result.
  template <typename... Registers>
  Register emit(unsigned Opcode, Registers... Sources) {
    return emitTo(MRI.createVirtualRegister(&RISCV::GPRRegClass), Opcode,
                  Sources...);
  }
  Register emitImm(unsigned Opcode, Register Source, int64_t Imm) {
    Register To = MRI.createVirtualRegister(&RISCV::GPRRegClass);
    build(Opcode, To).addReg(Source).addImm(Imm);
    return To;
  }
  template <typename... Registers>
  Register emitTo(Register To, unsigned Opcode, Registers... Sources) {
    MachineInstrBuilder MIB = build(Opcode, To);
    (MIB.addReg(Sources), ...);
    return To;
  }
  MachineInstrBuilder build(unsigned Opcode, Register To) {
    return BuildMI(*MI.getParent(), MI, MI.getDebugLoc(), TII.get(Opcode), To);
  }

  /// 0 or not 0, as the comparison of a RISC-V branch says; \p Holds is set to
  /// whether not 0 means that it holds.
  Register compare(RISCVCC::CondCode Code, Register Left, Register Right,
                   bool &Holds) {
    Holds = Code == RISCVCC::COND_NE || Code == RISCVCC::COND_LT ||
            Code == RISCVCC::COND_LTU;
    switch (Code) {
    case RISCVCC::COND_EQ:
    case RISCVCC::COND_NE:
      return Right == RISCV::X0 ? Left : emit(RISCV::XOR, Left, Right);
    case RISCVCC::COND_LT:
    case RISCVCC::COND_GE:
      return emit(RISCV::SLT, Left, Right);
    case RISCVCC::COND_LTU:
    case RISCVCC::COND_GEU:
      return emit(RISCV::SLTU, Left, Right);
    default:
      llvm_unreachable("not a branch condition");
    }
  }

  /// To = Condition != 0 ? True : False, all integers.
  void select(Register To, Register Condition, Register True, Register False) {
    if (!HasConditionalZero) {
      // All ones if the condition holds, which takes True from the difference.
      Register Holds = emit(RISCV::SLTU, Register(RISCV::X0), Condition);
      Register Mask = emit(RISCV::SUB, Register(RISCV::X0), Holds);
      Register Difference = emit(RISCV::XOR, True, False);
      Register Change = emit(RISCV::AND, Difference, Mask);
      emitTo(To, RISCV::XOR, False, Change);
      return;
    }
    Register Kept = emit(RISCV::CZERO_EQZ, True, Condition);
    Register Other = emit(RISCV::CZERO_NEZ, False, Condition);
    emitTo(To, RISCV::OR, Kept, Other);
  }

  Register bitsOf(Register Float) { return emit(RISCV::FMV_X_W, Float); }

  void expandSelect() {
    bool IsFloat = MI.getOpcode() == RISCV::Select_FPR32_Using_CC_GPR;
    bool Holds;
    Register Condition =
        compare(RISCVCC::CondCode(MI.getOperand(3).getImm()),
                MI.getOperand(1).getReg(), MI.getOperand(2).getReg(), Holds);
    Register True = MI.getOperand(4).getReg();
    Register False = MI.getOperand(5).getReg();
    if (!Holds)
      std::swap(True, False);
    Register To = MI.getOperand(0).getReg();
    if (!IsFloat) {
      select(To, Condition, True, False);
      return;
    }
    Register Bits = MRI.createVirtualRegister(&RISCV::GPRRegClass);
    select(Bits, Condition, bitsOf(True), bitsOf(False));
    emitTo(To, RISCV::FMV_W_X, Bits);
  }

  /// Round to an integral float: through an integer if the magnitude is below
  /// the limit above which every float is integral; else, and for NaN, as is.
  void expandRound() {
    Register From = MI.getOperand(1).getReg();
    Register Limit = MI.getOperand(2).getReg();
    auto floatRegister = [&] {
      return MRI.createVirtualRegister(&RISCV::FPR32RegClass);
    };
    Register Magnitude = emitTo(floatRegister(), RISCV::FSGNJX_S, From, From);
    Register IsSmall = emit(RISCV::FLT_S, Magnitude, Limit);
    Register Integer = MRI.createVirtualRegister(&RISCV::GPRRegClass);
    int64_t Mode = MI.getOperand(3).getImm();
    MachineInstrBuilder ToInteger =
        build(RISCV::FCVT_W_S, Integer).addReg(From).addImm(Mode);
    Register Back = floatRegister();
    MachineInstrBuilder FromInteger =
        build(RISCV::FCVT_S_W, Back).addReg(Integer).addImm(Mode);
    if (Mode == RISCVFPRndMode::DYN)
      for (MachineInstrBuilder &MIB :
           {std::ref(ToInteger), std::ref(FromInteger)})
        MIB.addReg(RISCV::FRM, RegState::Implicit);
    // -0.0 and what rounds to it keep their sign.
    Register Signed = emitTo(floatRegister(), RISCV::FSGNJ_S, Back, From);
    Register Bits = MRI.createVirtualRegister(&RISCV::GPRRegClass);
    select(Bits, IsSmall, bitsOf(Signed), bitsOf(From));
    emitTo(MI.getOperand(0).getReg(), RISCV::FMV_W_X, Bits);
  }

private:
  MachineInstr &MI;
  MachineRegisterInfo &MRI;
  const RISCVInstrInfo &TII;
  bool HasConditionalZero;
};

} // namespace

SDValue vorion::lowerFloatSelect(SDValue Select, SelectionDAG &DAG,
                                 const RISCVSubtarget &Subtarget) {
  if (!Subtarget.hasVendorXVortex() || Select.getSimpleValueType() != MVT::f32)
    return SDValue();
  SDLoc DL(Select);
  auto bitsOf = [&](unsigned Operand) {
    return DAG.getBitcast(MVT::i32, Select.getOperand(Operand));
  };
  SDValue Bits =
      DAG.getSelect(DL, MVT::i32, Select.getOperand(0), bitsOf(1), bitsOf(2));
  return DAG.getBitcast(MVT::f32, Bits);
}

bool vorion::expandWithoutBranch(MachineInstr &MI,
                                 const RISCVSubtarget &Subtarget) {
  if (!Subtarget.hasVendorXVortex())
    return false;
  switch (MI.getOpcode()) {
  case RISCV::Select_GPR_Using_CC_GPR:
  case RISCV::Select_FPR32_Using_CC_GPR:
    Expander(MI, Subtarget).expandSelect();
    break;
  case RISCV::PseudoFROUND_S:
    Expander(MI, Subtarget).expandRound();
    break;
  default:
    return false;
  }
  MI.eraseFromParent();
  return true;
}

bool vorion::expandsToCompareExchange(const AtomicRMWInst &Operation,
                                      const RISCVSubtarget &Subtarget) {
  const unsigned Bits = Operation.getType()->getPrimitiveSizeInBits();
  if (!Subtarget.hasVendorXVortex() ||
      (Bits == 32 && Operation.getOperation() != AtomicRMWInst::Nand))
    return false;
  remark<OptimizationRemark>(remarks::Atomic, "Loop", Operation, [&] {
    return ("atomic " +
            AtomicRMWInst::getOperationName(Operation.getOperation()) + " of " +
            Twine(Bits) +
            " bits made a loop around compare-and-swap: no amo instruction "
            "does it")
        .str();
  });
  return true;
}
