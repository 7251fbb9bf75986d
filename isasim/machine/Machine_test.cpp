/// The machine as its users see it: runs, memory, host threads, the raster
/// window, observers.

#include "vorion/isasim/Machine.h"

#include "raster/RasterTables.h"
#include "testing/ElfBuilder.h"
#include "testing/Encode.h"
#include "vorion/isasim/Observer.h"

#include <bit>
#include <cstring>

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr uint32_t Counter = VX_GLOBAL_BASE, Slots = VX_GLOBAL_BASE + 0x1000;

uint32_t addi(unsigned Rd, unsigned Rs1, int32_t Imm) {
  return encode(Op::RV_ADDI, {.Rd = Rd, .Rs1 = Rs1, .Imm = Imm});
}
uint32_t lui(unsigned Rd, uint32_t Address) {
  return encode(Op::RV_LUI,
                {.Rd = Rd, .Imm = static_cast<int32_t>(Address >> 12)});
}
uint32_t csrr(unsigned Rd, unsigned Csr) {
  return encode(Op::RV_CSRRS, {.Rd = Rd, .Rs1 = 0, .Csr = Csr});
}
uint32_t csrw(unsigned Csr, unsigned Rs1) {
  return encode(Op::RV_CSRRW, {.Rd = 0, .Rs1 = Rs1, .Csr = Csr});
}
uint32_t sw(unsigned Rs2, int32_t Imm, unsigned Rs1) {
  return encode(Op::RV_SW, {.Rs1 = Rs1, .Rs2 = Rs2, .Imm = Imm});
}
uint32_t lw(unsigned Rd, int32_t Imm, unsigned Rs1) {
  return encode(Op::RV_LW, {.Rd = Rd, .Rs1 = Rs1, .Imm = Imm});
}
uint32_t bne(unsigned Rs1, unsigned Rs2, int32_t Imm) {
  return encode(Op::RV_BNE, {.Rs1 = Rs1, .Rs2 = Rs2, .Imm = Imm});
}

/// All 16 lanes on.
std::vector<uint32_t> start() {
  return {lui(5, 0x10000), addi(5, 5, -1), encode(Op::VX_TMC, {.Rs1 = 5})};
}
std::vector<uint32_t> program(std::vector<uint32_t> Body) {
  std::vector<uint32_t> Words = start();
  Words.insert(Words.end(), Body.begin(), Body.end());
  Words.push_back(encode(Op::VX_TMC, {.Rs1 = 0}));
  return Words;
}

Config small() {
  Config C;
  C.GlobalBytes = 1 << 20;
  C.HostThreads = 1;
  return C;
}

std::unique_ptr<Machine> make(const Config &C,
                              const std::vector<uint32_t> &Words) {
  auto M = Machine::create(C);
  EXPECT_TRUE(M) << M.error().What;
  (*M)->load(codeImage(Words));
  return std::move(*M);
}

uint32_t wordAt(Machine &M, uint32_t Address) {
  uint32_t W = 0;
  EXPECT_TRUE(M.read(Address, std::as_writable_bytes(std::span(&W, 1))));
  return W;
}

/// Every lane of every core draws numbers from one counter and signs the slot
/// of each number; every core also swaps and writes to the console. Who gets
/// which number shows in memory.
std::vector<uint32_t> drawNumbers() {
  return program(
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
  Config C = small();
  C.HostThreads = Threads;
  C.Quantum = Quantum;
  const auto M = make(C, drawNumbers());
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
    if (C.Word == addi(21, 0, '\n'))
      EXPECT_EQ(C.Result[3], uint32_t{'\n'});
  }
  uint64_t Instructions = 0, Lanes = 0;
};

} // namespace

TEST(Machine, AWspawnToNoCodeNamesTheAddress) {
  Config C = small();
  C.WarpsPerCore = 4;
  for (const auto &[Address, Cause] :
       {std::pair{0x12345000U, TrapCause::FetchFault},
        std::pair{VX_IMAGE_BASE + 2, TrapCause::MisalignedFetch}}) {
    std::vector<uint32_t> Words = {lui(6, Address), addi(6, 6, Address & 0xFFF),
                                   addi(7, 0, 3),
                                   encode(Op::VX_WSPAWN, {.Rs1 = 7, .Rs2 = 6})};
    const RunResult R = make(C, Words)->run();
    EXPECT_EQ(R.End, Outcome::Trap);
    EXPECT_EQ(R.Fault.Cause, Cause);
    EXPECT_EQ(R.Fault.Address, Address);
    EXPECT_EQ(R.Fault.Pc, VX_IMAGE_BASE + 12);
    EXPECT_EQ(R.Fault.Warp, 0U);
    // Nobody goes there if no warp is free.
    Words[2] = addi(7, 0, 1);
    Words.push_back(encode(Op::VX_TMC, {.Rs1 = 0}));
    EXPECT_EQ(make(C, Words)->run().End, Outcome::Done);
  }
}

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
  for (const unsigned Threads : {2U, 5U})
    EXPECT_EQ(runWith(Threads, 7).Memory, One.Memory);
}

