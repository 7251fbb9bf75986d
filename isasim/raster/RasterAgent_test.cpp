// The Raster Agent's CSRs: write rules, queue, status, push buffer, drain.
#include "raster/RasterTest.h"

#include <numeric>

namespace vorion::raster {
namespace {

using AgentTest = RasterTest;

std::array<uint32_t, 16> lanes(uint32_t First) {
  std::array<uint32_t, 16> V;
  std::iota(V.begin(), V.end(), First);
  return V;
}

TEST(RasterAgentCsrs, OnlyTheAgentsOwnAreFound) {
  for (const CsrInfo &Info : isasim::CsrTable)
    EXPECT_EQ(findCsr(Info.Number), Info.Raster ? &Info : nullptr) << Info.Name;
  EXPECT_EQ(findCsr(0x7dd), nullptr);
  EXPECT_EQ(findCsr(0xfff), nullptr);
}

// Every CSR is reached: a read, and a write where there is a rule.
TEST(RasterAgentCsrs, EveryCsrIsImplemented) {
  for (const CsrInfo &Info : isasim::CsrTable) {
    if (!Info.Raster)
      continue;
    RasterAgent Agent;
    const auto C = static_cast<Csr>(Info.Number);
    EXPECT_EQ(Agent.read(C, 3), 0U) << Info.Name;
    if (Info.Rule == WriteRule::None || C == Csr::Start || C == Csr::Push)
      continue;
    Agent.write(C, lanes(100), 0xffff);
    EXPECT_EQ(Agent.read(C, 3), Info.Rule == WriteRule::Scalar ? 115U : 103U)
        << Info.Name;
  }
}

TEST(RasterAgentCsrs, ScalarIsTheLastActiveLane) {
  RasterAgent Agent;
  for (const uint32_t Mask : {0x1U, 0x8000U, 0x0ff0U, 0x5U}) {
    Agent.write(Csr::Count, lanes(100), Mask);
    EXPECT_EQ(Agent.read(Csr::Count, 0), 100 + std::bit_width(Mask) - 1);
  }
}

TEST(RasterAgentCsrs, PerLaneLeavesInactiveLanes) {
  RasterAgent Agent;
  Agent.write(Csr::GTag, lanes(100), 0xffff);
  Agent.write(Csr::GTag, lanes(200), 0x0a);
  std::array<uint32_t, 16> Read{};
  Agent.readLanes(Csr::GTag, 0x1f, Read);
  EXPECT_EQ(std::vector(Read.begin(), Read.begin() + 6),
            (std::vector<uint32_t>{100, 201, 102, 203, 104, 0}));
}

TEST_F(AgentTest, FullQueueRefusesUntilOneIsTaken) {
  configure({});
  RasterAgent Small({.Lanes = 1, .QueueDepth = 2});
  Rasterizer Serving(Memory, {&Small});
  const uint32_t One = 1;
  for (int I = 0; I != 2; ++I) {
    ASSERT_TRUE(Small.canStart());
    Small.write(Csr::Start, std::span(&One, 1), 1);
  }
  EXPECT_FALSE(Small.canStart());
  EXPECT_EQ(Small.read(Csr::Status, 0) & 1, 1U);
  Serving.makeRoom(Small);
  EXPECT_TRUE(Small.canStart());
  EXPECT_TRUE(Small.isBusy());
  EXPECT_TRUE(Serving.step());
  EXPECT_FALSE(Serving.step());
  EXPECT_FALSE(Small.isBusy());
}

TEST_F(AgentTest, BankIsCopiedAtStart) {
  const Gaussian G = roundGaussian(32, 32, 4, 0.5F);
  configure(std::span(&G, 1));
  set(Csr::Start, 0U);
  set(Csr::Count, 0U);
  set(Csr::TileShape, 0U);
  Unit.finish(Agent);
  EXPECT_EQ(Agent.read(Csr::Wait, 0), VR_OK);
  EXPECT_EQ(Agent.counters().Gaussians, 1U);
}

TEST_F(AgentTest, FirstFailureSticksUntilWait) {
  configure({});
  set(Csr::TileShape, 0U);
  set(Csr::Start, 0U);
  set(Csr::Output, Pixels + 1);
  set(Csr::TileShape, 0x400040U);
  set(Csr::Start, 0U);
  set(Csr::Output, Pixels);
  set(Csr::Start, 0U);
  EXPECT_EQ(Agent.read(Csr::Status, 0), StatusBusy.put(1));
  Unit.finish(Agent);
  EXPECT_EQ(Agent.read(Csr::Status, 0), StatusCode.put(VR_BAD_SHAPE));
  // All lanes see it: a uniform CSR is read once.
  std::array<uint32_t, 16> Seen{};
  Agent.readLanes(Csr::Wait, 0xffff, Seen);
  for (const uint32_t Code : Seen)
    EXPECT_EQ(Code, VR_BAD_SHAPE);
  EXPECT_EQ(Agent.read(Csr::Wait, 0), VR_OK);
  EXPECT_EQ(Agent.read(Csr::Status, 0), 0U);
  EXPECT_EQ(Agent.counters().Commands, 3U);
}

TEST_F(AgentTest, CountersHaveHighWords) {
  set(Csr::Start, 0U);
  Agent.complete(VR_OK, {1ULL << 32 | 2, 3ULL << 32 | 4, 5ULL << 32 | 6,
                         7ULL << 32 | 8, 9ULL << 32 | 10, 11ULL << 32 | 12});
  const Csr Low[] = {Csr::NCommands,  Csr::NGaussians, Csr::NClipped,
                     Csr::NFragments, Csr::NBlends,    Csr::NIntersecting};
  const Csr High[] = {Csr::NCommandsh,  Csr::NGaussiansh, Csr::NClippedh,
                      Csr::NFragmentsh, Csr::NBlendsh,    Csr::NIntersectingh};
  for (uint32_t I = 0; I != std::size(Low); ++I) {
    EXPECT_EQ(Agent.read(Low[I], 0), 2 * I + 2);
    EXPECT_EQ(Agent.read(High[I], 0), 2 * I + 1);
  }
}

/// Stages \p Scene in lanes 0... and pushes it with the lanes of \p Mask.
void stageAndPush(RasterAgent &Agent, std::span<const Gaussian> Scene,
                  uint32_t Mask) {
  for (unsigned Word = 0; Word != sizeof(Gaussian) / 4; ++Word) {
    std::array<uint32_t, 16> Values{};
    for (std::size_t L = 0; L != Scene.size(); ++L)
      std::memcpy(&Values[L],
                  reinterpret_cast<const char *>(&Scene[L]) + 4 * Word, 4);
    Agent.write(static_cast<Csr>(static_cast<unsigned>(Csr::GMeanX) + Word),
                Values, 0xffff);
  }
  Agent.write(Csr::Push, std::array<uint32_t, 16>{}, Mask);
}

TEST_F(AgentTest, PushedEqualsList) {
  std::vector<Gaussian> Scene;
  for (unsigned I = 0; I != 16; ++I)
    Scene.push_back(roundGaussian(4.0F * static_cast<float>(I), 30, 5, 0.6F,
                                  static_cast<float>(I), 1, 0));
  // Lanes in ascending order, inactive ones left out.
  std::vector<Gaussian> Active;
  for (unsigned I = 0; I != 16; ++I)
    if (0xf5a3U >> I & 1)
      Active.push_back(Scene[I]);
  const std::vector<Pixel> FromList = render(Active);
  const Counters ListWork = Agent.counters();

  configure({}, {.Mode = ModePushed.put(1)});
  set(Csr::Gaussians, 1U); // not used
  set(Csr::Count, 0xffffffffU);
  stageAndPush(Agent, Scene, 0xf5a3);
  ASSERT_EQ(start(), VR_OK);
  EXPECT_EQ(pixels(), FromList);
  EXPECT_EQ(Agent.counters().Gaussians, 2 * ListWork.Gaussians);
  EXPECT_EQ(Agent.counters().Blends, 2 * ListWork.Blends);

  // The command took them: the next has none.
  ASSERT_EQ(start(), VR_OK);
  EXPECT_EQ(Agent.counters().Gaussians, 2 * ListWork.Gaussians);
}

TEST_F(AgentTest, PushesWaitForACommandThatTakesThem) {
  const Gaussian G = roundGaussian(32, 32, 4, 0.5F);
  const std::vector<Pixel> Right = render(std::span(&G, 1));
  stageAndPush(Agent, std::span(&G, 1), 1);
  configure({});
  ASSERT_EQ(start(), VR_OK);
  EXPECT_NE(pixels(), Right);
  set(Csr::Mode, ModePushed.put(1));
  ASSERT_EQ(start(), VR_OK);
  EXPECT_EQ(pixels(), Right);
}

TEST_F(AgentTest, OverfullPushBufferIsBadCount) {
  const Gaussian G = roundGaussian(32, 32, 4, 0.5F);
  configure({}, {.Mode = ModePushed.put(1)});
  for (unsigned I = 0; I != VR_MAX_PUSHED / 16; ++I)
    stageAndPush(Agent, std::vector<Gaussian>(16, G), 0xffff);
  ASSERT_EQ(start(), VR_OK);
  for (unsigned I = 0; I != VR_MAX_PUSHED / 16; ++I)
    stageAndPush(Agent, std::vector<Gaussian>(16, G), 0xffff);
  stageAndPush(Agent, std::span(&G, 1), 1);
  EXPECT_EQ(start(), VR_BAD_COUNT);
  // The failed command took them all the same.
  EXPECT_EQ(start(), VR_OK);
}

TEST_F(AgentTest, DrainedPixelsEqualMemory) {
  const Gaussian G = roundGaussian(110, 205, 6, 0.7F);
  const TileCommand Tile{.X = 100, .Y = 200, .Width = 17, .Height = 9};
  const std::vector<Pixel> Right = render(std::span(&G, 1), Tile);

  TileCommand Draining = Tile;
  Draining.Mode = ModeDrain.put(1);
  configure(std::span(&G, 1), Draining);
  set(Csr::Output, 1U); // not used
  ASSERT_EQ(start(), VR_OK);
  for (uint32_t First = 0; First != 160; First += 16) {
    Agent.write(Csr::PixelIndex, lanes(First), 0xffff);
    for (unsigned L = 0; L != 16; ++L) {
      const Pixel Read{std::bit_cast<float>(Agent.read(Csr::PixelR, L)),
                       std::bit_cast<float>(Agent.read(Csr::PixelG, L)),
                       std::bit_cast<float>(Agent.read(Csr::PixelB, L)),
                       std::bit_cast<float>(Agent.read(Csr::PixelT, L))};
      // 153 pixels; beyond them 0.
      EXPECT_EQ(Read, First + L < Right.size() ? Right[First + L] : Pixel{});
    }
  }

  // A failed command leaves the tile as it is; so does one to memory.
  set(Csr::Cutoff, 2.0F);
  ASSERT_EQ(start(), VR_BAD_CUTOFF);
  render({});
  Agent.write(Csr::PixelIndex, lanes(80), 0xffff);
  EXPECT_EQ(std::bit_cast<float>(Agent.read(Csr::PixelT, 5)), Right[85].T);
}

TEST(RasterAgentState, IsAnothersToGoOnWith) {
  RasterAgent First, Second;
  First.write(Csr::Output, lanes(100), 0xffff);
  First.write(Csr::GMeanX, lanes(7), 0xffff);
  First.write(Csr::PixelIndex, lanes(30), 0xffff);
  First.write(Csr::Start, lanes(0), 1);
  EXPECT_EQ(First.state(), nullptr) << "a command is under way";
  First.complete(VR_BAD_CUTOFF, {5});
  ASSERT_NE(First.state(), nullptr);
  ASSERT_TRUE(Second.setState(*First.state()));
  for (const Csr C : {Csr::Output, Csr::GMeanX, Csr::PixelIndex, Csr::Status})
    EXPECT_EQ(Second.read(C, 3), First.read(C, 3));
  EXPECT_EQ(Second.read(Csr::Wait, 0), uint32_t{VR_BAD_CUTOFF});
  RasterAgent Narrow({.Lanes = 8});
  EXPECT_FALSE(Narrow.setState(*First.state()));
  // A batch that nobody has taken is under way, too.
  First.offer({0, 1, {}});
  EXPECT_EQ(First.state(), nullptr);
}

} // namespace
} // namespace vorion::raster
