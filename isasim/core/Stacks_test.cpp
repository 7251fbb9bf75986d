/// The stacks of lanes: each lane has its own, also where several lanes use the
/// same addresses on the host, and sp cannot leave it.

#include "core/MemoryTest.h"

#include <algorithm>
#include <random>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

/// What the host finds on a stack at \p Address, byte by byte.
uint32_t onStack(const WarpRunner &R, uint32_t Address, unsigned Bytes) {
  uint32_t Value = 0;
  for (unsigned N = 0; N != Bytes; ++N)
    Value |= std::to_integer<uint32_t>(*R.Storage->stackByte(Address + N))
             << (8 * N);
  return Value;
}

} // namespace

TEST(Memory, StacksOfLanesAreApart) {
  // Each lane's stack as the start-up code places it, each width of access,
  // the same place in every lane and another one in some.
  std::mt19937 Random(6);
  for (const ExecTable *Table : allTables())
    for (const auto &[Store, Load] :
         {std::pair(Op::RV_SW, Op::RV_LW), std::pair(Op::RV_SH, Op::RV_LHU),
          std::pair(Op::RV_SB, Op::RV_LBU)}) {
      WarpRunner R(*Table, {encode(Store, {.Rs1 = 10, .Rs2 = 11, .Imm = -16}),
                            encode(Load, {.Rd = 12, .Rs1 = 10, .Imm = -16})});
      for (const uint32_t Mask : MaskPatterns)
        for (const bool Same : {true, false}) {
          Lanes16 Tops = stackTops(R.Shape), Values;
          for (uint32_t L = 0; L != MaxLanes; ++L) {
            Tops[L] -= Same ? 0 : Random() % 4 * 64;
            Values[L] = static_cast<uint32_t>(Random());
          }
          // What other lanes hold must survive: they come first.
          runOn(R, ~Mask & 0xFFFF ? ~Mask & 0xFFFF : 0xFFFF, Tops, Values);
          ASSERT_TRUE(R.ranToEnd());
          runOn(R, Mask, Tops, Values);
          ASSERT_TRUE(R.ranToEnd());
          // All lanes load, and none stores.
          R.setX(12, {});
          R.setActive(0xFFFF);
          R.rewind();
          ++R.warp().Next;
          R.run();
          ASSERT_TRUE(R.ranToEnd());
          const uint32_t Bytes = sizeOf(Store);
          for (unsigned L = 0; L != MaxLanes; ++L) {
            const uint32_t Kept = Values[L] & (~0U >> (32 - 8 * Bytes));
            ASSERT_EQ(R.getX(12)[L], Kept)
                << Table->Level << " lane " << L << " mask " << Mask;
            ASSERT_EQ(onStack(R, Tops[L] - 16, Bytes), Kept)
                << Table->Level << " lane " << L << " mask " << Mask;
          }
        }
    }
}

TEST(Memory, StoreToAStackLeavesInactiveLanesAlone) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_SW, {.Rs1 = 10, .Rs2 = 11, .Imm = -4})});
    const Lanes16 Tops = stackTops(R.Shape);
    runOn(R, 0xFFFF, Tops, all(1));
    runOn(R, 0x00F1, Tops, all(2));
    for (unsigned L = 0; L != MaxLanes; ++L)
      EXPECT_EQ(onStack(R, Tops[L] - 4, 4), 0x00F1 >> L & 1 ? 2U : 1U) << L;
  }
}

TEST(Memory, AccessBySpBeyondTheLanesOwnStackTraps) {
  for (const ExecTable *Table : allTables())
    for (const Op O : {Op::RV_SW, Op::RV_LW, Op::RV_SB, Op::RV_LHU})
      for (const uint32_t Mask : {0xFFFFU, 0x0420U}) {
        WarpRunner R(*Table,
                     {encode(O, {.Rd = 12, .Rs1 = 2, .Rs2 = 11, .Imm = -8})});
        const Lanes16 Tops = stackTops(R.Shape);
        // With the stack pointer of lane 5 at \p Sp.
        auto Run = [&](uint32_t Sp) {
          Lanes16 Pointers = Tops;
          Pointers[5] = Sp;
          R.reset();
          R.setX(2, Pointers);
          R.setActive(Mask);
          R.run();
        };
        const uint32_t Lowest = Tops[5] - R.Shape.StackBytes;
        Run(Lowest + 8); // the last word
        EXPECT_TRUE(R.ranToEnd());
        Run(Lowest + 4);
        EXPECT_EQ(R.cause(), TrapCause::StackOverflow) << Table->Level;
        EXPECT_EQ(R.warp().FaultLane, 5U);
        EXPECT_EQ(R.warp().FaultAddress, Lowest - 4);
        EXPECT_EQ(R.warp().Next, R.Code.begin());
        // Above its top is another lane's too.
        Run(Tops[5] + 16);
        EXPECT_EQ(R.cause(), TrapCause::StackOverflow) << Table->Level;
      }
}

