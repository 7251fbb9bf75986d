/// The fuzzers' targets on their seeds and on damaged ones: what a fuzzing run
/// starts with, in every test run.

#include "fuzz/Targets.h"

#include <gtest/gtest.h>
#include <random>

using namespace vorion::isasim;

namespace {

/// A few bytes changed.
std::vector<std::byte> damaged(std::vector<std::byte> Bytes,
                               std::mt19937 &Random) {
  for (auto Left = Random() % 4 + 1; Left && !Bytes.empty(); --Left)
    Bytes[Random() % Bytes.size()] = static_cast<std::byte>(Random());
  return Bytes;
}

} // namespace

TEST(Replay, Images) {
  std::mt19937 Random(1);
  for (const auto &Seed : fuzz::imageSeeds())
    for (int N = 0; N != 1000; ++N)
      fuzz::readImage(N ? damaged(Seed, Random) : Seed);
  fuzz::readImage({});
}

TEST(Replay, Programs) {
  std::mt19937 Random(2);
  for (const auto &Seed : fuzz::programSeeds(300, 3)) {
    fuzz::execute(Seed);
    fuzz::execute(damaged(Seed, Random));
  }
  fuzz::execute({});
}

TEST(Replay, Debuggers) {
  std::mt19937 Random(4);
  for (const auto &Seed : fuzz::debuggerSeeds())
    for (int N = 0; N != 100; ++N)
      fuzz::debug(N ? damaged(Seed, Random) : Seed);
  fuzz::debug({});
}

TEST(Replay, Rasterizers) {
  std::mt19937 Random(5);
  for (const auto &Seed : fuzz::rasterSeeds(200, 6)) {
    fuzz::rasterize(Seed);
    fuzz::rasterize(damaged(Seed, Random));
  }
  fuzz::rasterize({});
}
