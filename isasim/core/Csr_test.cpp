/// Accesses to control and status registers, on every vector level.

#include "testing/Instructions.h"
#include "testing/WarpRunner.h"

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

TEST(Csr, IdentifiesLanesAndMachine) {
  for (const ExecTable *Table : allTables()) {
    std::vector<uint32_t> Words;
    const std::pair<unsigned, uint32_t> Uniform[] = {
        {CSR_WARP_ID, 0},       {CSR_CORE_ID, 0},
        {CSR_ACTIVE_WARPS, 1},  {CSR_ACTIVE_THREADS, 0x0FF0},
        {CSR_NUM_THREADS, 16},  {CSR_NUM_WARPS, 1},
        {CSR_NUM_CORES, 1},     {CSR_LOCAL_BASE, 0xFFFF0000},
        {CSR_NUM_BARRIERS, 16}, {CSR_STACK_SIZE, 64 << 10},
        {CSR_NUM_SOCKETS, 1},   {CSR_NUM_CLUSTERS, 1},
        {CSR_MSCRATCH, 0}};
    for (unsigned N = 0; N != std::size(Uniform); ++N)
      Words.push_back(csrr(10 + N, Uniform[N].first));
    Words.push_back(csrr(5, CSR_THREAD_ID));
    Words.push_back(csrr(6, CSR_MHARTID));
    Words.push_back(csrr(7, CSR_CYCLE));
    WarpRunner R(*Table, Words);
    R.setActive(0x0FF0);
    R.run();
    ASSERT_TRUE(R.ranToEnd());
    for (unsigned N = 0; N != std::size(Uniform); ++N)
      EXPECT_EQ(R.getX(10 + N)[4], Uniform[N].second) << Uniform[N].first;
    EXPECT_EQ(R.getX(5)[11], 11U);
    EXPECT_EQ(R.getX(6)[11], 11U);
    EXPECT_EQ(R.getX(5)[12], 0U);                    // not active
    EXPECT_EQ(R.getX(7)[4], std::size(Uniform) + 2); // retired before it
  }
}

TEST(Csr, ScalarWritesTakeTheLastActiveLane) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(
        *Table,
        {encode(Op::RV_CSRRW, {.Rd = 11, .Rs1 = 10, .Csr = CSR_MSCRATCH}),
         encode(Op::RV_CSRRSI, {.Rd = 12, .Imm = 16, .Csr = CSR_MSCRATCH}),
         encode(Op::RV_CSRRCI, {.Rd = 13, .Imm = 1, .Csr = CSR_MSCRATCH}),
         csrr(14, CSR_MSCRATCH)});
    R.setX(10, laneNumbers());
    R.setActive(0x0A2A); // last: 11
    R.run();
    ASSERT_TRUE(R.ranToEnd());
    EXPECT_EQ(R.getX(11)[1], 0U);
    EXPECT_EQ(R.getX(12)[1], 11U);
    EXPECT_EQ(R.getX(13)[1], 27U);
    EXPECT_EQ(R.getX(14)[1], 26U);
  }
}

TEST(Csr, IllegalAccessesTrap) {
  for (const uint32_t Word :
       {csrr(10, 0x7FF),
        encode(Op::RV_CSRRW, {.Rd = 10, .Rs1 = 0, .Csr = CSR_THREAD_ID}),
        encode(Op::RV_CSRRS, {.Rd = 10, .Rs1 = 11, .Csr = CSR_CYCLE}),
        encode(Op::RV_CSRRWI, {.Rd = 0, .Imm = 0, .Csr = CSR_VR_STATUS})}) {
    WarpRunner R(execTable(false), {Word});
    R.run();
    EXPECT_EQ(R.cause(), TrapCause::IllegalInstruction) << std::hex << Word;
  }
}

TEST(Csr, RasterAccessesPark) {
  WarpRunner R(
      execTable(false),
      {encode(Op::RV_CSRRW, {.Rd = 0, .Rs1 = 10, .Csr = CSR_VR_MODE})});
  R.run();
  EXPECT_EQ(R.warp().Why, Stop::RasterCsr);
}
