#include "vorion/isasim/Launch.h"

#include "core/IsaTables.h"
#include "testing/ElfBuilder.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Session.h"

#include <array>
#include <cstring>
#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::isasim;

namespace {

Config smallMachine() {
  Config C;
  C.Clusters = 1;
  C.GlobalBytes = 1 << 23;
  return C;
}

Kernel someKernel() {
  Kernel K;
  K.Name = "k";
  K.Entry = 0x80000000;
  K.ArgsBytes = 8;
  K.ContextBytes = 4;
  K.LocalBytes = 100;
  return K;
}

TEST(Launch, PartsHaveTheBytesThatTheMachineNeeds) {
  const Config C = smallMachine();
  const auto L = Launch::plan(someKernel(), {.LocalSize = {33, 1, 1}}, C);
  ASSERT_TRUE(L);
  EXPECT_EQ(L->bytes().Block, sizeof(VxLaunch));
  EXPECT_EQ(L->bytes().Args, 8u);
  EXPECT_EQ(L->bytes().Print, PrintBytes);
  // 33 items of 4 bytes, in pieces of 128 bytes, for each core.
  EXPECT_EQ(L->bytes().Context, 256u * C.cores());
}

TEST(Launch, WhatCannotRunIsRefused) {
  const Config C = smallMachine();
  const auto CodeOf = [&](const Kernel &K, const LaunchShape &S) {
    const auto L = Launch::plan(K, S, C);
    return L ? ExitCode::Ok : L.error().Code;
  };
  const Kernel K = someKernel();
  EXPECT_EQ(CodeOf(K, {.WorkDim = 4}), ExitCode::Usage);
  EXPECT_EQ(CodeOf(K, {.NumGroups = {1, 2, 1}}), ExitCode::Usage);
  EXPECT_EQ(CodeOf(K, {.LocalSize = {MaxGroupItems + 1, 1, 1}}),
            ExitCode::Usage);
  EXPECT_EQ(CodeOf(K, {.LocalSize = {0, 1, 1}}), ExitCode::Usage);
  EXPECT_EQ(CodeOf(K, {.WorkDim = 3, .NumGroups = {1U << 31, 2, 0}}),
            ExitCode::Ok); // nothing to run
  EXPECT_EQ(CodeOf(K, {.WorkDim = 2, .NumGroups = {1U << 31, 2, 1}}),
            ExitCode::Usage);
  Kernel Sized = K;
  Sized.LocalSize = {16, 1, 1};
  EXPECT_EQ(CodeOf(Sized, {.LocalSize = {8, 1, 1}}), ExitCode::Usage);
  Kernel Large = K;
  Large.LocalBytes = C.LocalBytes + 1;
  EXPECT_EQ(CodeOf(Large, {}), ExitCode::LimitReached);
}

TEST(Launch, StacksAreAsLargeAsTheKernelNeeds) {
  const Config Small = smallMachine();
  Config All = Small; // of global memory
  All.GlobalBytes = 0;
  Kernel K = someKernel();
  const auto PlanOf = [&](uint64_t Needs, uint32_t Groups, const Config &C) {
    K.StackBytes = static_cast<uint32_t>(Needs);
    return Launch::plan(
        K, {.NumGroups = {Groups, 1, 1}, .LocalSize = {16, 1, 1}}, C);
  };
  // Sizes in KiB: needed, of one stack, of all that groups need.
  constexpr uint64_t Kib = 1024;
  const auto StacksOf = [&](uint64_t Needs, uint32_t Groups) {
    const auto L = PlanOf(Needs, Groups, Small);
    EXPECT_TRUE(L);
    EXPECT_EQ(L->bytesUnderStacks(), 0u);
    return (VX_STACK_TOP - L->stacksBegin()) / Kib;
  };
  EXPECT_EQ(StacksOf(0, 1), 8 * Kib);
  EXPECT_EQ(StacksOf(57856, 1), 8 * Kib);
  EXPECT_EQ(StacksOf(57857, 1), 2 * Kib);
  EXPECT_EQ(StacksOf(57857, 3), 6 * Kib);
  EXPECT_EQ(StacksOf(57857, 1000), 16 * Kib);
  EXPECT_EQ(StacksOf(2 << 20, 8), 512 * Kib);
  // What lies under them.
  EXPECT_EQ(PlanOf(0, 8, All)->bytesUnderStacks(), 0u);
  EXPECT_EQ(PlanOf(100 * Kib, 8, All)->bytesUnderStacks(), 8 * Kib * Kib);
  EXPECT_EQ(PlanOf(100 * Kib, 4, All)->bytesUnderStacks(), 0u);
  EXPECT_TRUE(PlanOf(VX_MAX_STACK_ROOM, 7, Small));
  for (const auto &L : {PlanOf(VX_MAX_STACK_ROOM, 8, Small),
                        PlanOf(VX_MAX_STACK_ROOM + 1, 1, Small)}) {
    ASSERT_FALSE(L);
    EXPECT_EQ(L.error().Code, ExitCode::LimitReached);
  }
}

TEST(Launch, TheBlockIsWrittenAndItsPrintingRead) {
  const auto M = Machine::create(smallMachine());
  const auto Watch = Session::create({}, "test");
  ASSERT_TRUE(M && Watch);
  const auto L = Launch::plan(someKernel(),
                              {.NumGroups = {3, 1, 1}, .LocalSize = {16, 1, 1}},
                              (*M)->config());
  ASSERT_TRUE(L);
  const LaunchParts At{.Block = VX_GLOBAL_BASE,
                       .Args = VX_GLOBAL_BASE + 128,
                       .Context = VX_GLOBAL_BASE + 256,
                       .Print = VX_GLOBAL_BASE + 65536};
  const uint64_t Args = 0x0123456789abcdef;
  L->write(**M, **Watch, At, std::as_bytes(std::span(&Args, 1)));
  VxLaunch Block{};
  std::memcpy(&Block, (*M)->hostPointer(VX_GLOBAL_BASE, sizeof(Block)),
              sizeof(Block));
  EXPECT_EQ(Block.Entry, 0x80000000u);
  EXPECT_EQ(Block.Args, At.Args);
  EXPECT_EQ(Block.NumGroups[0], 3u);
  EXPECT_EQ(Block.ContextStride, 128u);
  EXPECT_EQ(std::memcmp((*M)->hostPointer(VX_GLOBAL_BASE + 128, 8), &Args, 8),
            0);

  // What the program says that it printed is more than there is room for.
  constexpr uint32_t TextBytes = PrintBytes - sizeof(VxPrint);
  EXPECT_EQ(Block.PrintCapacity, TextBytes);
  const uint32_t Used = TextBytes + 5;
  std::memcpy((*M)->hostPointer(VX_GLOBAL_BASE + 65536, 4), &Used, 4);
  std::memcpy((*M)->hostPointer(VX_GLOBAL_BASE + 65536 + sizeof(VxPrint), 5),
              "hello", 5);
  const Printed P = printedBy(**M, At);
  EXPECT_EQ(P.Text.size(), TextBytes);
  EXPECT_EQ(P.Text.substr(0, 5), "hello");
  EXPECT_EQ(P.Dropped, 5u);
}

TEST(Launch, WarpsOfACoreAreAsManyAsThereIsWorkAndLocalMemoryFor) {
  Config C = smallMachine();
  C.WarpsPerCore = 4;
  Kernel K = someKernel();
  const auto WarpsOf = [&](uint32_t Groups, std::optional<uint64_t> Local) {
    const auto L = Launch::plan(K,
                                {.NumGroups = {Groups, 1, 1},
                                 .LocalSize = {16, 1, 1},
                                 .LocalBytes = Local},
                                C);
    EXPECT_TRUE(L);
    // What groups keep across barriers grows with the blocks.
    EXPECT_EQ(L->bytes().Context / (128u * C.cores()),
              L->bytes().Block / sizeof(VxLaunch));
    return L->bytes().Block / sizeof(VxLaunch);
  };
  EXPECT_EQ(WarpsOf(1000, 0), 1u);
  K.SharesCore = true;
  EXPECT_EQ(WarpsOf(1000, 0), 4u);
  EXPECT_EQ(WarpsOf(C.cores(), 0), 1u);
  EXPECT_EQ(WarpsOf(2 * C.cores(), 0), 2u);
  EXPECT_EQ(WarpsOf(2 * C.cores() + 1, 0), 3u);
  EXPECT_EQ(WarpsOf(1000, C.LocalBytes / 4), 4u);
  EXPECT_EQ(WarpsOf(1000, C.LocalBytes / 4 + 1), 3u);
  EXPECT_EQ(WarpsOf(1000, C.LocalBytes), 1u);
  // Nobody knows what its arguments have.
  EXPECT_EQ(WarpsOf(1000, std::nullopt), 1u);
}

TEST(Launch, EachWarpHasABlockOfItsOwn) {
  Config C = smallMachine();
  C.WarpsPerCore = 2;
  const auto M = Machine::create(C);
  const auto Watch = Session::create({}, "test");
  ASSERT_TRUE(M && Watch);
  Kernel K = someKernel();
  K.SharesCore = true;
  const auto L = Launch::plan(
      K, {.NumGroups = {100, 1, 1}, .LocalSize = {16, 1, 1}, .LocalBytes = 300},
      C);
  ASSERT_TRUE(L);
  L->write(**M, **Watch,
           {.Block = VX_GLOBAL_BASE, .Context = VX_GLOBAL_BASE + 4096}, {});
  std::array<VxLaunch, 2> Blocks{};
  std::memcpy(Blocks.data(), (*M)->hostPointer(VX_GLOBAL_BASE, sizeof(Blocks)),
              sizeof(Blocks));
  for (const VxLaunch &Block : Blocks) {
    EXPECT_EQ(Block.Warps, 2u);
    EXPECT_EQ(Block.LocalStride, 384u);
    EXPECT_EQ(Block.NumGroups[0], 100u);
  }
  EXPECT_EQ(Blocks[1].Context - Blocks[0].Context,
            Blocks[0].ContextStride * C.cores());
}

TEST(Launch, LocalArgumentsLieBehindTheKernelsOwnMemory) {
  const Config C = smallMachine();
  LocalPlaces Places(someKernel(), C);
  const auto First = Places.place(1), Second = Places.place(8);
  ASSERT_TRUE(First && Second);
  EXPECT_EQ(*First, VX_LOCAL_BASE + 128);
  EXPECT_EQ(*Second, VX_LOCAL_BASE + 256);
  EXPECT_EQ(Places.used(), 264u);
  EXPECT_FALSE(Places.place(C.LocalBytes));
  EXPECT_EQ(Places.used(), 264u);
}

TEST(Launch, TheBlockTellsOfTheWholeRange) {
  const auto M = Machine::create(smallMachine());
  const auto Watch = Session::create({}, "test");
  ASSERT_TRUE(M && Watch);
  const auto BlockOf = [&](const LaunchShape &S) {
    const auto L = Launch::plan(someKernel(), S, (*M)->config());
    EXPECT_TRUE(L);
    L->write(**M, **Watch, {.Block = VX_GLOBAL_BASE}, {});
    VxLaunch Block{};
    std::memcpy(&Block, (*M)->hostPointer(VX_GLOBAL_BASE, sizeof(Block)),
                sizeof(Block));
    return Block;
  };
  const VxLaunch All =
      BlockOf({.NumGroups = {3, 1, 1}, .LocalSize = {16, 1, 1}});
  EXPECT_EQ(All.EnqueuedSize[0], 16u);
  EXPECT_EQ(All.GroupsBefore[0], 0u);
  EXPECT_EQ(All.AllGroups[0], 3u);
  EXPECT_EQ(All.GlobalSize[0], 48u);
  const VxLaunch Part =
      BlockOf({.NumGroups = {1, 1, 1},
               .LocalSize = {5, 1, 1},
               .PartOf = WholeRange{.EnqueuedSize = {16, 1, 1},
                                    .GroupsBefore = {2, 0, 0},
                                    .AllGroups = {3, 1, 1},
                                    .GlobalSize = {37, 1, 1}}});
  EXPECT_EQ(Part.LocalSize[0], 5u);
  EXPECT_EQ(Part.EnqueuedSize[0], 16u);
  EXPECT_EQ(Part.GroupsBefore[0], 2u);
  EXPECT_EQ(Part.AllGroups[0], 3u);
  EXPECT_EQ(Part.GlobalSize[0], 37u);
}

TEST(Launch, VariablesBeginAsTheImageSays) {
  const auto M = Machine::create(smallMachine());
  const auto Watch = Session::create({}, "test");
  ASSERT_TRUE(M && Watch);
  // Two words, the second an address, and the table that says so.
  const auto Program = isasim::testing::codeImage({77, 8, 4});
  Kernel K = someKernel();
  K.Variables = {.Bytes = 12,
                 .Alignment = 256,
                 .Contents = VX_IMAGE_BASE,
                 .ContentsBytes = 8,
                 .Pointers = VX_IMAGE_BASE + 8,
                 .NumPointers = 1};
  EXPECT_EQ(bytesFor(K.Variables), 12u + 128u);
  const uint32_t Place = placeOf(K.Variables, VX_GLOBAL_BASE + 128);
  EXPECT_EQ(Place, VX_GLOBAL_BASE + 256u);
  std::byte *const Bytes = (*M)->hostPointer(Place, 16);
  std::memset(Bytes, 0xFF, 16);
  writeVariables(**M, **Watch, *Program, K, Place);
  std::array<uint32_t, 4> Words{};
  std::memcpy(Words.data(), Bytes, sizeof(Words));
  EXPECT_EQ(Words, (std::array<uint32_t, 4>{77, Place + 8, 0, 0xFFFFFFFF}));
}

} // namespace
