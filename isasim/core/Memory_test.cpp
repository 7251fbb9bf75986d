/// Loads and stores of a warp: every shape of addresses on every level and
/// mask, all regions of memory, and faults.

#include "core/MemoryTest.h"

#include <random>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr uint32_t Untouched = 0xDEADBEEF;

struct Shape {
  const char *Name;
  Lanes16 Addresses;
};

/// Addresses of Size bytes around Base in the ways that programs have.
std::vector<Shape> shapes(uint32_t Base, uint32_t Size, std::mt19937 &Random) {
  std::vector<Shape> All = {{"contiguous", {}}, {"uniform", {}},
                            {"strided", {}},    {"reversed", {}},
                            {"scattered", {}},  {"two runs", {}}};
  for (uint32_t L = 0; L != MaxLanes; ++L) {
    All[0].Addresses[L] = Base + L * Size;
    All[1].Addresses[L] = Base;
    All[2].Addresses[L] = Base + L * 64;
    All[3].Addresses[L] = Base + (15 - L) * Size;
    All[4].Addresses[L] = Base + static_cast<uint32_t>(Random() % 256) * Size;
    All[5].Addresses[L] = Base + (L / 8) * 512 + L % 8 * Size;
  }
  return All;
}

uint32_t loadedAs(Op O, const std::byte *From) {
  const uint32_t W = wordOf(From);
  switch (O) {
  case Op::RV_LB:
    return static_cast<uint32_t>(static_cast<int8_t>(W));
  case Op::RV_LH:
    return static_cast<uint32_t>(static_cast<int16_t>(W));
  case Op::RV_LBU:
    return W & 0xFF;
  case Op::RV_LHU:
    return W & 0xFFFF;
  default:
    return W;
  }
}

Lanes16 minus(Lanes16 V, uint32_t Amount) {
  for (uint32_t &Lane : V)
    Lane -= Amount;
  return V;
}

} // namespace

TEST(Memory, EveryLoadOfEveryShapeOnEveryMask) {
  std::mt19937 Random(3);
  constexpr int32_t Offset = -20;
  for (const ExecTable *Table : allTables())
    for (const Op O : {Op::RV_LB, Op::RV_LH, Op::RV_LW, Op::RV_LBU, Op::RV_LHU,
                       Op::RV_FLW}) {
      WarpRunner R(*Table, {encode(O, {.Rd = 12, .Rs1 = 10, .Imm = Offset})});
      for (uint32_t N = 0; N != 0x2000; ++N)
        *R.global(VX_GLOBAL_BASE + N) = static_cast<std::byte>(Random());
      // In the middle, at the start and at the end of global memory.
      for (const uint32_t Base :
           {Buffer, VX_GLOBAL_BASE,
            static_cast<uint32_t>(VX_GLOBAL_BASE + R.Shape.GlobalBytes) -
                16 * sizeOf(O)})
        for (const Shape &Way : shapes(Base, sizeOf(O), Random)) {
          if (Base != Buffer && std::string_view(Way.Name) != "contiguous" &&
              std::string_view(Way.Name) != "reversed")
            continue;
          for (const uint32_t Mask : MaskPatterns) {
            const Lanes16 Old = all(Untouched);
            R.setX(12, Old);
            R.setF(12, Old);
            runOn(R, Mask, minus(Way.Addresses, Offset), Old);
            ASSERT_TRUE(R.ranToEnd()) << Way.Name;
            const Lanes16 Got = O == Op::RV_FLW ? R.getF(12) : R.getX(12);
            for (unsigned L = 0; L != MaxLanes; ++L)
              ASSERT_EQ(Got[L], Mask >> L & 1
                                    ? loadedAs(O, R.global(Way.Addresses[L]))
                                    : Untouched)
                  << Table->Level << " " << Way.Name << " lane " << L;
          }
        }
    }
}

