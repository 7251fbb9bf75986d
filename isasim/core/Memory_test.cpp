/// Loads, stores and atomics of a warp: every shape of addresses on every
/// level and mask, faults, and the order of lanes.

#include "core/Atomics.h"
#include "testing/WarpRunner.h"

#include <algorithm>
#include <cstring>
#include <random>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr uint32_t Buffer = VX_GLOBAL_BASE + 0x1000;
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
  uint32_t W = 0;
  std::memcpy(&W, From, 4);
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

uint32_t sizeOf(Op O) {
  switch (O) {
  case Op::RV_LB:
  case Op::RV_LBU:
  case Op::RV_SB:
    return 1;
  case Op::RV_LH:
  case Op::RV_LHU:
  case Op::RV_SH:
    return 2;
  default:
    return 4;
  }
}

Lanes16 minus(Lanes16 V, uint32_t Amount) {
  for (uint32_t &Lane : V)
    Lane -= Amount;
  return V;
}

/// One run of a single instruction; Where: registers 10 and 11.
void runOn(WarpRunner &R, uint32_t Mask, const Lanes16 &Addresses,
           const Lanes16 &Values) {
  R.setX(10, Addresses);
  R.setX(11, Values);
  R.setF(11, Values);
  R.setActive(Mask);
  R.rewind();
  R.run();
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
            Lanes16 Old;
            Old.fill(Untouched);
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
    Lanes16 Addresses, Values;
    for (unsigned L = 0; L != MaxLanes; ++L) {
      const uint32_t Bases[] = {Buffer, VX_LOCAL_BASE, VX_STACK_TOP - 4096,
                                VX_IMAGE_BASE + 0x10000};
      Addresses[L] = Bases[L % 4] + L * 4;
      Values[L] = 1000 + L;
    }
    runOn(R, 0xFFFF, Addresses, Values);
    ASSERT_TRUE(R.ranToEnd());
    EXPECT_EQ(R.getX(12), Values);
  }
}

namespace {

constexpr uint64_t LowBytes = VX_IMAGE_BASE - VX_GLOBAL_BASE;

/// With a megabyte of global memory behind the image.
Config largeShape() {
  Config C = WarpRunner::smallShape();
  C.GlobalBytes = LowBytes + (1 << 20);
  return C;
}

} // namespace

TEST(Memory, WhatDoesNotFitInFrontOfTheImageLiesBehindIt) {
  constexpr uint32_t End = VX_HIGH_BASE + (1 << 20);
  std::mt19937 Random(5);
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_SW, {.Rs1 = 10, .Rs2 = 11}),
                  encode(Op::RV_LW, {.Rd = 12, .Rs1 = 10})},
                 largeShape());
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

TEST(Memory, AdditionsBehindTheImageDoNotPark) {
  WarpRunner R(execTable(false),
               {encode(Op::RV_AMOADD_W, {.Rd = 0, .Rs1 = 10, .Rs2 = 11})},
               largeShape());
  Lanes16 Addresses, Ones;
  Addresses.fill(VX_HIGH_BASE + 4);
  Ones.fill(1);
  runOn(R, 0xFFFF, Addresses, Ones);
  EXPECT_TRUE(R.ranToEnd());
  EXPECT_EQ(*reinterpret_cast<uint32_t *>(R.global(VX_HIGH_BASE + 4)), 16U);
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
    Addresses.fill(0); // page 0
    runOn(Store, 0x8000, Addresses, {});
    EXPECT_EQ(Store.cause(), TrapCause::StoreFault);
    EXPECT_EQ(Store.warp().FaultLane, 15U);
    Addresses.fill(VX_IO_RASTER); // the host's window
    runOn(Store, 0xFFFF, Addresses, {});
    EXPECT_EQ(Store.cause(), TrapCause::StoreFault);
    Addresses.fill(VX_IMAGE_BASE); // code
    runOn(Store, 0xFFFF, Addresses, {});
    EXPECT_EQ(Store.cause(), TrapCause::StoreFault);
  }
}

TEST(Memory, MisalignedAccessesTrap) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner Load(*Table, {encode(Op::RV_LH, {.Rd = 12, .Rs1 = 10})});
    Lanes16 Addresses;
    Addresses.fill(Buffer);
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
    EXPECT_FALSE(amoNow(&Amo.warp(), Amo.warp().Next, Amo::Add));
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

