// The base instructions: RV32IMAF, Zicsr, Zifencei, Zicond, Zba, Zbb, Zbs and
// Zacas (RISC-V unprivileged specification, 20240411 and the Zacas chapter).
// lr.w and sc.w are left out on purpose: docs/decisions.md, 4.

// Formats whose immediate field is read differently from those of the base.
def IShift : Format<"rd, rs1, shamt">;
def ICsr : Format<"rd, csr, rs1">;
def ICsrImm : Format<"rd, csr, uimm">;
def Plain : Format<"">;

// Syntax: operands as written; f before a register's name means the F file,
// "rm" is printed unless it is dyn.
class Rv32<string mnemonic, Format format, int match, int mask, string syntax,
           string extension>
    : Instruction<mnemonic, format, match, mask, extension> {
  string Syntax = syntax;
}

class RType<string mnemonic, int opcode, int funct3, int funct7, string extension,
            string syntax = "rd, rs1, rs2">
    : Rv32<mnemonic, R, !or(opcode, !shl(funct3, 12), !shl(funct7, 25)),
           0xFE00707F, syntax, extension>;
// Two operands: rs2 selects the operation.
class Unary<string mnemonic, int opcode, int funct3, int funct7, int rs2,
            string extension, string syntax = "rd, rs1">
    : Rv32<mnemonic, R,
           !or(opcode, !shl(funct3, 12), !shl(funct7, 25), !shl(rs2, 20)),
           0xFFF0707F, syntax, extension>;
class IType<string mnemonic, int opcode, int funct3, string extension,
            string syntax = "rd, rs1, imm">
    : Rv32<mnemonic, I, !or(opcode, !shl(funct3, 12)), 0x707F, syntax, extension>;
class ShiftType<string mnemonic, int funct3, int funct7, string extension>
    : Rv32<mnemonic, IShift, !or(0x13, !shl(funct3, 12), !shl(funct7, 25)),
           0xFE00707F, "rd, rs1, shamt", extension>;
class SType<string mnemonic, int opcode, int funct3, string extension,
            string syntax = "rs2, imm(rs1)">
    : Rv32<mnemonic, S, !or(opcode, !shl(funct3, 12)), 0x707F, syntax, extension> {
  let Effects = Store;
}
class BType<string mnemonic, int funct3>
    : Rv32<mnemonic, B, !or(0x63, !shl(funct3, 12)), 0x707F, "rs1, rs2, target", "i"> {
  let Effects = Branch;
}
class AmoType<string mnemonic, int funct5, string extension>
    : Rv32<mnemonic, R, !or(0x202F, !shl(funct5, 27)), 0xF800707F,
           "rd, rs2, (rs1)", extension> {
  let Effects = Atomic;
}
// With a pair of registers for rd and rs2; the odd ones are reserved.
class AmoPairType<string mnemonic, int funct5, string extension>
    : Rv32<mnemonic, R, !or(0x302F, !shl(funct5, 27)), 0xF81070FF,
           "rd, rs2, (rs1)", extension> {
  let Effects = Atomic;
  let Pairs = 1;
}
class CsrType<string mnemonic, int funct3>
    : Rv32<mnemonic, !if(!gt(funct3, 4), ICsrImm, ICsr), !or(0x73, !shl(funct3, 12)),
           0x707F, !if(!gt(funct3, 4), "rd, csr, uimm", "rd, csr, rs1"), "zicsr"> {
  let Effects = !if(!gt(funct3, 4), CsrImmediate, CsrRegister);
}
// OP-FP; the rounding mode is where funct3 is.
class FRound<string mnemonic, int funct7>
    : Rv32<mnemonic, R, !or(0x53, !shl(funct7, 25)), 0xFE00007F,
           "frd, frs1, frs2, rm", "f">;
class FRoundUnary<string mnemonic, int funct7, int rs2, string syntax>
    : Rv32<mnemonic, R, !or(0x53, !shl(funct7, 25), !shl(rs2, 20)), 0xFFF0007F,
           syntax, "f">;
class FmaType<string mnemonic, int opcode>
    : Rv32<mnemonic, R4, opcode, 0x0600007F, "frd, frs1, frs2, frs3, rm", "f">;

