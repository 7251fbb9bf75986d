/// Cores run in rounds, so that neither the host's threads nor observers change
/// what a program computes.

#include "machine/MachineTest.h"
#include "vorion/isasim/Observer.h"

#include <bit>
#include <cstring>
#include <string>

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

/// Every lane of every core draws numbers from one counter and signs the slot
/// of each number; every core also swaps and writes to the console. Who gets
/// which number shows in memory.
std::vector<uint32_t> drawNumbers() {
  return onAllLanes(
      {lui(10, Counter), lui(11, Slots), csrr(12, CSR_MHARTID), addi(13, 0, 40),
       // loop:
       addi(14, 0, 1),
       encode(Op::RV_AMOADD_W, {.Rd = 15, .Rs1 = 10, .Rs2 = 14}),
       encode(Op::RV_SH2ADD, {.Rd = 16, .Rs1 = 15, .Rs2 = 11}), sw(12, 0, 16),
       addi(17, 10, 64),
       encode(Op::RV_AMOSWAP_W, {.Rd = 18, .Rs1 = 17, .Rs2 = 12}),
       encode(Op::RV_XOR, {.Rd = 19, .Rs1 = 19, .Rs2 = 18}),
       encode(Op::RV_ANDI, {.Rd = 20, .Rs1 = 15, .Imm = 15}), addi(20, 20, 'a'),
       sw(20, 0x40, 0), addi(13, 13, -1), bne(13, 0, -11 * 4), // to loop
       addi(21, 0, '\n'), encode(Op::VX_TMC, {.Rs1 = 14}), sw(21, 0x40, 0),
       // The sum of the swaps, by core.
       csrr(22, CSR_CORE_ID),
       encode(Op::RV_SH2ADD, {.Rd = 23, .Rs1 = 22, .Rs2 = 10}),
       sw(19, 128, 23)});
}

struct Snapshot {
  std::vector<std::byte> Memory;
  std::string Console;
  RunResult Result;
};

Snapshot runWith(unsigned Threads, uint32_t Quantum) {
  Config C = smallConfig();
  C.HostThreads = Threads;
  C.Quantum = Quantum;
  const auto M = machineFor(C, drawNumbers());
  Snapshot S;
  M->setConsole([&](std::string_view Text) { S.Console += Text; });
  S.Result = M->run();
  S.Memory.resize(0x10000);
  EXPECT_TRUE(M->read(VX_GLOBAL_BASE, S.Memory));
  return S;
}

class Counting : public Observer {
public:
  void commit(const Commit &C) override {
    ++Instructions;
    Lanes += static_cast<unsigned>(std::popcount(C.LaneMask));
    if (C.Word == addi(21, 0, '\n')) {
      ++LineEnds;
      EXPECT_EQ(C.Result[3], uint32_t{'\n'});
    }
  }
  uint64_t Instructions = 0, Lanes = 0, LineEnds = 0;
};

} // namespace

TEST(Machine, ThreadsChangeNothing) {
  const Snapshot One = runWith(1, 1 << 16);
  EXPECT_EQ(One.Result.End, Outcome::Done);
  uint32_t Drawn = 0;
  std::memcpy(&Drawn, One.Memory.data(), 4);
  EXPECT_EQ(Drawn, 8U * 16 * 40);
  for (const unsigned Threads : {2U, 3U, 8U, 13U})
    for (int Try = 0; Try != 5; ++Try) {
      const Snapshot Many = runWith(Threads, 1 << 16);
      EXPECT_EQ(Many.Memory, One.Memory) << Threads << " threads";
      EXPECT_EQ(Many.Console, One.Console);
      EXPECT_EQ(Many.Result.SyncPoints, One.Result.SyncPoints);
      EXPECT_EQ(Many.Result.Total.WarpInstructions,
                One.Result.Total.WarpInstructions);
    }
}