TEST(Memory, AtomicsRunInLaneOrder) {
  struct Case {
    Op O;
    uint32_t Start;
    Lanes16 Operands;
    uint32_t Result;
  };
  const Lanes16 Same = {5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5};
  const Lanes16 Steps = {1, 2, 4, 8, 16, 32, 64, 128, 1, 1, 1, 1, 1, 1, 1, 1};
  const Lanes16 Mixed = {7,          ~0U, 3, 9, 1, 2, 8, 4,
                         0x80000000, 6,   5, 7, 7, 7, 7, 7};
  for (const ExecTable *Table : allTables())
    for (const Case &C : {Case{Op::RV_AMOADD_W, 100, Same, 180},
                          Case{Op::RV_AMOSWAP_W, 1, Mixed, 7},
                          Case{Op::RV_AMOXOR_W, 0, Steps, 255},
                          Case{Op::RV_AMOOR_W, 0, Steps, 255},
                          Case{Op::RV_AMOAND_W, 0xFF, Same, 5},
                          Case{Op::RV_AMOMIN_W, 3, Mixed, 0x80000000},
                          Case{Op::RV_AMOMAX_W, 3, Mixed, 9},
                          Case{Op::RV_AMOMINU_W, 3, Mixed, 1},
                          Case{Op::RV_AMOMAXU_W, 3, Mixed, ~0U}}) {
      WarpRunner R(*Table, {encode(C.O, {.Rd = 12, .Rs1 = 10, .Rs2 = 11})});
      Lanes16 Addresses;
      Addresses.fill(VX_LOCAL_BASE + 64); // local memory: at once
      std::memcpy(R.warp().Mem->Local.at(VX_LOCAL_BASE + 64), &C.Start, 4);
      runOn(R, 0xFFFF, Addresses, C.Operands);
      ASSERT_TRUE(R.ranToEnd());
      uint32_t Got = 0;
      std::memcpy(&Got, R.warp().Mem->Local.at(VX_LOCAL_BASE + 64), 4);
      EXPECT_EQ(Got, C.Result)
          << InsnTable[static_cast<unsigned>(C.O)].Mnemonic;
      EXPECT_EQ(R.getX(12)[0], C.Start);
      if (C.O == Op::RV_AMOADD_W)
        for (uint32_t L = 0; L != MaxLanes; ++L)
          EXPECT_EQ(R.getX(12)[L], 100 + 5 * L);
      if (C.O == Op::RV_AMOSWAP_W)
        for (uint32_t L = 1; L != MaxLanes; ++L)
          EXPECT_EQ(R.getX(12)[L], Mixed[L - 1]);
    }
}

TEST(Memory, CompareAndSwapComparesWithRd) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_AMOCAS_W, {.Rd = 12, .Rs1 = 10, .Rs2 = 11})});
    Lanes16 Addresses, Values, Expected{};
    Addresses.fill(VX_LOCAL_BASE);
    for (uint32_t L = 0; L != MaxLanes; ++L) {
      Values[L] = L + 1;
      Expected[L] = L == 4 ? 77 : L; // lane 4 breaks the chain
    }
    R.setX(12, Expected);
    runOn(R, 0xFFFF, Addresses, Values);
    ASSERT_TRUE(R.ranToEnd());
    uint32_t Got = 0;
    std::memcpy(&Got, R.warp().Mem->Local.at(VX_LOCAL_BASE), 4);
    EXPECT_EQ(Got, 4U);
    EXPECT_EQ(R.getX(12),
              (Lanes16{0, 1, 2, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4}));
  }
}

TEST(Memory, CompareAndSwapWithX0ComparesWithZero) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_AMOCAS_W, {.Rd = 0, .Rs1 = 10, .Rs2 = 11})});
    Lanes16 Addresses, Values;
    Values.fill(3);
    Addresses.fill(VX_LOCAL_BASE);
    runOn(R, 0x0006, Addresses, Values);
    ASSERT_TRUE(R.ranToEnd());
    uint32_t Got = 0;
    std::memcpy(&Got, R.warp().Mem->Local.at(VX_LOCAL_BASE), 4);
    EXPECT_EQ(Got, 3U);
    EXPECT_EQ(R.getX(0), Lanes16{});
  }
}

