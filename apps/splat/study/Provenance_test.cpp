#include "study/Provenance.h"

#include "io/TestFiles.h"
#include "lens/Models.h"

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

using namespace vorion;
using namespace vorion::splat;

namespace {

TEST(Provenance, WhatDiffersIsNamed) {
  using Json = nlohmann::ordered_json;
  const Provenance Wanted{{"machine", "m"}, {"programs", "p"}, {"scene", "s"}};
  EXPECT_EQ(difference(Json(Wanted), Wanted), "");
  EXPECT_EQ(difference(Json{{"machine", "m"}, {"programs", "p"}}, Wanted),
            "scene");
  EXPECT_EQ(difference(Json{{"machine", 7}, {"programs", "p"}}, Wanted),
            "machine and scene");
  for (const Json &Other : {Json(), Json("x"), Json::array({1})})
    EXPECT_EQ(difference(Other, Wanted), "machine, programs and scene");
}

TEST(Provenance, TheLineOfHashesLeavesOutOptions) {
  EXPECT_EQ(hashLine({{"machine", "0123456789abcdef"},
                      {"options", "--size 0123456789"},
                      {"scene", "fedcba9876543210"}}),
            "fnv1a64: machine 0123456789abcdef, scene fedcba9876543210");
}

TEST(Provenance, AViewIsWhatItSeesNotItsName) {
  Camera A = Camera::ahead(64, 48, 50);
  Camera B = A;
  B.Name = "other";
  B.Id = 7;
  EXPECT_EQ(hashView(A), hashView(B));
  B.Rotation[1][2] = 1e-9;
  EXPECT_NE(hashView(A), hashView(B));
}

Capture oneView(const TestFolder &F) {
  Capture C;
  CaptureView &View = C.Views.emplace_back();
  View.Pose = Camera::ahead(64, 48, 50);
  View.Picture = F.write("a.png", "a");
  return C;
}

// What a lens bends is trained on as its undistorted picture.
TEST(Provenance, ACaptureIsWhatItsLensesAreToo) {
  const TestFolder F;
  Capture C = oneView(F);
  CaptureView &View = C.Views.front();
  const auto Straight = hashCapture(C);
  View.Optics = {&lenses::OpenCv, {0.1}};
  const auto Bent = hashCapture(C);
  ASSERT_TRUE(Straight && Bent);
  EXPECT_NE(*Straight, *Bent);
}

TEST(Provenance, ACaptureIsWhatItsMasksAreToo) {
  const TestFolder F;
  Capture C = oneView(F);
  CaptureView &View = C.Views.front();
  const auto Whole = hashCapture(C);
  View.Mask = F.write("mask.png", "1");
  const auto One = hashCapture(C);
  F.write("mask.png", "2");
  const auto Other = hashCapture(C);
  ASSERT_TRUE(Whole && One && Other);
  EXPECT_NE(*Whole, *One);
  EXPECT_NE(*One, *Other);
}

TEST(Provenance, TheMachineIsWhatItsFileSays) {
  const TestFolder F;
  const auto MachineOf = [&](const char *Config, const char *Set) {
    DeviceOptions Machine;
    Machine.set("VORION_CONFIG", Config);
    Machine.set("VORION_SET", Set);
    const auto All = commonProvenance(Machine);
    EXPECT_TRUE(All);
    return All ? All->at("machine") : "";
  };
  const std::string One = F.write("one.json", "{\"cores\": 1}");
  const std::string Same = F.write("same.json", "{\"cores\": 1}");
  const std::string Two = F.write("two.json", "{\"cores\": 2}");
  EXPECT_EQ(MachineOf(One.c_str(), ""), MachineOf(Same.c_str(), ""));
  EXPECT_NE(MachineOf(One.c_str(), ""), MachineOf(Two.c_str(), ""));
  EXPECT_NE(MachineOf(One.c_str(), ""), MachineOf(One.c_str(), "cores=3"));
  EXPECT_EQ(MachineOf(One.c_str(), "cores=3"),
            MachineOf(Same.c_str(), "cores=3"));
}

/// Whatever a compiler is called: another one makes other results.
TEST(Provenance, AChangedProgramIsAnother) {
  const TestFolder F;
  std::filesystem::create_directories(F.path("bin"));
  std::filesystem::create_directories(F.path("lib/vorion"));
  setenv("VORION_ROOT", F.path("").c_str(), 1);
  const auto Programs = [] { return commonProvenance({})->at("programs"); };
  F.write("bin/vorion-compiler", "a");
  F.write("lib/vorion/libdevice.a", "b");
  const std::string Before = Programs();
  EXPECT_EQ(Programs(), Before);
  F.write("lib/vorion/libdevice.a", "c");
  EXPECT_NE(Programs(), Before);
  F.write("lib/vorion/libdevice.a", "b");
  EXPECT_EQ(Programs(), Before);
  F.write("bin/vorion-compiler", "b");
  EXPECT_NE(Programs(), Before);
  // Wherever it changed, also in several words at once, and in its length.
  const std::string Content(21, 'x');
  std::set<std::string> Seen;
  const auto Add = [&](const std::string &Changed) {
    F.write("bin/vorion-compiler", Changed);
    EXPECT_TRUE(Seen.insert(Programs()).second) << Changed;
  };
  Add(Content);
  for (const std::size_t At : {0, 7, 8, 15, 16, 20}) {
    std::string Changed = Content;
    Changed[At] = 'y';
    Add(Changed);
  }
  std::string HighBits = Content;
  HighBits[7] = HighBits[15] = static_cast<char>('x' ^ 0x80);
  Add(HighBits);
  for (const std::size_t More : {1, 3, 11})
    Add(Content + std::string(More, '\0'));
  unsetenv("VORION_ROOT");
}

TEST(Provenance, FilesAreMadeOnceForTheSame) {
  const TestFolder F;
  const std::vector<std::string> Files{F.path("a"), F.path("b")};
  int Made = 0;
  const auto Make = [&](const Provenance &From) {
    const auto Done = makeOnce(Files, From, [&]() -> Expected<Success> {
      ++Made;
      F.write("a", From.at("scene"));
      F.write("b", "b");
      return Success{};
    });
    EXPECT_TRUE(Done);
    return F.read("a");
  };
  const Provenance One{{"scene", "1"}}, Two{{"scene", "2"}};
  EXPECT_EQ(Make(One), "1");
  EXPECT_EQ(Make(One), "1");
  EXPECT_EQ(Made, 1);
  EXPECT_EQ(Make(Two), "2");
  EXPECT_EQ(Make(One), "1");
  EXPECT_EQ(Made, 3);
  // A file that somebody changed, or that is gone, is made again.
  F.write("b", "c");
  EXPECT_EQ(Make(One), "1");
  EXPECT_EQ(F.read("b"), "b");
  std::filesystem::remove(F.path("a"));
  EXPECT_EQ(Make(One), "1");
  EXPECT_EQ(Made, 5);
  // What was broken off is not taken for what was there before.
  const auto Broken = makeOnce(Files, Two, [&]() -> Expected<Success> {
    F.write("a", "2");
    return Error{"", "broken off"};
  });
  EXPECT_FALSE(Broken);
  F.write("a", "1");
  EXPECT_EQ(Make(One), "1");
  EXPECT_EQ(Made, 6);
}

} // namespace
