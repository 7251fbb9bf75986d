/// Every CSR of the records (intrinsics/Csrs.td, RasterCsrs.td): its read, its
/// write by each of the six instructions, and what is not allowed.

#include "testing/ElfBuilder.h"
#include "testing/Instructions.h"
#include "testing/WarpRunner.h"
#include "vorion/isasim/Launch.h"
#include "vorion/isasim/Machine.h"

#include <functional>
#include <set>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr Op CsrOps[] = {Op::RV_CSRRW,  Op::RV_CSRRS,  Op::RV_CSRRC,
                         Op::RV_CSRRWI, Op::RV_CSRRSI, Op::RV_CSRRCI};
constexpr unsigned Results = 4; ///< words a lane that a program stores
constexpr uint32_t Untouched = 0x0DDC0DE5;

bool isImmediate(Op O) {
  return O == Op::RV_CSRRWI || O == Op::RV_CSRRSI || O == Op::RV_CSRRCI;
}

/// Bits that a write changes: the others read as 0.
uint32_t writable(const CsrInfo &C) {
  switch (C.Number) {
  case CSR_FFLAGS:
    return 0x1F;
  case CSR_FRM:
    return 0x7;
  case CSR_FCSR:
    return 0xFF;
  case CSR_LOCAL_OFFSET: // multiples of it within local memory
    return WarpRunner::smallShape().LocalBytes - uint32_t{LaunchAlignment};
  default:
    break;
  }
  // What a write does and not what it leaves.
  return C.Number == CSR_VR_START || C.Rule == WriteRule::Push ? 0 : ~0U;
}

Config oneCore() {
  Config C = WarpRunner::smallShape();
  C.HostThreads = 1;
  return C;
}

struct Ran {
  RunResult Result;
  std::array<Lanes16, Results> Out{};
};

/// Runs Body with the lanes of \p Mask; x5 has the lane, x6 to x8 words that
/// differ from lane to lane, x10 to x13 are stored, and keep Untouched in lanes
/// that are not active.
Ran run(uint32_t Mask, const std::vector<uint32_t> &Body) {
  std::vector<uint32_t> Code;
  loadConstant(Code, 20, 0xFFFF);
  Code.push_back(encode(Op::VX_TMC, {.Rs1 = 20}));
  loadConstant(Code, 20, 0xFFFF);
  Code.push_back(encode(Op::RV_CSRRS, {.Rd = 5, .Csr = CSR_THREAD_ID}));
  const uint32_t Steps[] = {0x01010101, 0x00300207, 0x10204081};
  for (unsigned N = 0; N != std::size(Steps); ++N) {
    loadConstant(Code, 6 + N, Steps[N]);
    Code.push_back(encode(Op::RV_MUL, {.Rd = 6 + N, .Rs1 = 6 + N, .Rs2 = 5}));
    Code.push_back(
        encode(Op::RV_XORI, {.Rd = 6 + N, .Rs1 = 6 + N, .Imm = 0x2A5}));
  }
  for (unsigned N = 0; N != Results; ++N)
    loadConstant(Code, 10 + N, Untouched);
  loadConstant(Code, 21, VX_GLOBAL_BASE);
  Code.push_back(encode(Op::RV_SH2ADD, {.Rd = 21, .Rs1 = 5, .Rs2 = 21}));
  loadConstant(Code, 22, Mask);
  Code.push_back(encode(Op::VX_TMC, {.Rs1 = 22}));
  Code.insert(Code.end(), Body.begin(), Body.end());
  Code.push_back(encode(Op::VX_TMC, {.Rs1 = 20}));
  for (unsigned N = 0; N != Results; ++N)
    Code.push_back(encode(
        Op::RV_SW,
        {.Rs1 = 21, .Rs2 = 10 + N, .Imm = static_cast<int32_t>(N * 64)}));
  Code.push_back(encode(Op::VX_TMC, {.Rs1 = 0}));
  auto M = std::move(*Machine::create(oneCore()));
  M->load(codeImage(Code));
  Ran R;
  R.Result = M->run();
  for (unsigned N = 0; N != Results; ++N)
    EXPECT_TRUE(M->read(VX_GLOBAL_BASE + N * 64,
                        std::as_writable_bytes(std::span(R.Out[N]))));
  return R;
}