TEST(Memory, CompareAndSwapOfPairsComparesBothWords) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_AMOCAS_D, {.Rd = 12, .Rs1 = 10, .Rs2 = 14})});
    Lanes16 Addresses, Low{}, High{}, NewHigh;
    Addresses.fill(VX_LOCAL_BASE + 8);
    for (uint32_t L = 0; L != MaxLanes; ++L)
      NewHigh[L] = L + 1;
    High = {0, 1, 7, 2, 3}; // lane 2 is wrong in the high word,
    Low[3] = 5;             // lane 3 in the low one
    R.setX(10, Addresses);
    R.setX(12, Low);
    R.setX(13, High);
    R.setX(14, Lanes16{});
    R.setX(15, NewHigh);
    R.run();
    ASSERT_TRUE(R.ranToEnd());
    uint32_t Got[4] = {};
    std::memcpy(Got, R.warp().Mem->Local.at(VX_LOCAL_BASE), sizeof(Got));
    EXPECT_EQ(std::to_array(Got), (std::array{0U, 0U, 0U, 2U}));
    EXPECT_EQ(R.getX(12), Lanes16{});
    EXPECT_EQ(R.getX(13),
              (Lanes16{0, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2}));
  }
}

TEST(Memory, AtomicsOfPairsReachEachLanesStack) {
  // The two words of a lane are not neighbours on the host.
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_AMOCAS_D, {.Rd = 0, .Rs1 = 10, .Rs2 = 14}),
                  encode(Op::RV_LW, {.Rd = 6, .Rs1 = 10}),
                  encode(Op::RV_LW, {.Rd = 7, .Rs1 = 10, .Imm = 4})});
    Lanes16 Places, Low, High;
    for (uint32_t L = 0; L != MaxLanes; ++L) {
      Places[L] = VX_STACK_TOP - L * R.Shape.StackBytes - 16;
      Low[L] = L + 1;
      High[L] = 100 + L;
    }
    R.setX(10, Places);
    R.setX(14, Low);
    R.setX(15, High);
    R.run();
    ASSERT_EQ(R.warp().Why, Stop::Atomic);
    ASSERT_TRUE(amoNow(&R.warp(), R.warp().Next, amoKind(R.warp().Next)));
    Core::complete(R.warp());
    R.run();
    ASSERT_TRUE(R.ranToEnd());
    EXPECT_EQ(R.getX(6), Low);
    EXPECT_EQ(R.getX(7), High);
  }
}

TEST(Memory, AtomicsOfPairsWantEightBytes) {
  for (const ExecTable *Table : allTables())
    for (const uint32_t Address : {VX_LOCAL_BASE + 4, Buffer + 12}) {
      WarpRunner R(*Table,
                   {encode(Op::RV_AMOCAS_D, {.Rd = 0, .Rs1 = 10, .Rs2 = 14})});
      Lanes16 Addresses;
      Addresses.fill(Address);
      R.setX(10, Addresses);
      R.run();
      ASSERT_EQ(R.warp().Why, Stop::Atomic);
      EXPECT_FALSE(amoNow(&R.warp(), R.warp().Next, amoKind(R.warp().Next)));
      EXPECT_EQ(R.cause(), TrapCause::MisalignedStore);
      EXPECT_EQ(R.warp().FaultAddress, Address);
    }
}

