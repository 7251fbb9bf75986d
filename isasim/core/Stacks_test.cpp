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

TEST(Memory, OtherRegistersMayReachOtherStacks) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::RV_SW, {.Rs1 = 10, .Rs2 = 11})});
    Lanes16 Addresses;
    for (uint32_t L = 0; L != MaxLanes; ++L)
      Addresses[L] = VX_STACK_TOP - 16 - (15 - L) * R.Shape.StackBytes;
    runOn(R, 0xFFFF, Addresses, Addresses);
    EXPECT_TRUE(R.ranToEnd()) << Table->Level;
    for (const uint32_t Address : Addresses)
      EXPECT_EQ(onStack(R, Address, 4), Address) << Table->Level;
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
    Lanes16 Addresses;
    for (uint32_t L = 0; L != MaxLanes; ++L)
      Addresses[L] = Lowest + (15 - L) * R.Shape.StackBytes - 4;
    runOn(R, 0xFFFF, Addresses, {});
    EXPECT_EQ(R.cause(), TrapCause::StoreFault);
    EXPECT_EQ(R.warp().FaultLane, 15U);
    EXPECT_EQ(R.warp().FaultAddress, Lowest - 4);
  }
}