TEST(Memory, AccessToAnothersStackTraps) {
  // By any register: all lanes one stack further, where they are neighbours
  // again; some lanes; and one lane while others are in global memory.
  for (const ExecTable *Table : allTables())
    for (const Op O : {Op::RV_SW, Op::RV_LW, Op::RV_SB, Op::RV_LHU,
                       Op::RV_AMOADD_W, Op::RV_AMOSWAP_W})
      for (const bool BesideGlobal : {false, true})
        for (const uint32_t Mask : {0xFFFFU, 0x0420U}) {
          Config Shape = WarpRunner::smallShape();
          Shape.CoresPerSocket = 2;
          WarpRunner R(*Table, {encode(O, {.Rd = 12, .Rs1 = 10, .Rs2 = 11})},
                       Shape);
          const auto Run = [&](const Lanes16 &Addresses) {
            R.reset();
            runOn(R, Mask, Addresses, {});
            if (R.warp().Why == Stop::Atomic && R.completeAtomic())
              R.run();
          };
          Lanes16 Own = stackTops(Shape);
          for (uint32_t L = 0; L != MaxLanes; ++L)
            Own[L] = BesideGlobal && L != 10 ? Buffer + 64 * L : Own[L] - 16;
          Run(Own);
          EXPECT_TRUE(R.ranToEnd()) << Table->Level;
          const auto ExpectStray = [&](const Lanes16 &Addresses,
                                       uint32_t Lane) {
            Run(Addresses);
            EXPECT_EQ(R.cause(), TrapCause::StackOverflow) << Table->Level;
            EXPECT_EQ(R.warp().FaultLane, Lane) << Table->Level;
            EXPECT_EQ(R.warp().FaultAddress, Addresses[Lane]) << Table->Level;
          };
          for (const uint32_t Stacks : {1, 16}) {
            Lanes16 One = Own, All = Own;
            One[10] -= Stacks * Shape.StackBytes;
            ExpectStray(One, 10);
            if (BesideGlobal)
              continue;
            for (uint32_t &Address : All)
              Address -= Stacks * Shape.StackBytes;
            ExpectStray(All, Mask == 0xFFFF ? 0 : 5);
          }
        }
}

TEST(Memory, InALaunchSpStaysOutOfTheMemoryBelowTheStacks) {
  for (const ExecTable *Table : allTables())
    for (const Op O : {Op::RV_SW, Op::RV_LW, Op::RV_SB}) {
      WarpRunner R(*Table, {encode(O, {.Rd = 12, .Rs1 = 2, .Rs2 = 11})},
                   shapeWithHighMemory());
      const Lanes16 InGlobal = all(VX_HIGH_BASE + 0x1000);
      R.setX(2, InGlobal);
      R.run();
      EXPECT_TRUE(R.ranToEnd()) << Table->Level;
      R.Only.reset(R.Code, VX_IMAGE_BASE, 0, 1, R.Storage->view(0), &R.Watcher);
      R.setActive(0xFFFF);
      R.setX(2, InGlobal);
      R.run();
      EXPECT_EQ(R.cause(), TrapCause::StackOverflow) << Table->Level;
    }
}

TEST(Memory, StacksOfARunMayBeLarger) {
  for (const ExecTable *Table : allTables()) {
    Config Shape = shapeWithHighMemory();
    WarpRunner R(*Table,
                 {encode(Op::RV_SW, {.Rs1 = 10, .Rs2 = 11}),
                  encode(Op::RV_LW, {.Rd = 12, .Rs1 = 10}),
                  encode(Op::RV_CSRRS, {.Rd = 13, .Csr = CSR_STACK_SIZE})},
                 Shape);
    const uint32_t Large = 4 * Shape.StackBytes;
    const auto Run = [&](uint32_t Depth) {
      R.reset();
      Lanes16 Addresses, Values;
      for (uint32_t L = 0; L != MaxLanes; ++L) {
        Addresses[L] = VX_STACK_TOP - L * Large - Depth;
        Values[L] = Addresses[L] ^ 0x5a5a;
      }
      runOn(R, 0xFFFF, Addresses, Values);
      return R.getX(12) == Values;
    };
    ASSERT_TRUE(R.Storage->beginRun({Large, MaxLanes * Large, {}}));
    EXPECT_TRUE(Run(16)) << Table->Level;
    EXPECT_TRUE(R.ranToEnd()) << Table->Level;
    EXPECT_EQ(R.getX(13), all(Large));
    EXPECT_TRUE(Run(Large)) << Table->Level;
    EXPECT_FALSE(Run(Large + 4)) << Table->Level;
    EXPECT_EQ(R.cause(), TrapCause::StackOverflow);
    // What they cover of global memory is not there until the run ends.
    const uint32_t Covered = VX_STACK_TOP - 16 * Large;
    EXPECT_EQ(R.Storage->global(Covered, 4), nullptr);
    EXPECT_NE(R.Storage->stackByte(Covered), nullptr);
    R.Storage->endRun();
    EXPECT_EQ(R.Storage->stackByte(Covered), nullptr);
  }
}

