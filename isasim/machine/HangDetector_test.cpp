/// Loops that can never end are found, and those that only take long are not.

#include "machine/MachineTest.h"

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

TEST(Machine, LoopThatWaitsInVainIsAHang) {
  // All cores read a word that nobody writes.
  const auto M = machineFor(
      smallConfig(), {lui(10, Slots), lw(11, 0, 10),
                      encode(Op::RV_BEQ, {.Rs1 = 11, .Rs2 = 0, .Imm = -4}),
                      encode(Op::VX_TMC, {.Rs1 = 0})});
  const RunResult R = M->run();
  EXPECT_EQ(R.End, Outcome::Hang);
  EXPECT_NE(R.Report.find("core.warp 0.0 1.0 2.0 3.0 4.0 5.0 6.0 7.0: running"),
            std::string::npos)
      << R.Report;
}

TEST(Machine, CountingLoopIsNoHang) {
  Config C = oneCore();
  C.Quantum = 2; // many rounds without a store
  const auto M =
      machineFor(C, {lui(10, 0x4000), addi(10, 10, -1), bne(10, 0, -4),
                     encode(Op::VX_TMC, {.Rs1 = 0})});
  EXPECT_EQ(M->run().End, Outcome::Done);
}

TEST(Machine, WaitingForTheCycleCounterIsNoHang) {
  Config C = oneCore();
  C.Quantum = 16;
  // The register that is compared is the same for thousands of rounds.
  const auto M =
      machineFor(C, {csrr(10, CSR_CYCLE),
                     encode(Op::RV_SRLI, {.Rd = 10, .Rs1 = 10, .Imm = 15}),
                     encode(Op::RV_BEQ, {.Rs1 = 10, .Rs2 = 0, .Imm = -8}),
                     encode(Op::VX_TMC, {.Rs1 = 0})});
  EXPECT_EQ(M->run().End, Outcome::Done);
}