TEST(Machine, ParkedAtomicsRunInCoreAndLaneOrder) {
  // One draw by each lane: all cores park at it together.
  const auto M =
      make(small(),
           program({lui(10, Counter), lui(11, Slots), csrr(12, CSR_MHARTID),
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
  const auto M = make(small(), drawNumbers());
  Counting Watch;
  M->setObservers({&Watch});
  M->setConsole(nullptr);
  const RunResult R = M->run();
  EXPECT_EQ(Watch.Instructions, R.Total.WarpInstructions);
  EXPECT_EQ(Watch.Lanes, R.Total.LaneInstructions);
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
  Config C = small();
  C.LanesPerWarp = 5;
  C.StackBytes = 4096;
  for (const unsigned Threads : {1U, 4U}) {
    C.HostThreads = Threads;
    const auto M = make(
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

TEST(Machine, LocalMemoryIsACoresOwnAndStartsZeroed) {
  // Each core adds its number + 1 to its local word and copies it out.
  const auto M = make(
      small(), {lui(10, VX_LOCAL_BASE), csrr(11, CSR_CORE_ID), lw(12, 0, 10),
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
  Config C = small();
  C.SocketsPerCluster = C.CoresPerSocket = 1;
  const auto M = Machine::create(C);
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
  const auto M = make(small(), {csrr(10, CSR_MSCRATCH), lui(11, Slots),
                                sw(10, 0, 11), encode(Op::VX_TMC, {.Rs1 = 0})});
  EXPECT_EQ(M->run(0x12340).End, Outcome::Done);
  EXPECT_EQ(wordAt(*M, Slots), 0x12340U);
}

TEST(Machine, TrapNamesPlaceAndLane) {
  ElfOptions O;
  O.Segments = {
      {VX_IMAGE_BASE, PF_R | PF_X, program({addi(6, 0, 1), lw(7, 0, 0)}), 0}};
  O.Symbols = {{"_start", VX_IMAGE_BASE}, {"culprit", VX_IMAGE_BASE + 12}};
  const auto Program = Image::parse(buildElf(O), "test");
  ASSERT_TRUE(Program);
  const auto M = Machine::create(small());
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
    Config C = small();
    C.SocketsPerCluster = C.CoresPerSocket = 1;
    C.Timing.Enabled = true;
    const RunResult R = make(C, Words)->run();
    EXPECT_EQ(R.End, Outcome::Trap);
    EXPECT_EQ(R.Total.Loads, 1U);
    EXPECT_EQ(R.Total.Stores, 1U);
    EXPECT_EQ(R.Total.Atomics, 0U);
    for (const Activity &A : R.Time->Activities)
      if (A.Unit == "core warp instructions" &&
          (A.Event == "load" || A.Event == "store"))
        EXPECT_EQ(A.Count, 1U) << A.Event;
  };
  Ends(lw(7, 0, 0));
  Ends(lw(7, 1, 8));
  Ends(sw(7, 0, 0));
  Ends(sw(7, 2, 8));
  Ends(encode(Op::RV_AMOADD_W, {.Rd = 7, .Rs1 = 0, .Rs2 = 7}));
}

TEST(Machine, RunsAgainAfterATrap) {
  const auto M = make(small(), {lw(7, 0, 0)});
  EXPECT_EQ(M->run().End, Outcome::Trap);
  M->load(codeImage({encode(Op::VX_TMC, {.Rs1 = 0})}));
  EXPECT_EQ(M->run().End, Outcome::Done);
}

TEST(Machine, WithoutAProgramItTraps) {
  const auto M = Machine::create(small());
  ASSERT_TRUE(M);
  EXPECT_EQ((*M)->run().End, Outcome::Trap);
}

TEST(Machine, ExitCodeIsTheLowestCoresFirst) {
  // Core 0 stores nothing that counts; lanes of core c store 10 c + lane.
  const auto M = make(
      small(),
      program({csrr(10, CSR_CORE_ID), csrr(11, CSR_THREAD_ID), addi(12, 0, 10),
               encode(Op::RV_MUL, {.Rd = 13, .Rs1 = 10, .Rs2 = 12}),
               encode(Op::RV_ADD, {.Rd = 13, .Rs1 = 13, .Rs2 = 11}),
               encode(Op::RV_CZERO_EQZ, {.Rd = 13, .Rs1 = 13, .Rs2 = 10}),
               sw(13, 0x44, 0)}));
  const RunResult R = M->run();
  EXPECT_EQ(R.End, Outcome::GuestFailed);
  EXPECT_EQ(R.ExitCode, 10U);
}

TEST(Machine, HostMemoryAccessIsBounded) {
  const auto M = make(small(), {0});
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
  Config C = small();
  C.LocalBytes = 64 << 10;
  const auto M =
      make(C, {addi(10, 0, -4), addi(11, 0, 77), sw(11, 0, 10), lw(12, 0, 10),
               lui(13, Slots), sw(12, 0, 13), lw(14, 4, 10)}); // address 0
  const RunResult R = M->run();
  EXPECT_EQ(R.Fault.Cause, TrapCause::LoadFault);
  EXPECT_EQ(R.Fault.Address, 0U);
  EXPECT_EQ(wordAt(*M, Slots), 77U);
}

TEST(Machine, RasterCommandsRunAndAnswer) {
  using raster::Csr;
  auto N = [](Csr C) { return static_cast<unsigned>(C); };
  // A tile of 4 x 2 pixels without Gaussians at Slots: black, T = 1.
  const auto M =
      make(small(),
           {csrr(5, CSR_CORE_ID), bne(5, 0, 17 * 4), lui(10, Slots),
            csrw(N(Csr::Output), 10), addi(11, 0, 64),
            csrw(N(Csr::OutputPitch), 11), lui(12, 0x20000), addi(12, 12, 4),
            csrw(N(Csr::TileShape), 12), csrw(N(Csr::Start), 0),
            csrr(13, N(Csr::Wait)), lui(14, Counter), sw(13, 0, 14),
            // The second has no shape.
            csrw(N(Csr::TileShape), 0), csrw(N(Csr::Start), 0),
            csrr(13, N(Csr::Wait)), sw(13, 4, 14), csrr(13, N(Csr::NCommands)),
            encode(Op::VX_TMC, {.Rs1 = 0})});
  const RunResult R = M->run();
  ASSERT_EQ(R.End, Outcome::Done) << R.Report;
  EXPECT_EQ(wordAt(*M, Counter), raster::VR_OK);
  EXPECT_EQ(wordAt(*M, Counter + 4), raster::VR_BAD_SHAPE);
  EXPECT_EQ(R.Raster.Commands, 2U);
  for (uint32_t Row = 0; Row != 2; ++Row)
    for (uint32_t Column = 0; Column != 4; ++Column) {
      const uint32_t Pixel = Slots + Row * 64 + Column * 16;
      EXPECT_EQ(wordAt(*M, Pixel), 0U);
      EXPECT_EQ(wordAt(*M, Pixel + 12), 0x3F800000U);
    }
  // The counters go on, a run's own begin at 0.
  EXPECT_EQ(M->run().Raster.Commands, 2U);
  EXPECT_EQ(M->readRasterCsr(0, N(Csr::NCommands)), 4U);
  EXPECT_EQ(M->readRasterCsr(1, N(Csr::NCommands)), 0U);
}

TEST(Machine, HostDrivesTheRasterWindow) {
  using raster::Csr;
  auto N = [](Csr C) { return static_cast<unsigned>(C); };
  const auto M = make(small(), {0});
  EXPECT_TRUE(M->writeRasterCsr(7, N(Csr::Output), Slots));
  EXPECT_TRUE(M->writeRasterCsr(7, N(Csr::OutputPitch), 16));
  EXPECT_TRUE(M->writeRasterCsr(7, N(Csr::TileShape), 0x00010001));
  EXPECT_TRUE(M->writeRasterCsr(7, N(Csr::Start), 0));
  EXPECT_EQ(M->readRasterCsr(7, N(Csr::Wait)), raster::VR_OK);
  EXPECT_EQ(wordAt(*M, Slots + 12), 0x3F800000U);
  EXPECT_EQ(M->readRasterCsr(7, N(Csr::TileShape)), 0x00010001U);
  EXPECT_FALSE(M->writeRasterCsr(7, N(Csr::Status), 0));
  EXPECT_FALSE(M->writeRasterCsr(8, N(Csr::Mode), 0));
  EXPECT_FALSE(M->readRasterCsr(0, 0x300));
}

TEST(Machine, HandOversReachThePixelUnitOfTheCluster) {
  using raster::Csr;
  Config C = small();
  C.Clusters = 2;
  const auto M = make(C, {encode(Op::VX_TMC, {.Rs1 = 0})});
  const auto N = [](Csr R) { return static_cast<unsigned>(R); };
  // Two pixels, two Gaussians of no box: all that is left of the second.
  constexpr uint32_t Record = Slots + 0x1000, Gaussians = Slots + 0x2000;
  const unsigned Last = C.cores() - 1;
  for (const auto &[R, Value] : {std::pair{Csr::Gaussians, Gaussians},
                                 {Csr::List, Gaussians + 0x100},
                                 {Csr::Count, 2U},
                                 {Csr::Output, Slots},
                                 {Csr::OutputPitch, 32U},
                                 {Csr::TileShape, 0x00010002U},
                                 {Csr::TailCount, 1U},
                                 {Csr::TailRecord, Record},
                                 {Csr::Start, 0U}})
    EXPECT_TRUE(M->writeRasterCsr(Last, N(R), Value));
  EXPECT_EQ(M->readRasterCsr(Last, N(Csr::Wait)), raster::VR_OK);
  EXPECT_EQ(M->readRasterCsr(Last, N(Csr::NTails)), 1U);
  EXPECT_EQ(M->readRasterCsr(Last, N(Csr::NTailPixels)), 2U);
  EXPECT_EQ(M->readRasterCsr(Last, N(Csr::NTailVisits)), 2U);
  EXPECT_EQ(M->readRasterCsr(0, N(Csr::NTails)), 0U);
  EXPECT_EQ(wordAt(*M, Record + offsetof(raster::Tail, Core)), Last);
}

TEST(Machine, ConsoleTextWithoutALineEndIsHandedOn) {
  // One core, 16 lanes, 10 stores a round: 160 bytes more each time.
  Config C = small();
  C.SocketsPerCluster = C.CoresPerSocket = 1;
  C.Quantum = 30;
  const auto M = make(
      C, program({lui(10, 0x3000), addi(11, 0, 'x'), sw(11, VX_IO_CONSOLE, 0),
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

TEST(Machine, LimitEndsARun) {
  Config C = small();
  C.MaxInstructions = 5000;
  const auto M =
      make(C, {addi(5, 5, 1), encode(Op::RV_JAL, {.Rd = 0, .Imm = -4})});
  const RunResult R = M->run();
  EXPECT_EQ(R.End, Outcome::LimitReached);
  EXPECT_GE(R.Total.WarpInstructions, 5000U);
  // At most the limit again for each core.
  EXPECT_LE(R.Total.WarpInstructions, 8 * 5002U);
  EXPECT_NE(R.Report.find("0x80000000"), std::string::npos) << R.Report;
}

TEST(Machine, LoopThatWaitsInVainIsAHang) {
  // All cores read a word that nobody writes.
  const auto M =
      make(small(), {lui(10, Slots), lw(11, 0, 10),
                     encode(Op::RV_BEQ, {.Rs1 = 11, .Rs2 = 0, .Imm = -4}),
                     encode(Op::VX_TMC, {.Rs1 = 0})});
  const RunResult R = M->run();
  EXPECT_EQ(R.End, Outcome::Hang);
  EXPECT_NE(R.Report.find("core.warp 0.0 1.0 2.0 3.0 4.0 5.0 6.0 7.0: running"),
            std::string::npos)
      << R.Report;
}

TEST(Machine, CountingLoopIsNoHang) {
  Config C = small();
  C.Quantum = 2; // many rounds without a store
  C.SocketsPerCluster = C.CoresPerSocket = 1;
  const auto M = make(C, {lui(10, 0x4000), addi(10, 10, -1), bne(10, 0, -4),
                          encode(Op::VX_TMC, {.Rs1 = 0})});
  EXPECT_EQ(M->run().End, Outcome::Done);
}

TEST(Machine, WaitingForTheCycleCounterIsNoHang) {
  Config C = small();
  C.Quantum = 16;
  C.SocketsPerCluster = C.CoresPerSocket = 1;
  // The register that is compared is the same for thousands of rounds.
  const auto M = make(C, {csrr(10, CSR_CYCLE),
                          encode(Op::RV_SRLI, {.Rd = 10, .Rs1 = 10, .Imm = 15}),
                          encode(Op::RV_BEQ, {.Rs1 = 10, .Rs2 = 0, .Imm = -8}),
                          encode(Op::VX_TMC, {.Rs1 = 0})});
  EXPECT_EQ(M->run().End, Outcome::Done);
}
