/// The machine as its users see it: runs and how they end, memory, console.

#include "machine/MachineTest.h"

#include <algorithm>

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

TEST(Machine, AWspawnToNoCodeNamesTheAddress) {
  Config C = smallConfig();
  C.WarpsPerCore = 4;
  for (const auto &[Address, Cause] :
       {std::pair{0x12345000U, TrapCause::FetchFault},
        std::pair{VX_IMAGE_BASE + 2, TrapCause::MisalignedFetch}}) {
    std::vector<uint32_t> Words = {lui(6, Address), addi(6, 6, Address & 0xFFF),
                                   addi(7, 0, 3),
                                   encode(Op::VX_WSPAWN, {.Rs1 = 7, .Rs2 = 6})};
    const RunResult R = machineFor(C, Words)->run();
    EXPECT_EQ(R.End, Outcome::Trap);
    EXPECT_EQ(R.Fault.Cause, Cause);
    EXPECT_EQ(R.Fault.Address, Address);
    EXPECT_EQ(R.Fault.Pc, VX_IMAGE_BASE + 12);
    EXPECT_EQ(R.Fault.Warp, 0U);
    // Nobody goes there if no warp is free.
    Words[2] = addi(7, 0, 1);
    Words.push_back(encode(Op::VX_TMC, {.Rs1 = 0}));
    EXPECT_EQ(machineFor(C, Words)->run().End, Outcome::Done);
  }
}

TEST(Machine, LocalMemoryIsACoresOwnAndStartsZeroed) {
  // Each core adds its number + 1 to its local word and copies it out.
  const auto M =
      machineFor(smallConfig(),
                 {lui(10, VX_LOCAL_BASE), csrr(11, CSR_CORE_ID), lw(12, 0, 10),
                  encode(Op::RV_ADD, {.Rd = 12, .Rs1 = 12, .Rs2 = 11}),
                  addi(12, 12, 1), sw(12, 0, 10), lui(13, Slots),
                  encode(Op::RV_SH2ADD, {.Rd = 13, .Rs1 = 11, .Rs2 = 13}),
                  sw(12, 0, 13), encode(Op::VX_TMC, {.Rs1 = 0})});
  for (int Run = 0; Run != 2; ++Run) {
    EXPECT_EQ(M->run().End, Outcome::Done);
    for (uint32_t Core = 0; Core != 8; ++Core)
      EXPECT_EQ(wordAt(*M, Slots + 4 * Core), Core + 1);
  }
}

TEST(Machine, DataStaysBetweenRunsUntilTheNextLoad) {
  ElfOptions O;
  constexpr uint32_t Data = VX_IMAGE_BASE + 0x1000;
  O.Segments = {{VX_IMAGE_BASE,
                 PF_R | PF_X,
                 {lui(10, Data), lw(11, 0, 10), addi(11, 11, 1), sw(11, 0, 10),
                  lw(12, 4, 10), addi(12, 12, 5), sw(12, 4, 10),
                  encode(Op::VX_TMC, {.Rs1 = 0})},
                 0},
                {Data, PF_R | PF_W, {41}, 4}};
  const auto Program = Image::parse(buildElf(O), "test");
  ASSERT_TRUE(Program);
  const auto M = Machine::create(oneCore());
  ASSERT_TRUE(M);
  (*M)->load(*Program);
  EXPECT_EQ((*M)->run().End, Outcome::Done);
  EXPECT_EQ((*M)->run().End, Outcome::Done);
  EXPECT_EQ(wordAt(**M, Data), 43U);
  EXPECT_EQ(wordAt(**M, Data + 4), 10U);
  (*M)->load(*Program);
  EXPECT_EQ(wordAt(**M, Data), 41U);
  EXPECT_EQ(wordAt(**M, Data + 4), 0U);
}