Lanes16 laneValues(unsigned Register) {
  const uint32_t Steps[] = {0x01010101, 0x00300207, 0x10204081};
  Lanes16 V;
  for (uint32_t L = 0; L != MaxLanes; ++L)
    V[L] = (Steps[Register - 6] * L) ^ 0x2A5;
  return V;
}

uint32_t combined(Op O, uint32_t Old, uint32_t Operand) {
  switch (O) {
  case Op::RV_CSRRS:
  case Op::RV_CSRRSI:
    return Old | Operand;
  case Op::RV_CSRRC:
  case Op::RV_CSRRCI:
    return Old & ~Operand;
  default:
    return Operand;
  }
}

unsigned lastLane(uint32_t Mask) {
  return 31 - static_cast<unsigned>(__builtin_clz(Mask));
}

} // namespace

TEST(CsrRecords, EveryWritableCsrTakesEveryInstructionOnEveryMask) {
  constexpr uint32_t Immediate = 0x15;
  for (const CsrInfo &C : CsrTable) {
    if (C.Rule == WriteRule::None)
      continue;
    for (const uint32_t Mask : {0xFFFFU, 0x0001U, 0x8000U, 0x0A36U})
      for (const Op O : CsrOps) {
        // Written from x6, then by O from x7; x10 and x11 are what was there
        // before, x12 and x13 are read afterwards.
        const Ran R = run(
            Mask, {encode(Op::RV_CSRRW, {.Rd = 10, .Rs1 = 6, .Csr = C.Number}),
                   encode(O, {.Rd = 11,
                              .Rs1 = 7,
                              .Imm = static_cast<int32_t>(Immediate),
                              .Csr = C.Number}),
                   encode(Op::RV_CSRRS, {.Rd = 12, .Csr = C.Number}),
                   encode(Op::RV_CSRRSI, {.Rd = 13, .Csr = C.Number})});
        ASSERT_EQ(R.Result.End, Outcome::Done) << C.Name << R.Result.Report;
        const Lanes16 First = laneValues(6), Second = laneValues(7);
        for (unsigned L = 0; L != MaxLanes; ++L) {
          if (!(Mask >> L & 1)) {
            for (unsigned N = 0; N != Results; ++N)
              ASSERT_EQ(R.Out[N][L], Untouched) << C.Name << " lane " << L;
            continue;
          }
          const unsigned From = C.Rule == WriteRule::Lane ? L : lastLane(Mask);
          const uint32_t Old = First[From] & writable(C);
          const uint32_t New =
              combined(O, Old, isImmediate(O) ? Immediate : Second[From]) &
              writable(C);
          const char *Mnemonic = InsnTable[static_cast<unsigned>(O)].Mnemonic;
          ASSERT_EQ(R.Out[1][L], Old)
              << Mnemonic << " " << C.Name << " lane " << L;
          ASSERT_EQ(R.Out[2][L], New)
              << Mnemonic << " " << C.Name << " lane " << L;
          ASSERT_EQ(R.Out[3][L], New)
              << Mnemonic << " " << C.Name << " lane " << L;
        }
      }
  }
}