TEST(Machine, ThreadsChangeNothingWithAShortQuantum) {
  const Snapshot One = runWith(1, 7);
  EXPECT_EQ(One.Result.End, Outcome::Done);
  for (const unsigned Threads : {2U, 5U})
    EXPECT_EQ(runWith(Threads, 7).Memory, One.Memory);
}

TEST(Machine, ParkedAtomicsRunInCoreAndLaneOrder) {
  // One draw by each lane: all cores park at it together.
  const auto M = machineFor(
      smallConfig(),
      onAllLanes({lui(10, Counter), lui(11, Slots), csrr(12, CSR_MHARTID),
                  addi(14, 0, 1),
                  encode(Op::RV_AMOADD_W, {.Rd = 15, .Rs1 = 10, .Rs2 = 14}),
                  encode(Op::RV_SH2ADD, {.Rd = 16, .Rs1 = 15, .Rs2 = 11}),
                  sw(12, 0, 16)}));
  const RunResult R = M->run();
  EXPECT_EQ(R.End, Outcome::Done);
  EXPECT_EQ(R.Total.Parks, 8U);
  for (uint32_t N = 0; N != 128; ++N)
    EXPECT_EQ(wordAt(*M, Slots + 4 * N), N);
}

TEST(Machine, ObserverSeesEveryInstructionAndChangesNothing) {
  const Snapshot Plain = runWith(2, 1 << 16);
  const auto M = machineFor(smallConfig(), drawNumbers());
  Counting Watch;
  M->setObservers({&Watch});
  M->setConsole(nullptr);
  const RunResult R = M->run();
  EXPECT_EQ(Watch.Instructions, R.Total.WarpInstructions);
  EXPECT_EQ(Watch.Lanes, R.Total.LaneInstructions);
  EXPECT_EQ(Watch.LineEnds, 8U); // one a core
  EXPECT_EQ(R.Total.WarpInstructions, Plain.Result.Total.WarpInstructions);
  std::vector<std::byte> Memory(Plain.Memory.size());
  EXPECT_TRUE(M->read(VX_GLOBAL_BASE, Memory));
  EXPECT_EQ(Memory, Plain.Memory);
  // And the machine runs unobserved again.
  M->setObservers({});
  EXPECT_EQ(M->run().End, Outcome::Done);
  EXPECT_EQ(Watch.Instructions, R.Total.WarpInstructions);
}

TEST(Machine, StacksOfOtherCoresAreLeftAlone) {
  // Five lanes a core: stacks of several cores share lines on the host. Each
  // lane counts on its own stack, half of them under a split.
  Config C = smallConfig();
  C.LanesPerWarp = 5;
  C.StackBytes = 4096;
  for (const unsigned Threads : {1U, 4U}) {
    C.HostThreads = Threads;
    const auto M = machineFor(
        C,
        {addi(5, 0, 31), encode(Op::VX_TMC, {.Rs1 = 5}), lui(10, VX_STACK_TOP),
         csrr(11, CSR_MHARTID),
         encode(Op::RV_SLLI, {.Rd = 12, .Rs1 = 11, .Imm = 12}),
         encode(Op::RV_SUB, {.Rd = 10, .Rs1 = 10, .Rs2 = 12}), sw(0, -4, 10),
         lui(13, 0x4000), encode(Op::RV_ANDI, {.Rd = 14, .Rs1 = 11, .Imm = 1}),
         // loop:
         encode(Op::VX_SPLIT, {.Rd = 15, .Rs1 = 14}), lw(16, -4, 10),
         addi(16, 16, 1), sw(16, -4, 10), encode(Op::VX_JOIN, {.Rs1 = 15}),
         addi(13, 13, -1), bne(13, 0, -6 * 4), encode(Op::VX_TMC, {.Rs1 = 0})});
    ASSERT_EQ(M->run().End, Outcome::Done);
    for (uint32_t Hart = 0; Hart != 40; ++Hart)
      EXPECT_EQ(wordAt(*M, VX_STACK_TOP - Hart * 4096 - 4), 0x4000U) << Hart;
  }
}
