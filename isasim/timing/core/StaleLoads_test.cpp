/// Data caches are not coherent: loads that miss a write are counted.
#include "timing/memory/LineWriters.h"

#include "testing/TimedPrograms.h"

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

class StaleLoads : public ClockTest {
protected:
  void SetUp() override {
    Settings = timed(2);
    Settings.Timing.Core.DcacheKib = 16;
  }
  /// Both cores load the same line, core 1 does \p Access to it, and both load
  /// again.
  uint64_t behind(const Words &Access) {
    const Words Meet = {lui(12, 0x80000000), addi(13, 0, 2),
                        encode(Op::VX_BAR, {.Rs1 = 12, .Rs2 = 13})};
    const auto Behind = 4 * static_cast<int32_t>(Access.size() + 1);
    const TimeReport R =
        run(Words{lw(14, 0, 7), encode(Op::RV_FENCE, {})} + Meet +
            Words{csrr(10, CSR_CORE_ID),
                  encode(Op::RV_BEQ, {.Rs1 = 10, .Rs2 = 0, .Imm = Behind})} +
            Access + Meet + Words{lw(14, 0, 7)});
    EXPECT_EQ(activity(R, "data cache", "stale loads"), R.StaleLoads);
    return R.StaleLoads;
  }
};

TEST_F(StaleLoads, OthersWritesAreMissed) {
  EXPECT_EQ(behind({lw(15, 0, 7)}), 0U);
  EXPECT_EQ(behind({sw(6, 256, 7)}), 0U) << "another line";
  EXPECT_EQ(behind({sw(6, 0, 7)}), 1U) << "by the other core, not by its own";
}

TEST_F(StaleLoads, AtomicsAreMissedByAll) {
  EXPECT_EQ(behind({encode(Op::RV_AMOADD_W, {.Rd = 15, .Rs1 = 7, .Rs2 = 6})}),
            2U);
}

TEST_F(StaleLoads, WithoutADataCacheNothingIsStale) {
  Settings.Timing.Core.DcacheKib = 0;
  EXPECT_EQ(run({sw(6, 0, 7), lw(14, 0, 7)}).StaleLoads, 0U);
}

TEST(LineWriters, KnowsTheLastWriteOfAnybodyElse) {
  LineWriters W;
  EXPECT_FALSE(W.isWritten(0, 0, 1));
  W.written(0, 1);
  W.written(4, 1);
  EXPECT_FALSE(W.isWritten(0, 0, 1)) << "its own";
  EXPECT_TRUE(W.isWritten(0, 0, 2));
  EXPECT_FALSE(W.isWritten(0, W.count(), 2)) << "seen";
  EXPECT_FALSE(W.isWritten(64, 0, 2)) << "another line";
  const uint64_t Before = W.count();
  W.written(0, 2);
  W.written(0, 1);
  EXPECT_TRUE(W.isWritten(0, Before, 1)) << "in front of its own";
  EXPECT_TRUE(W.isWritten(0, Before, 2));
  W.written(0, Ticket::Nobody);
  EXPECT_TRUE(W.isWritten(0, W.count() - 1, 1)) << "an atomic";
  W.clear();
  EXPECT_FALSE(W.isWritten(0, 0, 3));
}

} // namespace
