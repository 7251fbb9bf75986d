// The fuzzers' targets on their seeds and on damaged ones: what a fuzzing run
// starts with, in every test run.
#include "capture/fuzz/Targets.h"

#include <gtest/gtest.h>
#include <random>

using namespace vorion::splat;

namespace {

/// A few bytes changed, left out, or said twice.
std::string damaged(std::string Text, std::mt19937 &Random) {
  for (auto Left = Random() % 4 + 1; Left != 0 && !Text.empty(); --Left) {
    const std::size_t At = Random() % Text.size();
    const std::size_t Length = Random() % 9;
    switch (Random() % 4) {
    case 0:
      Text.erase(At, Length);
      break;
    case 1:
      Text.insert(At, Text.substr(At, Length));
      break;
    default:
      Text[At] = static_cast<char>(Random());
    }
  }
  return Text;
}

void replay(const fuzz::Seeds &Seeds, void (*Target)(Bytes),
            int Damages = 1500) {
  std::mt19937 Random(1);
  const auto Call = [&](const std::string &Text) {
    Target(std::as_bytes(std::span(Text)));
  };
  for (const auto &[Name, Seed] : Seeds) {
    Call(Seed);
    for (int N = 0; N < Damages; ++N)
      Call(damaged(Seed, Random));
  }
  Call("");
}

TEST(CaptureReplay, Colmap) { replay(fuzz::colmapSeeds(), fuzz::readColmap); }

TEST(CaptureReplay, Transforms) {
  replay(fuzz::transformsSeeds(), fuzz::readTransforms);
}

// OpenEXR takes milliseconds to open a file.
TEST(CaptureReplay, Exr) { replay(fuzz::exrSeeds(), fuzz::readExr, 200); }

TEST(CaptureReplay, Photos) { replay(fuzz::photoSeeds(), fuzz::readPhoto); }

} // namespace
