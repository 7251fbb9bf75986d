// The fuzzers' targets on their seeds and on damaged ones: what a fuzzing run
// starts with, in every test run.
#include "accuracy/fuzz/Targets.h"

#include <gtest/gtest.h>
#include <random>

using namespace vorion::splat;

namespace {

/// A few bytes changed, left out, or said twice.
std::string damaged(std::string Text, std::mt19937 &Random) {
  for (auto Left = Random() % 4 + 1; Left != 0 && !Text.empty(); --Left) {
    const std::size_t At = Random() % Text.size();
    const std::size_t Length = Random() % 30;
    switch (Random() % 4) {
    case 0:
      Text.erase(At, Length);
      break;
    case 1:
      Text.insert(At, Text.substr(Random() % Text.size(), Length));
      break;
    default:
      Text[At] = static_cast<char>(Random());
    }
  }
  return Text;
}

/// \p Seeds, which are read to \p Whole things, and \p Times damaged ones of
/// each.
void replay(const fuzz::Seeds &Seeds, std::size_t (*Target)(Bytes),
            std::size_t Whole, int Times) {
  std::mt19937 Random(1);
  const auto Call = [&](const std::string &Text) {
    return Target(std::as_bytes(std::span(Text)));
  };
  for (const auto &[Name, Seed] : Seeds) {
    EXPECT_EQ(Call(Seed), Name == "foreign" ? 0 : Whole) << Name;
    for (int N = 0; N < Times; ++N)
      EXPECT_LE(Call(damaged(Seed, Random)), Whole);
  }
  EXPECT_EQ(Call(""), 0U);
}

TEST(KeptReplay, Checkpoints) {
  replay(fuzz::checkpointSeeds(), fuzz::readCheckpoint, 2, 2000);
}

// A message may name a letter that is not of ASCII, as the fuzzer found.
TEST(KeptReplay, LettersBeyondAscii) {
  const std::string Text = "vorion-checkpoint 4 1dff\xdd\x98\n";
  EXPECT_EQ(fuzz::readCheckpoint(std::as_bytes(std::span(Text))), 0U);
}

TEST(KeptReplay, Sweeps) {
  replay(fuzz::sweepSeeds(), fuzz::readSweep, 2, 150);
}

TEST(KeptReplay, TrainSweeps) {
  replay(fuzz::trainSweepSeeds(), fuzz::readTrainSweep, 16, 50);
}

} // namespace