TEST(Machine, LaunchBlockArrivesInMscratch) {
  const auto M = machineFor(smallConfig(),
                            {csrr(10, CSR_MSCRATCH), lui(11, Slots),
                             sw(10, 0, 11), encode(Op::VX_TMC, {.Rs1 = 0})});
  EXPECT_EQ(M->run(0x12340).End, Outcome::Done);
  EXPECT_EQ(wordAt(*M, Slots), 0x12340U);
}

TEST(Machine, TrapNamesPlaceAndLane) {
  ElfOptions O;
  O.Segments = {{VX_IMAGE_BASE, PF_R | PF_X,
                 onAllLanes({addi(6, 0, 1), lw(7, 0, 0)}), 0}};
  O.Symbols = {{"_start", VX_IMAGE_BASE}, {"culprit", VX_IMAGE_BASE + 12}};
  const auto Program = Image::parse(buildElf(O), "test");
  ASSERT_TRUE(Program);
  const auto M = Machine::create(smallConfig());
  ASSERT_TRUE(M);
  (*M)->load(*Program);
  const RunResult R = (*M)->run();
  EXPECT_EQ(R.End, Outcome::Trap);
  EXPECT_EQ(R.Fault.Cause, TrapCause::LoadFault);
  EXPECT_EQ(R.Fault.Core, 0U);
  EXPECT_EQ(R.Fault.Pc, VX_IMAGE_BASE + 16);
  EXPECT_EQ(R.Fault.LaneMask, 0xFFFFU);
  EXPECT_EQ(R.Fault.Symbol, "culprit+0x4");
  EXPECT_EQ(R.Fault.Instruction, lw(7, 0, 0));
  EXPECT_EQ(R.Report, "core 0, warp 0, lane 0: load access fault at 0x00000000"
                      "\n  pc 0x80000010 <culprit+0x4>: lw t2, 0(zero)\n"
                      "  active lanes 0xffff\n");
}

TEST(Machine, AnAccessThatTrapsIsNotCounted) {
  const std::vector<uint32_t> Before = {lui(8, VX_GLOBAL_BASE), sw(0, 0, 8),
                                        lw(7, 0, 8)};
  const auto Ends = [&](uint32_t Last) {
    std::vector<uint32_t> Words = Before;
    Words.push_back(Last);
    Config C = oneCore();
    C.Timing.Enabled = true;
    const RunResult R = machineFor(C, Words)->run();
    EXPECT_EQ(R.End, Outcome::Trap);
    EXPECT_EQ(R.Total.Loads, 1U);
    EXPECT_EQ(R.Total.Stores, 1U);
    EXPECT_EQ(R.Total.Atomics, 0U);
    unsigned Found = 0;
    for (const Activity &A : R.Time->Activities)
      if (A.Unit == "core warp instructions" &&
          (A.Event == "load" || A.Event == "store")) {
        ++Found;
        EXPECT_EQ(A.Count, 1U) << A.Event;
      }
    EXPECT_EQ(Found, 2U);
  };
  Ends(lw(7, 0, 0));
  Ends(lw(7, 1, 8));
  Ends(sw(7, 0, 0));
  Ends(sw(7, 2, 8));
  Ends(encode(Op::RV_AMOADD_W, {.Rd = 7, .Rs1 = 0, .Rs2 = 7}));
}

TEST(Machine, RunsAgainAfterATrap) {
  const auto M = machineFor(smallConfig(), {lw(7, 0, 0)});
  EXPECT_EQ(M->run().End, Outcome::Trap);
  M->load(codeImage({encode(Op::VX_TMC, {.Rs1 = 0})}));
  EXPECT_EQ(M->run().End, Outcome::Done);
}

TEST(Machine, WithoutAProgramItTraps) {
  const auto M = Machine::create(smallConfig());
  ASSERT_TRUE(M);
  EXPECT_EQ((*M)->run().End, Outcome::Trap);
}

