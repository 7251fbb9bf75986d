#include "timing/OpClass.h"

#include "core/Isa.h"

namespace vorion::isasim {

std::string_view name(OpClass C) {
  return C == OpClass::Count ? "" : LatencyTable[static_cast<size_t>(C)].Name;
}

OpClass classOf(uint32_t Word) {
  const std::optional<Decoded> D = decode(Word);
  // What cannot be decoded traps.
  return D ? ClassOfOp[static_cast<size_t>(D->O)] : OpClass::Alu;
}

static constexpr const LatencyInfo &costOf(OpClass C) {
  return LatencyTable[static_cast<size_t>(C)];
}

// The defaults of the parameters are the table's, which the compiler has, too.
static constexpr CoreTiming Defaults;

static_assert(Defaults.AluLatency == costOf(OpClass::Alu).Cycles);
static_assert(Defaults.MulLatency == costOf(OpClass::Mul).Cycles);
static_assert(Defaults.DivLatency == costOf(OpClass::Div).Cycles);
static_assert(Defaults.DivInterval == costOf(OpClass::Div).Interval);
static_assert(Defaults.FmaLatency == costOf(OpClass::Fma).Cycles);
static_assert(Defaults.FcmpLatency == costOf(OpClass::Fcmp).Cycles);
static_assert(Defaults.FcvtLatency == costOf(OpClass::Fcvt).Cycles);
static_assert(Defaults.FdivLatency == costOf(OpClass::Fdiv).Cycles);
static_assert(Defaults.FdivInterval == costOf(OpClass::Fdiv).Interval);
static_assert(Defaults.FsqrtLatency == costOf(OpClass::Fsqrt).Cycles);
static_assert(Defaults.SimtLatency == costOf(OpClass::Simt).Cycles);
static_assert(Defaults.CsrLatency == costOf(OpClass::Csr).Cycles);
static_assert(Defaults.AguCycles + L2Timing{}.HitCycles ==
              costOf(OpClass::Load).Cycles);

static void setCost(OpInfo &I, const CoreTiming &P) {
  I.On = costOf(I.Class).On;
  const auto Set = [&I](uint32_t Latency, uint32_t Interval = 1) {
    I.Latency = static_cast<uint8_t>(Latency);
    I.Interval = static_cast<uint8_t>(Interval);
  };
  switch (I.Class) {
  case OpClass::Mul:
    return Set(P.MulLatency);
  case OpClass::Fma:
    return Set(P.FmaLatency);
  case OpClass::Fcmp:
    return Set(P.FcmpLatency);
  case OpClass::Fcvt:
    return Set(P.FcvtLatency);
  case OpClass::Div:
    return Set(P.DivLatency, P.DivInterval);
  case OpClass::Fdiv:
    return Set(P.FdivLatency, P.FdivInterval);
  case OpClass::Fsqrt:
    return Set(P.FsqrtLatency, P.FdivInterval);
  case OpClass::Simt:
    return Set(P.SimtLatency);
  case OpClass::Csr:
    return Set(P.CsrLatency);
  case OpClass::Alu:
  case OpClass::Branch: // jal and jalr write the address behind them
  case OpClass::Mask:
  case OpClass::Barrier:
    return Set(P.AluLatency);
  case OpClass::Load: // the memory system adds its time
  case OpClass::Store:
  case OpClass::Atomic:
  case OpClass::Fence:
    return Set(1);
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
