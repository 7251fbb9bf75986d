/// Every integer instruction on every vector level and mask, against the
/// specification written down once more a lane at a time.

#include "testing/WarpRunner.h"

#include <bit>
#include <functional>
#include <map>
#include <random>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

using Scalar = std::function<uint32_t(uint32_t, uint32_t)>;

int32_t s(uint32_t V) { return static_cast<int32_t>(V); }
uint32_t u(int64_t V) { return static_cast<uint32_t>(V); }

uint32_t carryless(uint32_t A) { // orc.b
  uint32_t R = 0;
  for (unsigned Byte = 0; Byte != 4; ++Byte)
    if (A >> (8 * Byte) & 0xFF)
      R |= 0xFFU << (8 * Byte);
  return R;
}

const std::map<Op, Scalar> &reference() {
  static const std::map<Op, Scalar> Table = {
      {Op::RV_ADD, [](auto A, auto B) { return A + B; }},
      {Op::RV_SUB, [](auto A, auto B) { return A - B; }},
      {Op::RV_SLL, [](auto A, auto B) { return A << (B % 32); }},
      {Op::RV_SRL, [](auto A, auto B) { return A >> (B % 32); }},
      {Op::RV_SRA, [](auto A, auto B) { return u(s(A) >> (B % 32)); }},
      {Op::RV_SLT, [](auto A, auto B) -> uint32_t { return s(A) < s(B); }},
      {Op::RV_SLTU, [](auto A, auto B) -> uint32_t { return A < B; }},
      {Op::RV_XOR, [](auto A, auto B) { return A ^ B; }},
      {Op::RV_OR, [](auto A, auto B) { return A | B; }},
      {Op::RV_AND, [](auto A, auto B) { return A & B; }},
      {Op::RV_MUL, [](auto A, auto B) { return u(int64_t{s(A)} * s(B)); }},
      {Op::RV_MULH,
       [](auto A, auto B) { return u(int64_t{s(A)} * s(B) >> 32); }},
      {Op::RV_MULHSU,
       [](auto A, auto B) { return u(int64_t{s(A)} * int64_t{B} >> 32); }},
      {Op::RV_MULHU,
       [](auto A, auto B) {
         return u(static_cast<int64_t>(uint64_t{A} * B >> 32));
       }},
      {Op::RV_DIV,
       [](auto A, auto B) { return B == 0 ? ~0U : u(int64_t{s(A)} / s(B)); }},
      {Op::RV_DIVU, [](auto A, auto B) { return B == 0 ? ~0U : A / B; }},
      {Op::RV_REM,
       [](auto A, auto B) { return B == 0 ? A : u(int64_t{s(A)} % s(B)); }},
      {Op::RV_REMU, [](auto A, auto B) { return B == 0 ? A : A % B; }},
      {Op::RV_CZERO_EQZ, [](auto A, auto B) { return B == 0 ? 0 : A; }},
      {Op::RV_CZERO_NEZ, [](auto A, auto B) { return B != 0 ? 0 : A; }},
      {Op::RV_SH1ADD, [](auto A, auto B) { return A * 2 + B; }},
      {Op::RV_SH2ADD, [](auto A, auto B) { return A * 4 + B; }},
      {Op::RV_SH3ADD, [](auto A, auto B) { return A * 8 + B; }},
      {Op::RV_ANDN, [](auto A, auto B) { return A & ~B; }},
      {Op::RV_ORN, [](auto A, auto B) { return A | ~B; }},
      {Op::RV_XNOR, [](auto A, auto B) { return ~(A ^ B); }},
      {Op::RV_MIN, [](auto A, auto B) { return u(std::min(s(A), s(B))); }},
      {Op::RV_MAX, [](auto A, auto B) { return u(std::max(s(A), s(B))); }},
      {Op::RV_MINU, [](auto A, auto B) { return std::min(A, B); }},
      {Op::RV_MAXU, [](auto A, auto B) { return std::max(A, B); }},
      {Op::RV_ROL, [](auto A, auto B) { return std::rotl(A, s(B % 32)); }},
      {Op::RV_ROR, [](auto A, auto B) { return std::rotr(A, s(B % 32)); }},
      {Op::RV_CLZ, [](auto A, auto) { return u(std::countl_zero(A)); }},
      {Op::RV_CTZ, [](auto A, auto) { return u(std::countr_zero(A)); }},
      {Op::RV_CPOP, [](auto A, auto) { return u(std::popcount(A)); }},
      {Op::RV_SEXT_B, [](auto A, auto) { return u(static_cast<int8_t>(A)); }},
      {Op::RV_SEXT_H, [](auto A, auto) { return u(static_cast<int16_t>(A)); }},
      {Op::RV_ZEXT_H, [](auto A, auto) { return A & 0xFFFF; }},
      {Op::RV_ORC_B, [](auto A, auto) { return carryless(A); }},
      {Op::RV_REV8, [](auto A, auto) { return __builtin_bswap32(A); }},
      {Op::RV_BCLR, [](auto A, auto B) { return A & ~(1U << (B % 32)); }},
      {Op::RV_BEXT, [](auto A, auto B) { return A >> (B % 32) & 1; }},
      {Op::RV_BINV, [](auto A, auto B) { return A ^ 1U << (B % 32); }},
      {Op::RV_BSET, [](auto A, auto B) { return A | 1U << (B % 32); }},
  };
  return Table;
}