// RV32I
let Effects = LaneWise in {
def RV_LUI : Rv32<"lui", U, 0x37, 0x7F, "rd, uimm20", "i">;
def RV_AUIPC : Rv32<"auipc", U, 0x17, 0x7F, "rd, uimm20", "i">;
}
let Latency = LatencyBranch in {
let Effects = Jump in
def RV_JAL : Rv32<"jal", J, 0x6F, 0x7F, "rd, target", "i">;
let Effects = IndirectJump in
def RV_JALR : IType<"jalr", 0x67, 0, "i", "rd, imm(rs1)">;
def RV_BEQ : BType<"beq", 0>;
def RV_BNE : BType<"bne", 1>;
def RV_BLT : BType<"blt", 4>;
def RV_BGE : BType<"bge", 5>;
def RV_BLTU : BType<"bltu", 6>;
def RV_BGEU : BType<"bgeu", 7>;
}
let Latency = LatencyLoad, Effects = Load in {
def RV_LB : IType<"lb", 0x03, 0, "i", "rd, imm(rs1)">;
def RV_LH : IType<"lh", 0x03, 1, "i", "rd, imm(rs1)">;
def RV_LW : IType<"lw", 0x03, 2, "i", "rd, imm(rs1)">;
def RV_LBU : IType<"lbu", 0x03, 4, "i", "rd, imm(rs1)">;
def RV_LHU : IType<"lhu", 0x03, 5, "i", "rd, imm(rs1)">;
}
let Latency = LatencyStore in {
def RV_SB : SType<"sb", 0x23, 0, "i">;
def RV_SH : SType<"sh", 0x23, 1, "i">;
def RV_SW : SType<"sw", 0x23, 2, "i">;
}
let Effects = LaneWise in {
def RV_ADDI : IType<"addi", 0x13, 0, "i">;
def RV_SLTI : IType<"slti", 0x13, 2, "i">;
def RV_SLTIU : IType<"sltiu", 0x13, 3, "i">;
def RV_XORI : IType<"xori", 0x13, 4, "i">;
def RV_ORI : IType<"ori", 0x13, 6, "i">;
def RV_ANDI : IType<"andi", 0x13, 7, "i">;
def RV_SLLI : ShiftType<"slli", 1, 0x00, "i">;
def RV_SRLI : ShiftType<"srli", 5, 0x00, "i">;
def RV_SRAI : ShiftType<"srai", 5, 0x20, "i">;
def RV_ADD : RType<"add", 0x33, 0, 0x00, "i">;
def RV_SUB : RType<"sub", 0x33, 0, 0x20, "i">;
def RV_SLL : RType<"sll", 0x33, 1, 0x00, "i">;
def RV_SLT : RType<"slt", 0x33, 2, 0x00, "i">;
def RV_SLTU : RType<"sltu", 0x33, 3, 0x00, "i">;
def RV_XOR : RType<"xor", 0x33, 4, 0x00, "i">;
def RV_SRL : RType<"srl", 0x33, 5, 0x00, "i">;
def RV_SRA : RType<"sra", 0x33, 5, 0x20, "i">;
def RV_OR : RType<"or", 0x33, 6, 0x00, "i">;
def RV_AND : RType<"and", 0x33, 7, 0x00, "i">;
}
// fence.tso and pause are fences too; fields that a fence does not use are
// ignored, as the specification asks.
let Latency = LatencyFence, Effects = Fence in
def RV_FENCE : Rv32<"fence", Plain, 0x0F, 0x707F, "fence", "i">;
let Latency = LatencyCsr, Effects = Trap in {
def RV_ECALL : Rv32<"ecall", Plain, 0x73, 0xFFFFFFFF, "", "i">;
def RV_EBREAK : Rv32<"ebreak", Plain, 0x100073, 0xFFFFFFFF, "", "i">;
}

// Zifencei, Zicsr
let Latency = LatencyFence, Effects = Fence in
def RV_FENCE_I : Rv32<"fence.i", Plain, 0x100F, 0x707F, "", "zifencei">;
let Latency = LatencyCsr in {
def RV_CSRRW : CsrType<"csrrw", 1>;
def RV_CSRRS : CsrType<"csrrs", 2>;
def RV_CSRRC : CsrType<"csrrc", 3>;
def RV_CSRRWI : CsrType<"csrrwi", 5>;
def RV_CSRRSI : CsrType<"csrrsi", 6>;
def RV_CSRRCI : CsrType<"csrrci", 7>;
}