TEST(CsrRecords, ReadOnlyCsrsReadAndRefuseEveryWrite) {
  for (const CsrInfo &C : CsrTable) {
    if (C.Rule != WriteRule::None)
      continue;
    for (const Op O : CsrOps) {
      const Ran R = run(
          0xFFFF, {encode(O, {.Rd = 10, .Rs1 = 6, .Imm = 1, .Csr = C.Number})});
      ASSERT_EQ(R.Result.End, Outcome::Trap) << C.Name;
      ASSERT_EQ(R.Result.Fault.Cause, TrapCause::IllegalInstruction) << C.Name;
    }
    // x0 and 0 do not write, whatever other lanes hold.
    const Ran R =
        run(0x0A36, {encode(Op::RV_CSRRS, {.Rd = 10, .Csr = C.Number}),
                     encode(Op::RV_CSRRC, {.Rd = 11, .Csr = C.Number}),
                     encode(Op::RV_CSRRSI, {.Rd = 12, .Csr = C.Number}),
                     encode(Op::RV_CSRRCI, {.Rd = 13, .Csr = C.Number})});
    ASSERT_EQ(R.Result.End, Outcome::Done) << C.Name << R.Result.Report;
    for (unsigned N = 0; N != Results; ++N)
      for (unsigned L = 0; L != MaxLanes; ++L) {
        if (!(0x0A36 >> L & 1))
          ASSERT_EQ(R.Out[N][L], Untouched) << C.Name;
        else if (C.Uniform)
          ASSERT_EQ(R.Out[N][L], R.Out[N][1]) << C.Name << " lane " << L;
      }
  }
}

TEST(CsrRecords, LanesReadWhatIsTheirsWhereLanesDiffer) {
  // The read-only CSRs that differ from lane to lane, by what the records say.
  for (const CsrInfo &C : CsrTable)
    if (C.Rule == WriteRule::None && !C.Uniform && !C.Raster) {
      const Ran R =
          run(0xFFFF, {encode(Op::RV_CSRRS, {.Rd = 10, .Csr = C.Number})});
      for (unsigned L = 0; L != MaxLanes; ++L)
        EXPECT_EQ(R.Out[0][L], L) << C.Name; // core 0, warp 0
    }
}

TEST(CsrRecords, CountersCountRetiredWarpInstructions) {
  std::set<uint32_t> Low;
  for (const CsrInfo &C : CsrTable) {
    const std::string Name = C.Name;
    const bool Counts =
        Name.ends_with("cycle") || Name.ends_with("instret") || Name == "time";
    const bool High = Name.ends_with("cycleh") || Name.ends_with("instreth") ||
                      Name == "timeh";
    if (!Counts && !High)
      continue;
    const Ran R =
        run(0xFFFF, {encode(Op::RV_CSRRS, {.Rd = 10, .Csr = C.Number}),
                     encode(Op::RV_ADDI, {}), encode(Op::RV_ADDI, {}),
                     encode(Op::RV_CSRRS, {.Rd = 11, .Csr = C.Number})});
    EXPECT_EQ(R.Out[1][0] - R.Out[0][0], Counts ? 3U : 0U) << Name;
    if (Counts)
      Low.insert(R.Out[0][0]);
    else
      EXPECT_EQ(R.Out[0][0], 0U) << Name;
  }
  EXPECT_EQ(Low.size(), 1U); // all count the same
}

TEST(CsrRecords, NumbersOutsideTheRecordsAreIllegal) {
  std::set<unsigned> Known;
  for (const CsrInfo &C : CsrTable)
    Known.insert(C.Number);
  std::vector<uint32_t> Code;
  for (unsigned Number = 0; Number != 4096; ++Number)
    Code.push_back(encode(Op::RV_CSRRS, {.Rd = 10, .Csr = Number}));
  WarpRunner R(execTable(false), Code);
  for (unsigned Number = 0; Number != 4096; ++Number) {
    R.rewind();
    R.warp().Next = R.Code.begin() + Number;
    R.run(1);
    const bool Illegal = R.warp().Why == Stop::Trapped &&
                         R.cause() == TrapCause::IllegalInstruction &&
                         R.warp().Next == R.Code.begin() + Number;
    EXPECT_EQ(Illegal, !Known.contains(Number)) << std::hex << Number;
  }
}