/// Immediate forms and the instruction that they are a form of.
const std::map<Op, Op> &immediateForms() {
  static const std::map<Op, Op> Table = {
      {Op::RV_ADDI, Op::RV_ADD},   {Op::RV_SLTI, Op::RV_SLT},
      {Op::RV_SLTIU, Op::RV_SLTU}, {Op::RV_XORI, Op::RV_XOR},
      {Op::RV_ORI, Op::RV_OR},     {Op::RV_ANDI, Op::RV_AND},
      {Op::RV_SLLI, Op::RV_SLL},   {Op::RV_SRLI, Op::RV_SRL},
      {Op::RV_SRAI, Op::RV_SRA},   {Op::RV_RORI, Op::RV_ROR},
      {Op::RV_BCLRI, Op::RV_BCLR}, {Op::RV_BEXTI, Op::RV_BEXT},
      {Op::RV_BINVI, Op::RV_BINV}, {Op::RV_BSETI, Op::RV_BSET}};
  return Table;
}

Lanes16 operands(std::mt19937 &Random) {
  static constexpr uint32_t Special[] = {
      0,          1,          2,          31,         32,         0x7FFFFFFF,
      0x80000000, 0xFFFFFFFF, 0xFFFFFFFE, 0x0000FFFF, 0x00010000, 0x80808080};
  Lanes16 V;
  for (uint32_t &Lane : V)
    Lane = Random() % 2 ? static_cast<uint32_t>(Random())
                        : Special[Random() % std::size(Special)];
  return V;
}

constexpr uint32_t Untouched = 0xDEADBEEF;

/// Runs O with the registers of F under every mask and compares each lane. No
/// flag is set, whatever the host's instructions compute with.
void check(const ExecTable &Table, Op O, const Fields &F,
           const Scalar &Expected, std::mt19937 &Random) {
  WarpRunner R(Table, {encode(O, F)});
  for (const uint32_t Mask : MaskPatterns) {
    const Lanes16 A = operands(Random), B = operands(Random);
    Lanes16 Old;
    Old.fill(Untouched);
    R.setX(12, Old);
    R.setX(10, A);
    R.setX(11, B);
    R.setActive(Mask);
    R.rewind();
    R.run();
    ASSERT_TRUE(R.ranToEnd());
    ASSERT_EQ(R.warp().Fflags, 0U)
        << InsnTable[static_cast<unsigned>(O)].Mnemonic << " on "
        << Table.Level;
    const Lanes16 Before = F.Rd == 10 ? A : Old;
    const Lanes16 Got = R.getX(F.Rd);
    const bool Immediate = immediateForms().contains(O);
    for (unsigned L = 0; L != MaxLanes; ++L) {
      const uint32_t Second = Immediate ? static_cast<uint32_t>(F.Imm) : B[L];
      const uint32_t Want = Mask >> L & 1 ? Expected(A[L], Second) : Before[L];
      ASSERT_EQ(Got[L], Want)
          << InsnTable[static_cast<unsigned>(O)].Mnemonic << " on "
          << Table.Level << std::hex << " a " << A[L] << " b " << Second
          << " lane " << L << " mask " << Mask;
    }
  }
}

} // namespace

