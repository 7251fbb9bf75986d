/// A run that has a limit ends, whatever the program does.

#include "machine/MachineTest.h"
#include "raster/RasterTables.h"

#include <chrono>
#include <functional>
#include <limits>

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr unsigned AllLanes = 5; ///< the register that programs keep it in

std::vector<uint32_t> start() {
  std::vector<uint32_t> Words;
  loadConstant(Words, AllLanes, 0xFFFF);
  Words.push_back(encode(Op::VX_TMC, {.Rs1 = AllLanes}));
  loadConstant(Words, AllLanes, 0xFFFF); // in the others, too
  return Words;
}

struct Ended {
  RunResult Result;
  double Seconds;
};

Ended runOf(
    const Config &C, const std::vector<uint32_t> &Words, double Watchdog = 0,
    const std::function<void(Machine &)> &Prepare = [](Machine &) {}) {
  const auto M = machineFor(C, Words);
  M->setWatchdog(Watchdog);
  Prepare(*M);
  const auto Begin = std::chrono::steady_clock::now();
  Ended E{M->run(), 0};
  E.Seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - Begin)
          .count();
  return E;
}

/// Generous: the host may be busy.
constexpr double Soon = 20;

} // namespace

TEST(Limits, JoinsWithoutABranch) {
  // Each split sends half of the lanes each way, and each side turns all lanes
  // on again: nested, the joins go through 2^40 sides.
  std::vector<uint32_t> Words = start();
  constexpr unsigned Depth = 40;
  Words.push_back(csrr(6, CSR_THREAD_ID));
  for (unsigned N = 0; N != Depth; ++N) {
    Words.push_back(encode(Op::VX_SPLIT, {.Rd = 7, .Rs1 = 6}));
    Words.push_back(encode(Op::VX_TMC, {.Rs1 = AllLanes}));
  }
  Words.push_back(addi(8, 0, Depth + 1));
  for (unsigned N = 0; N != Depth; ++N)
    Words.push_back(encode(Op::VX_JOIN, {.Rs1 = 8}));
  Words.push_back(encode(Op::VX_TMC, {.Rs1 = 0}));
  Config C = smallConfig();
  C.DivergenceDepth = 64;
  C.MaxInstructions = 100000;
  const Ended Counted = runOf(C, Words);
  EXPECT_EQ(Counted.Result.End, Outcome::LimitReached);
  EXPECT_NE(Counted.Result.Report.find(" instructions, the maximum"),
            std::string::npos)
      << Counted.Result.Report;
  C.MaxInstructions = 0;
  const Ended Timed = runOf(C, Words, 0.05);
  EXPECT_EQ(Timed.Result.End, Outcome::LimitReached);
  EXPECT_LT(Timed.Seconds, Soon);
}

TEST(Limits, WarpsThatStartEachOther) {
  // Every warp starts those that have ended, and ends.
  std::vector<uint32_t> Words;
  loadConstant(Words, 6, VX_IMAGE_BASE);
  Words.push_back(addi(7, 0, 4));
  Words.push_back(encode(Op::VX_WSPAWN, {.Rs1 = 7, .Rs2 = 6}));
  Words.push_back(encode(Op::VX_TMC, {.Rs1 = 0}));
  Config C = smallConfig();
  C.WarpsPerCore = 4;
  C.MaxInstructions = 100000;
  EXPECT_EQ(runOf(C, Words).Result.End, Outcome::LimitReached);
  C.MaxInstructions = 0;
  const Ended Timed = runOf(C, Words, 0.05);
  EXPECT_EQ(Timed.Result.End, Outcome::LimitReached);
  EXPECT_LT(Timed.Seconds, Soon);
}

TEST(Limits, WatchdogWithinATurn) {
  std::vector<uint32_t> Words = start();
  Words.push_back(addi(6, 6, 1));
  Words.push_back(encode(Op::RV_JAL, {.Rd = 0, .Imm = -4}));
  Config C = smallConfig();
  C.Quantum = 1 << 30; // the longest
  const Ended E = runOf(C, Words, 0.05);
  EXPECT_EQ(E.Result.End, Outcome::LimitReached);
  EXPECT_EQ(E.Result.Report.substr(0, 9), "watchdog:");
  EXPECT_LT(E.Seconds, Soon);
}

TEST(Limits, WatchdogWithinARasterizer) {
  // Every core's queue full of the longest list, of Gaussians that reach every
  // pixel and close none: minutes.
  constexpr uint32_t Output = VX_GLOBAL_BASE + 0x1000;
  constexpr uint32_t List = VX_GLOBAL_BASE + 0x100000;
  constexpr unsigned Queue = 4;
  std::vector<uint32_t> Words = start();
  const auto Write = [&](raster::Csr Csr, uint32_t Value) {
    loadConstant(Words, 6, Value);
    Words.push_back(csrw(Csr, 6));
  };
  Write(raster::Csr::Gaussians, VX_GLOBAL_BASE);
  Write(raster::Csr::List, List);
  Write(raster::Csr::Count, raster::VR_MAX_COUNT);
  Write(raster::Csr::TileShape,
        raster::TileShapeWidth.put(64) | raster::TileShapeHeight.put(64));
  Write(raster::Csr::Output, Output);
  Write(raster::Csr::OutputPitch, 64 * 16);
  for (unsigned N = 0; N != Queue; ++N)
    Write(raster::Csr::Start, 1);
  Words.push_back(csrr(6, raster::Csr::Wait));
  Words.push_back(encode(Op::VX_TMC, {.Rs1 = 0}));
  Config C = smallConfig();
  C.GlobalBytes = 0x100000 + 4ULL * raster::VR_MAX_COUNT;
  const Ended E = runOf(C, Words, 0.05, [](Machine &M) {
    raster::Gaussian G{};
    G.Extent[0] = G.Extent[1] = std::numeric_limits<float>::infinity();
    ASSERT_TRUE(M.write(VX_GLOBAL_BASE, std::as_bytes(std::span(&G, 1))));
  });
  EXPECT_EQ(E.Result.End, Outcome::LimitReached);
  EXPECT_LT(E.Seconds, Soon);
}

TEST(Limits, AWatchdogOfTheLastRunStopsNothing) {
  // Commands of the host, after the time is long over. The loop counts, so that
  // a fast host does not find it in the same state before that.
  std::vector<uint32_t> Words = start();
  Words.push_back(encode(Op::RV_ADDI, {.Rd = 5, .Rs1 = 5, .Imm = 1}));
  Words.push_back(encode(Op::RV_JAL, {.Rd = 0, .Imm = -4}));
  const auto M = machineFor(smallConfig(), Words);
  M->setWatchdog(0.01);
  EXPECT_EQ(M->run().End, Outcome::LimitReached);
  EXPECT_FALSE(M->mustStop());
}

TEST(Machine, LimitEndsARun) {
  Config C = smallConfig();
  C.MaxInstructions = 5000;
  const auto M =
      machineFor(C, {addi(5, 5, 1), encode(Op::RV_JAL, {.Rd = 0, .Imm = -4})});
  const RunResult R = M->run();
  EXPECT_EQ(R.End, Outcome::LimitReached);
  EXPECT_GE(R.Total.WarpInstructions, 5000U);
  // At most the limit again for each core.
  EXPECT_LE(R.Total.WarpInstructions, 8 * 5002U);
  EXPECT_NE(R.Report.find("0x80000000"), std::string::npos) << R.Report;
}