TEST(Memory, EveryStoreOfEveryShapeOnEveryMask) {
  std::mt19937 Random(4);
  for (const ExecTable *Table : allTables())
    for (const Op O : {Op::RV_SB, Op::RV_SH, Op::RV_SW, Op::RV_FSW}) {
      WarpRunner R(*Table, {encode(O, {.Rs1 = 10, .Rs2 = 11, .Imm = 8})});
      std::byte *Memory = R.global(VX_GLOBAL_BASE);
      for (const Shape &Way : shapes(Buffer, sizeOf(O), Random))
        for (const uint32_t Mask : MaskPatterns) {
          std::vector<std::byte> Expected(0x3000);
          for (std::byte &B : Expected)
            B = static_cast<std::byte>(Random());
          std::memcpy(Memory, Expected.data(), Expected.size());
          Lanes16 Values;
          for (uint32_t &V : Values)
            V = static_cast<uint32_t>(Random());
          // In lane order: the last of several lanes at one address wins.
          for (unsigned L = 0; L != MaxLanes; ++L)
            if (Mask >> L & 1)
              std::memcpy(&Expected[Way.Addresses[L] - VX_GLOBAL_BASE],
                          &Values[L], sizeOf(O));
          runOn(R, Mask, minus(Way.Addresses, 8), Values);
          ASSERT_TRUE(R.ranToEnd());
          ASSERT_EQ(std::memcmp(Memory, Expected.data(), Expected.size()), 0)
              << Table->Level << " " << Way.Name << std::hex << " mask "
              << Mask;
        }
    }
}

TEST(Memory, LanesMayReachDifferentRegions) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::RV_SW, {.Rs1 = 10, .Rs2 = 11}),
                          encode(Op::RV_LW, {.Rd = 12, .Rs1 = 10})});
    const Lanes16 Tops = stackTops(R.Shape);
    Lanes16 Addresses, Values;
    for (unsigned L = 0; L != MaxLanes; ++L) {
      const uint32_t Bases[] = {Buffer, VX_LOCAL_BASE, Tops[L] - 4096,
                                VX_IMAGE_BASE + 0x10000};
      Addresses[L] = Bases[L % 4] + L * 4;
      Values[L] = 1000 + L;
    }
    runOn(R, 0xFFFF, Addresses, Values);
    ASSERT_TRUE(R.ranToEnd());
    EXPECT_EQ(R.getX(12), Values);
  }
}

TEST(Memory, WhatDoesNotFitInFrontOfTheImageLiesBehindIt) {
  constexpr uint32_t End = VX_HIGH_BASE + (1 << 20);
  std::mt19937 Random(5);
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_SW, {.Rs1 = 10, .Rs2 = 11}),
                  encode(Op::RV_LW, {.Rd = 12, .Rs1 = 10})},
                 shapeWithHighMemory());
    // Neighbours, each at a place of its own, and lanes in both parts.
    Lanes16 Both;
    for (uint32_t L = 0; L != MaxLanes; ++L)
      Both[L] = L % 2 ? VX_IMAGE_BASE - 64 + L * 4 : VX_HIGH_BASE + L * 4;
    std::vector<Lanes16> Ways = {Both};
    for (const uint32_t Base : {VX_HIGH_BASE, End - 16 * 64})
      for (const unsigned Way : {0, 2, 3})
        Ways.push_back(shapes(Base, 4, Random)[Way].Addresses);
    for (const Lanes16 &Addresses : Ways) {
      Lanes16 Values;
      for (uint32_t &V : Values)
        V = static_cast<uint32_t>(Random());
      runOn(R, 0xFFFF, Addresses, Values);
      ASSERT_TRUE(R.ranToEnd());
      EXPECT_EQ(R.getX(12), Values);
      for (unsigned L = 0; L != MaxLanes; ++L)
        EXPECT_EQ(std::memcmp(R.global(Addresses[L]), &Values[L], 4), 0);
    }
    // Neither the image's end nor memory's is passed.
    Lanes16 Last;
    for (const uint32_t Bad : {VX_HIGH_BASE - 32, End - 32}) {
      for (uint32_t L = 0; L != MaxLanes; ++L)
        Last[L] = Bad + L * 4;
      runOn(R, 0xFFFF, Last, {});
      EXPECT_EQ(R.ranToEnd(), Bad != End - 32);
    }
    EXPECT_EQ(R.cause(), TrapCause::StoreFault);
    EXPECT_EQ(R.warp().FaultAddress, End);
  }
  WarpRunner Small(execTable(false), {encode(Op::RV_ADDI, {})});
  EXPECT_EQ(Small.global(VX_HIGH_BASE), nullptr);
}