TEST(Integer, EveryRegisterInstructionOnEveryMask) {
  std::mt19937 Random(7);
  for (const ExecTable *Table : allTables())
    for (const auto &[O, Expected] : reference())
      for (const unsigned Rd : {12U, 10U}) // the second overwrites an operand
        check(*Table, O, {.Rd = Rd, .Rs1 = 10, .Rs2 = 11}, Expected, Random);
}

TEST(Integer, EveryImmediateInstructionOnEveryMask) {
  std::mt19937 Random(8);
  for (const ExecTable *Table : allTables())
    for (const auto &[O, Base] : immediateForms())
      for (int Try = 0; Try != 8; ++Try) {
        const bool IsShift =
            InsnTable[static_cast<unsigned>(O)].Fmt == Format::IShift;
        const int32_t Imm = IsShift ? static_cast<int32_t>(Random() % 32)
                                    : static_cast<int32_t>(Random()) >> 20;
        check(*Table, O, {.Rd = 12, .Rs1 = 10, .Imm = Imm},
              reference().at(Base), Random);
      }
}

TEST(Integer, TablesCoverEveryIntegerInstruction) {
  for (unsigned N = 0; N != NumOps; ++N) {
    const InsnInfo &I = InsnTable[N];
    const bool IsInteger = (I.Match & 0x7F) == 0x33 || (I.Match & 0x7F) == 0x13;
    if (IsInteger)
      EXPECT_TRUE(reference().contains(static_cast<Op>(N)) ||
                  immediateForms().contains(static_cast<Op>(N)))
          << I.Mnemonic;
  }
}

TEST(Integer, X0StaysZero) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::RV_ADDI, {.Rd = 0, .Imm = 5}),
                          encode(Op::RV_ADD, {.Rd = 5, .Rs1 = 0, .Rs2 = 0}),
                          encode(Op::RV_LUI, {.Rd = 0, .Imm = 5})});
    R.run();
    EXPECT_EQ(R.getX(5), Lanes16{});
    EXPECT_EQ(R.getX(0), Lanes16{});
  }
}

TEST(Integer, UpperImmediates) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::RV_LUI, {.Rd = 5, .Imm = 0xABCDE}),
                          encode(Op::RV_AUIPC, {.Rd = 6, .Imm = 0x80001})});
    R.setActive(0x8001);
    R.run();
    EXPECT_EQ(R.getX(5)[0], 0xABCDE000U);
    EXPECT_EQ(R.getX(5)[15], 0xABCDE000U);
    EXPECT_EQ(R.getX(5)[1], 0U);
    // Address 0x80000004 plus 0x80001000, modulo 2^32.
    EXPECT_EQ(R.getX(6)[0], 0x00001004U);
  }
}

TEST(Integer, CountsWarpAndLaneInstructions) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::RV_ADDI, {.Rd = 5, .Imm = 5}),
                          encode(Op::RV_ADDI, {.Rd = 5, .Imm = 5}),
                          encode(Op::RV_ADDI, {.Rd = 5, .Imm = 5})});
    R.setActive(0x0013);
    R.run();
    EXPECT_EQ(R.warp().Count.WarpInstructions, 3U);
    EXPECT_EQ(R.warp().Count.LaneInstructions, 9U);
  }
}