TEST(Memory, ARunCanHaveMemoryToReadOnly) {
  // In the middle, at an end, and one behind the other; at the border some
  // lanes would store.
  const uint32_t Ends = VX_GLOBAL_BASE + (1 << 20);
  const std::vector<AddressRange> Kept[] = {
      {{Buffer, 128}},
      {{Ends - 256, 256}, {VX_GLOBAL_BASE, 128}},
      {{Buffer + 128, 256}, {Buffer, 128}}};
  for (const ExecTable *Table : allTables())
    for (const std::vector<AddressRange> &ReadOnly : Kept)
      for (const Op O : {Op::RV_SW, Op::RV_SB, Op::RV_LW, Op::RV_AMOADD_W,
                         Op::RV_AMOSWAP_W}) {
        WarpRunner R(*Table, {encode(O, {.Rd = 12, .Rs1 = 10, .Rs2 = 11})});
        ASSERT_TRUE(R.Storage->beginRun(
            {R.Shape.StackBytes, stackBytes(R.Shape), ReadOnly}));
        const auto Runs = [&](uint32_t First, uint32_t Step) {
          R.reset();
          Lanes16 Addresses;
          for (uint32_t L = 0; L != MaxLanes; ++L)
            Addresses[L] = First + L * Step;
          runOn(R, 0xFFFF, Addresses, {});
          if (R.warp().Why == Stop::Atomic && R.completeAtomic())
            R.run();
          return R.ranToEnd();
        };
        for (const AddressRange &Part : ReadOnly)
          for (const uint32_t Step : {0, 4}) {
            EXPECT_EQ(Runs(Part.Base, Step), O == Op::RV_LW) << Table->Level;
            if (Part.Base == Buffer)
              EXPECT_EQ(Runs(Part.Base - 32, Step), O == Op::RV_LW || !Step)
                  << Table->Level;
            EXPECT_TRUE(Runs(Buffer - 64, Step)) << Table->Level;
            EXPECT_TRUE(Runs(Buffer + 512, Step)) << Table->Level;
          }
        EXPECT_EQ(R.Storage->writable(ReadOnly[0].Base + 124, 4), nullptr);
        EXPECT_NE(R.Storage->writable(Buffer + 512, 4), nullptr);
      }
}

TEST(Memory, StackAddressesCoverTheirRangeOnce) {
  Config C = WarpRunner::smallShape();
  C.LanesPerWarp = 5;
  C.CoresPerSocket = 3;
  C.StackBytes = 4096;
  const auto Storage = std::move(*Memory::create(C));
  const uint32_t Bytes = 15 * 4096;
  std::vector<const std::byte *> Places;
  for (uint32_t N = 0; N != Bytes; ++N)
    Places.push_back(Storage->stackByte(VX_STACK_TOP - Bytes + N));
  for (uint32_t N = 0; N + 4 <= Bytes; N += 4) // words stay whole
    for (unsigned B = 1; B != 4; ++B)
      ASSERT_EQ(Places[N + B], Places[N] + B);
  std::sort(Places.begin(), Places.end());
  EXPECT_EQ(std::adjacent_find(Places.begin(), Places.end()), Places.end());
  EXPECT_EQ(Storage->stackByte(VX_STACK_TOP), nullptr);
  EXPECT_EQ(Storage->stackByte(VX_STACK_TOP - Bytes - 1), nullptr);
}

TEST(Memory, StackFaultsBelowTheLowest) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::RV_SW, {.Rs1 = 10, .Rs2 = 11})});
    const uint32_t Lowest = VX_STACK_TOP - MaxLanes * R.Shape.StackBytes;
    Lanes16 Addresses = stackTops(R.Shape);
    for (uint32_t &Address : Addresses)
      Address -= 16;
    Addresses[15] = Lowest - 4;
    runOn(R, 0xFFFF, Addresses, {});
    EXPECT_EQ(R.cause(), TrapCause::StoreFault);
    EXPECT_EQ(R.warp().FaultLane, 15U);
    EXPECT_EQ(R.warp().FaultAddress, Lowest - 4);
  }
}