// M
let Latency = LatencyMul, Effects = LaneWise in {
def RV_MUL : RType<"mul", 0x33, 0, 0x01, "m">;
def RV_MULH : RType<"mulh", 0x33, 1, 0x01, "m">;
def RV_MULHSU : RType<"mulhsu", 0x33, 2, 0x01, "m">;
def RV_MULHU : RType<"mulhu", 0x33, 3, 0x01, "m">;
}
let Latency = LatencyDiv, Effects = LaneWise in {
def RV_DIV : RType<"div", 0x33, 4, 0x01, "m">;
def RV_DIVU : RType<"divu", 0x33, 5, 0x01, "m">;
def RV_REM : RType<"rem", 0x33, 6, 0x01, "m">;
def RV_REMU : RType<"remu", 0x33, 7, 0x01, "m">;
}

// Zaamo, Zacas. The aq and rl bits are ignored (docs/abi.md, Order).
let Latency = LatencyAtomic in {
def RV_AMOADD_W : AmoType<"amoadd.w", 0x00, "zaamo">;
def RV_AMOSWAP_W : AmoType<"amoswap.w", 0x01, "zaamo">;
def RV_AMOXOR_W : AmoType<"amoxor.w", 0x04, "zaamo">;
def RV_AMOAND_W : AmoType<"amoand.w", 0x0C, "zaamo">;
def RV_AMOOR_W : AmoType<"amoor.w", 0x08, "zaamo">;
def RV_AMOMIN_W : AmoType<"amomin.w", 0x10, "zaamo">;
def RV_AMOMAX_W : AmoType<"amomax.w", 0x14, "zaamo">;
def RV_AMOMINU_W : AmoType<"amominu.w", 0x18, "zaamo">;
def RV_AMOMAXU_W : AmoType<"amomaxu.w", 0x1C, "zaamo">;
def RV_AMOCAS_W : AmoType<"amocas.w", 0x05, "zacas">;
def RV_AMOCAS_D : AmoPairType<"amocas.d", 0x05, "zacas">;
}

let Effects = LaneWise in {
// Zicond
def RV_CZERO_EQZ : RType<"czero.eqz", 0x33, 5, 0x07, "zicond">;
def RV_CZERO_NEZ : RType<"czero.nez", 0x33, 7, 0x07, "zicond">;

// Zba
def RV_SH1ADD : RType<"sh1add", 0x33, 2, 0x10, "zba">;
def RV_SH2ADD : RType<"sh2add", 0x33, 4, 0x10, "zba">;
def RV_SH3ADD : RType<"sh3add", 0x33, 6, 0x10, "zba">;

// Zbb
def RV_ANDN : RType<"andn", 0x33, 7, 0x20, "zbb">;
def RV_ORN : RType<"orn", 0x33, 6, 0x20, "zbb">;
def RV_XNOR : RType<"xnor", 0x33, 4, 0x20, "zbb">;
def RV_MIN : RType<"min", 0x33, 4, 0x05, "zbb">;
def RV_MINU : RType<"minu", 0x33, 5, 0x05, "zbb">;
def RV_MAX : RType<"max", 0x33, 6, 0x05, "zbb">;
def RV_MAXU : RType<"maxu", 0x33, 7, 0x05, "zbb">;
def RV_ROL : RType<"rol", 0x33, 1, 0x30, "zbb">;
def RV_ROR : RType<"ror", 0x33, 5, 0x30, "zbb">;
def RV_RORI : ShiftType<"rori", 5, 0x30, "zbb">;
def RV_CLZ : Unary<"clz", 0x13, 1, 0x30, 0, "zbb">;
def RV_CTZ : Unary<"ctz", 0x13, 1, 0x30, 1, "zbb">;
def RV_CPOP : Unary<"cpop", 0x13, 1, 0x30, 2, "zbb">;
def RV_SEXT_B : Unary<"sext.b", 0x13, 1, 0x30, 4, "zbb">;
def RV_SEXT_H : Unary<"sext.h", 0x13, 1, 0x30, 5, "zbb">;
def RV_ZEXT_H : Unary<"zext.h", 0x33, 4, 0x04, 0, "zbb">;
def RV_ORC_B : Unary<"orc.b", 0x13, 5, 0x14, 7, "zbb">;
def RV_REV8 : Unary<"rev8", 0x13, 5, 0x34, 24, "zbb">;

// Zbs
def RV_BCLR : RType<"bclr", 0x33, 1, 0x24, "zbs">;
def RV_BEXT : RType<"bext", 0x33, 5, 0x24, "zbs">;
def RV_BINV : RType<"binv", 0x33, 1, 0x34, "zbs">;
def RV_BSET : RType<"bset", 0x33, 1, 0x14, "zbs">;
def RV_BCLRI : ShiftType<"bclri", 1, 0x24, "zbs">;
def RV_BEXTI : ShiftType<"bexti", 5, 0x24, "zbs">;
def RV_BINVI : ShiftType<"binvi", 1, 0x34, "zbs">;
def RV_BSETI : ShiftType<"bseti", 1, 0x14, "zbs">;
}

