/// The fuzzers' targets on their seeds and on damaged ones: what a fuzzing run
/// starts with, in every test run.

#include "fuzz/Targets.h"

#include <cstring>
#include <gtest/gtest.h>
#include <iterator>
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

/// With what may be a size, at an end of its range.
std::vector<std::byte> withSize(std::vector<std::byte> Bytes,
                                std::mt19937 &Random) {
  constexpr uint64_t Sizes[] = {
      0, 1, UINT32_MAX, uint64_t{1} << 40, UINT64_MAX / 8, UINT64_MAX};
  const uint64_t Size = Sizes[Random() % std::size(Sizes)];
  const size_t Length = Random() % 2 ? sizeof(uint64_t) : sizeof(uint32_t);
  std::memcpy(Bytes.data() + Random() % (Bytes.size() - Length), &Size, Length);
  return Bytes;
}

std::vector<std::byte> cut(std::vector<std::byte> Bytes, std::mt19937 &Random) {
  Bytes.resize(Random() % Bytes.size());
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

TEST(Replay, Regions) {
  std::mt19937 Random(7);
  for (const auto &Seed : fuzz::regionSeeds()) {
    fuzz::restore(Seed);
    for (int N = 0; N != 1000; ++N) {
      fuzz::restore(damaged(Seed, Random));
      fuzz::restore(withSize(Seed, Random));
      fuzz::restore(cut(Seed, Random));
    }
  }
  fuzz::restore({});
}

TEST(Replay, Rasterizers) {
  std::mt19937 Random(5);
  for (const auto &Seed : fuzz::rasterSeeds(200, 6)) {
    fuzz::rasterize(Seed);
    fuzz::rasterize(damaged(Seed, Random));
  }
  fuzz::rasterize({});
}