TEST(Machine, ExitCodeIsTheLowestCoresFirst) {
  // Core 0 stores nothing that counts; lanes of core c store 10 c + lane.
  const auto M = machineFor(
      smallConfig(),
      onAllLanes({csrr(10, CSR_CORE_ID), csrr(11, CSR_THREAD_ID),
                  addi(12, 0, 10),
                  encode(Op::RV_MUL, {.Rd = 13, .Rs1 = 10, .Rs2 = 12}),
                  encode(Op::RV_ADD, {.Rd = 13, .Rs1 = 13, .Rs2 = 11}),
                  encode(Op::RV_CZERO_EQZ, {.Rd = 13, .Rs1 = 13, .Rs2 = 10}),
                  sw(13, 0x44, 0)}));
  const RunResult R = M->run();
  EXPECT_EQ(R.End, Outcome::GuestFailed);
  EXPECT_EQ(R.ExitCode, 10U);
}

TEST(Machine, HostMemoryAccessIsBounded) {
  const auto M = machineFor(smallConfig(), {0});
  const uint32_t End = VX_GLOBAL_BASE + (1 << 20);
  EXPECT_NE(M->hostPointer(VX_GLOBAL_BASE, 1 << 20), nullptr);
  EXPECT_EQ(M->hostPointer(VX_GLOBAL_BASE, (1 << 20) + 1), nullptr);
  EXPECT_EQ(M->hostPointer(VX_GLOBAL_BASE - 1, 1), nullptr);
  EXPECT_EQ(M->hostPointer(End, 1), nullptr);
  EXPECT_EQ(M->hostPointer(VX_IMAGE_BASE, 4), nullptr);
  EXPECT_EQ(M->hostPointer(VX_GLOBAL_BASE, UINT64_MAX), nullptr);
  std::byte Buffer[8];
  EXPECT_FALSE(M->read(End - 4, Buffer));
  EXPECT_TRUE(M->read(End - 8, Buffer));
  EXPECT_FALSE(M->read(0x40, Buffer));
  EXPECT_TRUE(M->fill(VX_GLOBAL_BASE, 64, std::byte{7}));
  EXPECT_EQ(wordAt(*M, VX_GLOBAL_BASE + 60), 0x07070707U);
  EXPECT_TRUE(M->read(VX_STACK_TOP - 8, Buffer));
}

TEST(Machine, LastPageOfTheAddressSpaceDoesNotWrap) {
  // Local memory of the largest size ends at 2^32.
  Config C = smallConfig();
  C.LocalBytes = 64 << 10;
  const auto M = machineFor(C, {addi(10, 0, -4), addi(11, 0, 77), sw(11, 0, 10),
                                lw(12, 0, 10), lui(13, Slots), sw(12, 0, 13),
                                lw(14, 4, 10)}); // address 0
  const RunResult R = M->run();
  EXPECT_EQ(R.Fault.Cause, TrapCause::LoadFault);
  EXPECT_EQ(R.Fault.Address, 0U);
  EXPECT_EQ(wordAt(*M, Slots), 77U);
}

TEST(Machine, ConsoleTextWithoutALineEndIsHandedOn) {
  // One core, 16 lanes, 10 stores a round: 160 bytes more each time.
  Config C = oneCore();
  C.Quantum = 30;
  const auto M = machineFor(C, onAllLanes({lui(10, 0x3000), addi(11, 0, 'x'),
                                           sw(11, VX_IO_CONSOLE, 0),
                                           addi(10, 10, -1), bne(10, 0, -8)}));
  size_t Total = 0, Longest = 0, Calls = 0;
  M->setConsole([&](std::string_view Text) {
    Total += Text.size();
    Longest = std::max(Longest, Text.size());
    ++Calls;
  });
  EXPECT_EQ(M->run().End, Outcome::Done);
  EXPECT_EQ(Total, 16U * 0x3000);
  EXPECT_EQ(Calls, 3U);
  EXPECT_LE(Longest, 65536U + 160);
}