// F
let Latency = LatencyLoad, Effects = Load in
def RV_FLW : IType<"flw", 0x07, 2, "f", "frd, imm(rs1)">;
let Latency = LatencyStore in
def RV_FSW : SType<"fsw", 0x27, 2, "f", "frs2, imm(rs1)">;
let Latency = LatencyFma, Effects = LaneWise in {
def RV_FMADD_S : FmaType<"fmadd.s", 0x43>;
def RV_FMSUB_S : FmaType<"fmsub.s", 0x47>;
def RV_FNMSUB_S : FmaType<"fnmsub.s", 0x4B>;
def RV_FNMADD_S : FmaType<"fnmadd.s", 0x4F>;
def RV_FADD_S : FRound<"fadd.s", 0x00>;
def RV_FSUB_S : FRound<"fsub.s", 0x04>;
def RV_FMUL_S : FRound<"fmul.s", 0x08>;
}
let Latency = LatencyFdiv, Effects = LaneWise in
def RV_FDIV_S : FRound<"fdiv.s", 0x0C>;
let Latency = LatencyFsqrt, Effects = LaneWise in
def RV_FSQRT_S : FRoundUnary<"fsqrt.s", 0x2C, 0, "frd, frs1, rm">;
let Latency = LatencyFcmp, Effects = LaneWise in {
def RV_FSGNJ_S : RType<"fsgnj.s", 0x53, 0, 0x10, "f", "frd, frs1, frs2">;
def RV_FSGNJN_S : RType<"fsgnjn.s", 0x53, 1, 0x10, "f", "frd, frs1, frs2">;
def RV_FSGNJX_S : RType<"fsgnjx.s", 0x53, 2, 0x10, "f", "frd, frs1, frs2">;
def RV_FMIN_S : RType<"fmin.s", 0x53, 0, 0x14, "f", "frd, frs1, frs2">;
def RV_FMAX_S : RType<"fmax.s", 0x53, 1, 0x14, "f", "frd, frs1, frs2">;
def RV_FLE_S : RType<"fle.s", 0x53, 0, 0x50, "f", "rd, frs1, frs2">;
def RV_FLT_S : RType<"flt.s", 0x53, 1, 0x50, "f", "rd, frs1, frs2">;
def RV_FEQ_S : RType<"feq.s", 0x53, 2, 0x50, "f", "rd, frs1, frs2">;
}
let Latency = LatencyFcvt, Effects = LaneWise in {
def RV_FCVT_W_S : FRoundUnary<"fcvt.w.s", 0x60, 0, "rd, frs1, rm">;
def RV_FCVT_WU_S : FRoundUnary<"fcvt.wu.s", 0x60, 1, "rd, frs1, rm">;
def RV_FCVT_S_W : FRoundUnary<"fcvt.s.w", 0x68, 0, "frd, rs1, rm">;
def RV_FCVT_S_WU : FRoundUnary<"fcvt.s.wu", 0x68, 1, "frd, rs1, rm">;
}
let Latency = LatencyFcmp, Effects = LaneWise in {
def RV_FMV_X_W : Unary<"fmv.x.w", 0x53, 0, 0x70, 0, "f", "rd, frs1">;
def RV_FCLASS_S : Unary<"fclass.s", 0x53, 1, 0x70, 0, "f", "rd, frs1">;
def RV_FMV_W_X : Unary<"fmv.w.x", 0x53, 0, 0x78, 0, "f", "frd, rs1">;
}