TEST(Memory, FaultsNameTheLowestLane) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner Load(*Table, {encode(Op::RV_LW, {.Rd = 12, .Rs1 = 10})});
    const auto End =
        static_cast<uint32_t>(VX_GLOBAL_BASE + Load.Shape.GlobalBytes);
    Lanes16 Addresses;
    for (uint32_t L = 0; L != MaxLanes; ++L)
      Addresses[L] = End - 20 + L * 4; // lanes 5 and up are outside
    runOn(Load, 0xFFFF, Addresses, {});
    EXPECT_EQ(Load.cause(), TrapCause::LoadFault);
    EXPECT_EQ(Load.warp().FaultLane, 5U);
    EXPECT_EQ(Load.warp().FaultAddress, End);
    EXPECT_EQ(Load.warp().Count.WarpInstructions, 0U);
    // Inactive lanes do not fault.
    runOn(Load, 0x001F, Addresses, {});
    EXPECT_TRUE(Load.ranToEnd());

    WarpRunner Store(*Table, {encode(Op::RV_SW, {.Rs1 = 10, .Rs2 = 11})});
    runOn(Store, 0x8000, all(0), {}); // page 0
    EXPECT_EQ(Store.cause(), TrapCause::StoreFault);
    EXPECT_EQ(Store.warp().FaultLane, 15U);
    runOn(Store, 0xFFFF, all(VX_IO_RASTER), {}); // the host's window
    EXPECT_EQ(Store.cause(), TrapCause::StoreFault);
    runOn(Store, 0xFFFF, all(VX_IMAGE_BASE), {}); // code
    EXPECT_EQ(Store.cause(), TrapCause::StoreFault);
  }
}

TEST(Memory, MisalignedAccessesTrap) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner Load(*Table, {encode(Op::RV_LH, {.Rd = 12, .Rs1 = 10})});
    Lanes16 Addresses = all(Buffer);
    Addresses[9] = Buffer + 1;
    runOn(Load, 0xFFFF, Addresses, {});
    EXPECT_EQ(Load.cause(), TrapCause::MisalignedLoad);
    EXPECT_EQ(Load.warp().FaultLane, 9U);
    WarpRunner Store(*Table, {encode(Op::RV_SW, {.Rs1 = 10, .Rs2 = 11})});
    for (uint32_t L = 0; L != MaxLanes; ++L)
      Addresses[L] = Buffer + 2 + L * 4;
    runOn(Store, 0xFFFF, Addresses, {});
    EXPECT_EQ(Store.cause(), TrapCause::MisalignedStore);
    EXPECT_EQ(Store.warp().FaultAddress, Buffer + 2);
    WarpRunner Amo(*Table,
                   {encode(Op::RV_AMOADD_W, {.Rd = 0, .Rs1 = 10, .Rs2 = 11})});
    runOn(Amo, 0xFFFF, Addresses, {});
    // It parks, and traps when it is executed.
    EXPECT_EQ(Amo.warp().Why, Stop::Atomic);
    EXPECT_FALSE(Amo.completeAtomic());
    EXPECT_EQ(Amo.cause(), TrapCause::MisalignedStore);
  }
}

TEST(Memory, ConsoleAndExitWordsTakeStores) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_SW, {.Rs1 = 0, .Rs2 = 11, .Imm = 0x40}),
                  encode(Op::RV_SW, {.Rs1 = 0, .Rs2 = 12, .Imm = 0x44}),
                  encode(Op::RV_LW, {.Rd = 13, .Rs1 = 0, .Imm = 0x40})});
    Lanes16 Letters, Codes{};
    for (uint32_t L = 0; L != MaxLanes; ++L)
      Letters[L] = 'a' + L + 0x100;
    Codes[6] = 9;
    Codes[7] = 8;
    R.setX(12, Codes);
    runOn(R, 0x00F0, Codes, Letters);
    EXPECT_EQ(R.Only.Console, "efgh");
    EXPECT_EQ(R.Only.ExitCode, 9U);
    EXPECT_EQ(R.cause(), TrapCause::LoadFault); // they cannot be read
  }
}

TEST(MemoryDeathTest, HostPagesAroundGuestMemoryAreClosed) {
  WarpRunner R(execTable(false), {encode(Op::RV_ADDI, {})});
  volatile std::byte *First = R.global(VX_GLOBAL_BASE);
  volatile std::byte *End = First + R.Shape.GlobalBytes;
  EXPECT_EQ(std::to_integer<int>(*End), 0); // vectors may read it
  EXPECT_DEATH(*End = std::byte{1}, "");
  EXPECT_DEATH(*(First - 1) = std::byte{1}, "");
  EXPECT_DEATH((void)*(First - 1), "");
}
