#include "timing/core/OpClass.h"

#include "core/Isa.h"

#include <algorithm>

namespace vorion::isasim {

std::string_view name(OpClass C) {
  return C == OpClass::Count ? "" : LatencyTable[static_cast<size_t>(C)].Name;
}

OpClass classOf(uint32_t Word) {
  const std::optional<Decoded> D = decode(Word);
  // What cannot be decoded traps.
  return D ? ClassOfOp[static_cast<size_t>(D->Opcode)] : OpClass::Alu;
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

/// Cycles from beginning to result, as the unit's own numbers say.
static uint32_t latencyOf(OpClass C, const CoreTiming &P) {
  switch (C) {
  case OpClass::Mul:
    return P.MulLatency;
  case OpClass::Fma:
    return P.FmaLatency;
  case OpClass::Fcmp:
    return P.FcmpLatency;
  case OpClass::Fcvt:
    return P.FcvtLatency;
  case OpClass::Div:
    return P.DivLatency;
  case OpClass::Fdiv:
    return P.FdivLatency;
  case OpClass::Fsqrt:
    return P.FsqrtLatency;
  case OpClass::Simt:
    return P.SimtLatency;
  case OpClass::Csr:
    return P.CsrLatency;
  case OpClass::Alu:
  case OpClass::Branch: // jal and jalr write the address behind them
  case OpClass::Mask:
  case OpClass::Barrier:
    return P.AluLatency;
  case OpClass::Load: // the memory system adds its time
  case OpClass::Store:
  case OpClass::Atomic:
  case OpClass::Fence:
  case OpClass::Count:
    break;
  }
  return 0;
}

static Port portOf(OpClass C, const CoreTiming &P) {
  switch (C) {
  case OpClass::Fma:
  case OpClass::Fcmp:
  case OpClass::Fcvt:
  case OpClass::Fdiv:
  case OpClass::Fsqrt:
    if (P.Fpu)
      return Port::Fpu;
    break;
  case OpClass::Div:
  case OpClass::Simt:
  case OpClass::Branch:
    if (P.Fpu)
      return Port::Alu;
    break;
  default:
    break;
  }
  switch (costOf(C).On) {
  case Unit::Sfu:
    return Port::Sfu;
  case Unit::Lsu:
    return Port::Lsu;
  case Unit::Alu:
  case Unit::Count:
    break;
  }
  return Port::Alu;
}

uint32_t passes(Port On, const CoreTiming &P, unsigned Lanes) {
  const uint32_t AtOnce = On == Port::Alu   ? P.AluLanes
                          : On == Port::Sfu ? P.SfuLanes
                          : On == Port::Lsu ? P.LsuLanes
                                            : P.FpuLanes;
  return (Lanes + AtOnce - 1) / AtOnce;
}

/// How many of an instruction's sources have to wait for another one's bank.
static uint32_t bankConflicts(const OpInfo &O, uint32_t Banks) {
  if (Banks == 0)
    return 0;
  uint32_t Most = 1;
  for (unsigned N = 1; N != std::size(O.Sources); ++N) {
    uint32_t Same = 1;
    for (unsigned K = 0; K != N; ++K)
      Same += O.Sources[N] && O.Sources[K] &&
              O.Sources[K] % Banks == O.Sources[N] % Banks;
    Most = std::max(Most, Same);
  }
  return Most - 1;
}

/// Cycles to the next instruction as the front end has it.
static uint32_t redirectOf(Op Name, OpClass C, const CoreTiming &P) {
  switch (C) {
  case OpClass::Branch:
    return P.BranchCycles;
  case OpClass::Csr:
    return P.CsrCycles;
  case OpClass::Mask:
    if (Name != Op::VX_JOIN)
      return P.SplitCycles;
    // Where it takes no longer than any other it is done by the decoder, and
    // the front end does not wait for it.
    return P.JoinCycles == P.FetchInterval ? 1 : P.JoinCycles;
  case OpClass::Barrier:
    return P.SplitCycles;
  default:
    return 1;
  }
}

static void setCost(OpInfo &O, Op Name, const CoreTiming &P, unsigned Lanes) {
  O.On = portOf(O.Class, P);
  const uint32_t Passes = passes(O.On, P, Lanes);
  const uint32_t Busy = O.Class == OpClass::Div ? P.DivInterval
                        : O.Class == OpClass::Fdiv || O.Class == OpClass::Fsqrt
                            ? P.FdivInterval
                            : 1;
  const uint32_t Own = latencyOf(O.Class, P);
  const uint32_t Conflicts = bankConflicts(O, P.RegisterBanks);
  const uint32_t Delay = O.On == Port::Lsu ? P.LoadUseDelay : P.UseDelay;
  O.Latency = static_cast<uint16_t>(Own + Delay + Conflicts + Passes - 1);
  O.Interval = static_cast<uint16_t>(Busy * Passes);
  O.Hold = 0;
  if (O.On == Port::Fpu && P.FpInFlight) {
    O.Hold = static_cast<uint16_t>(Own + P.FpHold + Passes - 1);
  } else if (O.On == Port::Alu && O.Class == OpClass::Div) {
    // The divider works while other ALU operations begin.
    O.Hold = O.Interval;
    O.Interval = static_cast<uint16_t>(Passes);
  }
  O.IsLight = O.Interval == 1 && !(O.On == Port::Alu && O.Hold);
  const uint32_t Redirect = redirectOf(Name, O.Class, P);
  O.Redirect = static_cast<uint8_t>(Redirect > 1 ? Redirect + Conflicts : 0);
}

static bool isPlain(const OpInfo &O) {
  switch (O.Class) {
  case OpClass::Load:
  case OpClass::Store:
  case OpClass::Atomic:
  case OpClass::Fence:
  case OpClass::Barrier:
    return false;
  default:
    return !O.Spawns;
  }
}

std::vector<OpInfo> describeProgram(const CodeTable &Code,
                                    const CoreTiming &Params, unsigned Lanes) {
  std::vector<OpInfo> All(Code.count() + 1);
  const auto Register = [](uint16_t Offset) {
    return static_cast<uint8_t>(Offset / sizeof(LaneWords));
  };
  for (uint32_t N = 0; N != All.size(); ++N) {
    const Insn &I = Code.begin()[N];
    OpInfo &O = All[N];
    const std::optional<Decoded> D = decode(I.Word);
    O.Class = classOf(I.Word);
    O.Rd = Register(I.Rd);
    O.Sources[0] = Register(I.Rs1);
    O.Sources[1] = Register(I.Rs2);
    // Where the third is no source it is the destination, which an instruction
    // waits for anyway.
    O.Sources[2] = D && D->info().Fmt == Format::R4 ? Register(I.Rs3) : 0;
    if (D && D->info().Pairs) {
      if (D->Rd != 0)
        O.HighRd = O.Rd + 1;
      if (D->Rs2 != 0)
        O.Sources[2] = O.Sources[1] + 1;
    }
    O.Spawns = D && D->Opcode == Op::VX_WSPAWN;
    O.IsPlain = isPlain(O);
    setCost(O, D ? D->Opcode : Op::RV_ADDI, Params, Lanes);
  }
  return All;
}

} // namespace vorion::isasim