TEST(Memory, AtomicsOnGlobalMemoryPark) {
  const ExecTable &Table = execTable(false);
  Lanes16 Addresses, Ones;
  Addresses.fill(Buffer);
  Ones.fill(1);
  WarpRunner Used(Table,
                  {encode(Op::RV_AMOADD_W, {.Rd = 12, .Rs1 = 10, .Rs2 = 11})});
  runOn(Used, 0xFFFF, Addresses, Ones);
  EXPECT_EQ(Used.warp().Why, Stop::Atomic);
  // An addition without a result need not wait.
  WarpRunner Unused(Table,
                    {encode(Op::RV_AMOADD_W, {.Rd = 0, .Rs1 = 10, .Rs2 = 11})});
  runOn(Unused, 0xFFFF, Addresses, Ones);
  EXPECT_TRUE(Unused.ranToEnd());
  uint32_t Got = 0;
  std::memcpy(&Got, Unused.global(Buffer), 4);
  EXPECT_EQ(Got, 16U);
}

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
          Lanes16 Tops, Values;
          for (uint32_t L = 0; L != MaxLanes; ++L) {
            Tops[L] = VX_STACK_TOP - L * R.Shape.StackBytes -
                      (Same ? 0 : Random() % 4 * 64);
            Values[L] = static_cast<uint32_t>(Random());
          }
          // What other lanes hold must survive: they come first.
          runOn(R, ~Mask & 0xFFFF ? ~Mask & 0xFFFF : 0xFFFF, Tops, Values);
          ASSERT_TRUE(R.ranToEnd());
          runOn(R, Mask, Tops, Values);
          ASSERT_TRUE(R.ranToEnd());
          runOn(R, 0xFFFF, Tops, Values);
          const uint32_t Bits = sizeOf(Store) * 8;
          for (unsigned L = 0; L != MaxLanes; ++L)
            ASSERT_EQ(R.getX(12)[L],
                      Bits == 32 ? Values[L] : Values[L] & ((1U << Bits) - 1))
                << Table->Level << " lane " << L << " mask " << Mask;
        }
    }
}

TEST(Memory, StoreToAStackLeavesInactiveLanesAlone) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_SW, {.Rs1 = 10, .Rs2 = 11, .Imm = -4})});
    WarpRunner Look(*Table,
                    {encode(Op::RV_LW, {.Rd = 12, .Rs1 = 10, .Imm = -4})});
    Lanes16 Tops, Ones, Twos;
    for (uint32_t L = 0; L != MaxLanes; ++L)
      Tops[L] = VX_STACK_TOP - L * R.Shape.StackBytes;
    Ones.fill(1);
    Twos.fill(2);
    runOn(R, 0xFFFF, Tops, Ones);
    runOn(R, 0x00F1, Tops, Twos);
    // Read lane by lane, as the host finds it.
    for (unsigned L = 0; L != MaxLanes; ++L) {
      uint32_t Got = 0;
      for (unsigned Byte = 0; Byte != 4; ++Byte)
        Got |=
            std::to_integer<uint32_t>(*R.Storage->stackByte(Tops[L] - 4 + Byte))
            << (8 * Byte);
      EXPECT_EQ(Got, 0x00F1 >> L & 1 ? 2U : 1U) << L;
    }
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

TEST(Memory, AccessBySpBeyondTheLanesOwnStackTraps) {
  for (const ExecTable *Table : allTables())
    for (const Op O : {Op::RV_SW, Op::RV_LW, Op::RV_SB, Op::RV_LHU})
      for (const uint32_t Mask : {0xFFFFU, 0x0420U}) {
        WarpRunner R(*Table,
                     {encode(O, {.Rd = 12, .Rs1 = 2, .Rs2 = 11, .Imm = -8})});
        auto Tops = [&](uint32_t Depth) {
          Lanes16 V;
          for (uint32_t L = 0; L != MaxLanes; ++L)
            V[L] = VX_STACK_TOP - L * R.Shape.StackBytes;
          V[5] -= Depth;
          return V;
        };
        auto Run = [&](uint32_t Depth) {
          R.reset();
          R.setX(2, Tops(Depth));
          R.setActive(Mask);
          R.run();
        };
        Run(R.Shape.StackBytes - 8); // the last word
        EXPECT_TRUE(R.ranToEnd());
        Run(R.Shape.StackBytes - 4);
        EXPECT_EQ(R.cause(), TrapCause::StackOverflow) << Table->Level;
        EXPECT_EQ(R.warp().FaultLane, 5U);
        EXPECT_EQ(R.warp().FaultAddress, Tops(R.Shape.StackBytes - 4)[5] - 8);
        EXPECT_EQ(R.warp().Next, R.Code.begin());
        // Above its top is another lane's too.
        R.reset();
        Lanes16 Above = Tops(0);
        Above[5] += 16;
        R.setX(2, Above);
        R.setActive(Mask);
        R.run();
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
