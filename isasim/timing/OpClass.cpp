#include "timing/OpClass.h"

#include "core/Isa.h"

namespace vorion::isasim {

std::string_view name(OpClass C) {
  switch (C) {
  case OpClass::Alu:
    return "alu";
  case OpClass::Mul:
    return "mul";
  case OpClass::Div:
    return "div";
  case OpClass::Fma:
    return "fma";
  case OpClass::Fcmp:
    return "fcmp";
  case OpClass::Fcvt:
    return "fcvt";
  case OpClass::Fdiv:
    return "fdiv";
  case OpClass::Fsqrt:
    return "fsqrt";
  case OpClass::Simt:
    return "simt";
  case OpClass::Csr:
    return "csr";
  case OpClass::Branch:
    return "branch";
  case OpClass::Mask:
    return "mask";
  case OpClass::Load:
    return "load";
  case OpClass::Store:
    return "store";
  case OpClass::Atomic:
    return "atomic";
  case OpClass::Fence:
    return "fence";
  case OpClass::Barrier:
    return "barrier";
  case OpClass::Count:
    break;
  }
  return "";
}

/// Major opcodes of the RISC-V unprivileged specification, "RV32/64G
/// instruction set listings".
static OpClass floatClass(Op O) {
  switch (O) {
  case Op::RV_FADD_S:
  case Op::RV_FSUB_S:
  case Op::RV_FMUL_S:
    return OpClass::Fma;
  case Op::RV_FDIV_S:
    return OpClass::Fdiv;
  case Op::RV_FSQRT_S:
    return OpClass::Fsqrt;
  case Op::RV_FCVT_W_S:
  case Op::RV_FCVT_WU_S:
  case Op::RV_FCVT_S_W:
  case Op::RV_FCVT_S_WU:
    return OpClass::Fcvt;
  case Op::RV_FMV_X_W:
  case Op::RV_FMV_W_X:
    return OpClass::Alu; // one register file's bits
  default:
    return OpClass::Fcmp; // comparisons, min/max, signs, class
  }
}

OpClass classOf(uint32_t Word) {
  const std::optional<Decoded> D = decode(Word);
  if (!D)
    return OpClass::Alu; // it traps
  switch (D->O) {
  case Op::RV_MUL:
  case Op::RV_MULH:
  case Op::RV_MULHSU:
  case Op::RV_MULHU:
    return OpClass::Mul;
  case Op::RV_DIV:
  case Op::RV_DIVU:
  case Op::RV_REM:
  case Op::RV_REMU:
    return OpClass::Div;
  case Op::VX_TMC:
  case Op::VX_WSPAWN:
  case Op::VX_SPLIT:
  case Op::VX_SPLIT_N:
  case Op::VX_JOIN:
  case Op::VX_PRED:
  case Op::VX_PRED_N:
    return OpClass::Mask;
  case Op::VX_BAR:
    return OpClass::Barrier;
  default:
    break;
  }
  switch (Word & 0x7F) {
  case 0x03:
  case 0x07:
    return OpClass::Load;
  case 0x23:
  case 0x27:
    return OpClass::Store;
  case 0x2F:
    return OpClass::Atomic;
  case 0x0F:
    return OpClass::Fence;
  case 0x63:
  case 0x67:
  case 0x6F:
    return OpClass::Branch;
  case 0x73:
    return OpClass::Csr;
  case 0x43:
  case 0x47:
  case 0x4B:
  case 0x4F:
    return OpClass::Fma;
  case 0x53:
    return floatClass(D->O);
  case 0x0B:
    return OpClass::Simt;
  default:
    return OpClass::Alu;
  }
}

static void setCost(OpInfo &I, const CoreTiming &P) {
  const auto Set = [&I](Unit On, uint32_t Latency, uint32_t Interval = 1) {
    I.On = On;
    I.Latency = static_cast<uint8_t>(Latency);
    I.Interval = static_cast<uint8_t>(Interval);
  };
  switch (I.Class) {
  case OpClass::Alu:
    return Set(Unit::Alu, P.AluLatency);
  case OpClass::Mul:
    return Set(Unit::Alu, P.MulLatency);
  case OpClass::Fma:
    return Set(Unit::Alu, P.FmaLatency);
  case OpClass::Fcmp:
    return Set(Unit::Alu, P.FcmpLatency);
  case OpClass::Fcvt:
    return Set(Unit::Alu, P.FcvtLatency);
  case OpClass::Div:
    return Set(Unit::Sfu, P.DivLatency, P.DivInterval);
  case OpClass::Fdiv:
    return Set(Unit::Sfu, P.FdivLatency, P.FdivInterval);
  case OpClass::Fsqrt:
    return Set(Unit::Sfu, P.FsqrtLatency, P.FdivInterval);
  case OpClass::Simt:
    return Set(Unit::Sfu, P.SimtLatency);
  case OpClass::Csr:
    return Set(Unit::Sfu, P.CsrLatency);
  case OpClass::Branch: // jal and jalr write the address behind them
  case OpClass::Mask:
  case OpClass::Barrier:
    return Set(Unit::Sfu, P.AluLatency);
  case OpClass::Load:
  case OpClass::Store:
  case OpClass::Atomic:
  case OpClass::Fence:
    return Set(Unit::Lsu, 1);
  case OpClass::Count:
    break;
  }
}

std::vector<OpInfo> describeProgram(const CodeTable &Code,
                                    const CoreTiming &Params) {
  std::vector<OpInfo> All(Code.count() + 1);
  const auto Register = [](uint16_t Offset) {
    return static_cast<uint8_t>(Offset / sizeof(LaneWords));
  };
  for (uint32_t N = 0; N != All.size(); ++N) {
    const Insn &I = Code.begin()[N];
    OpInfo &O = All[N];
    O.Class = classOf(I.Word);
    const std::optional<Decoded> D = decode(I.Word);
    O.Rd = Register(I.Rd);
    O.Sources[0] = Register(I.Rs1);
    O.Sources[1] = Register(I.Rs2);
    // Where the third is no source it is the destination, which an instruction
    // waits for anyway.
    O.Sources[2] = D && D->info().Fmt == Format::R4 ? Register(I.Rs3) : 0;
    setCost(O, Params);
  }
  return All;
}

} // namespace vorion::isasim
