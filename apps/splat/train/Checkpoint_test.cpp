#include "Checkpoint.h"

#include "../io/Hash.h"
#include "../io/TestFiles.h"
#include "../render/Layout.h"

#include <algorithm>
#include <csignal>
#include <fmt/format.h>
#include <sys/resource.h>

using namespace vorion;
using namespace vorion::splat;

namespace {

Checkpoint sample() {
  constexpr std::size_t Count = 6;
  Checkpoint C;
  C.Run = R"({"seed": 3})";
  C.Iteration = 4;
  C.ShDegree = 1;
  float Next = 0;
  const auto Fill = [&Next](auto &A, std::size_t Size) {
    A.resize(Size);
    for (auto &V : A)
      V = static_cast<std::remove_reference_t<decltype(V)>>(++Next);
  };
  for (auto *A : {&C.Geometry, &C.FirstGeometry, &C.SecondGeometry})
    Fill(*A, GEOMETRY_PLANES * Count);
  for (auto *A : {&C.Sh, &C.FirstSh, &C.SecondSh})
    Fill(*A, 12 * Count);
  Fill(C.Identities, Count);
  Fill(C.Notes.GradientSums, Count);
  Fill(C.Notes.Views, Count);
  Fill(C.Notes.Radii, Count);
  Fill(C.Losses, 4);
  return C;
}

TEST(Checkpoint, HoldsWhatWasWritten) {
  const TestFolder F;
  const Checkpoint A = sample();
  ASSERT_TRUE(writeCheckpoint(F.path("c"), A));
  const auto B = readCheckpoint(F.path("c"));
  ASSERT_TRUE(B) << B.error().What;
  EXPECT_EQ(B->Run, A.Run);
  EXPECT_EQ(B->Iteration, 4U);
  EXPECT_EQ(B->gaussians(), 6U);
  EXPECT_EQ(B->Geometry, A.Geometry);
  EXPECT_EQ(B->SecondSh, A.SecondSh);
  EXPECT_EQ(B->Identities, A.Identities);
  EXPECT_EQ(B->Notes.Views, A.Notes.Views);
  EXPECT_EQ(B->Losses, A.Losses);
}

TEST(Checkpoint, DamageIsNoticed) {
  const TestFolder F;
  ASSERT_TRUE(writeCheckpoint(F.path("c"), sample()));
  const std::string Whole = F.read("c");
  for (std::size_t At = 0; At < Whole.size(); ++At) {
    std::string Changed = Whole;
    Changed[At] = static_cast<char>(~Changed[At]);
    F.write("d", Changed);
    EXPECT_FALSE(readCheckpoint(F.path("d"))) << At;
    if (At % 7 == 0) {
      F.write("d", Whole.substr(0, At));
      EXPECT_FALSE(readCheckpoint(F.path("d"))) << At;
    }
  }
  F.write("d", Whole + "x");
  const auto Longer = readCheckpoint(F.path("d"));
  ASSERT_FALSE(Longer);
  EXPECT_NE(Longer.error().What.find("damaged checkpoint"), std::string::npos);
  for (const char *Other : {"1", "3"}) {
    F.write("d", fmt::format("vorion-checkpoint {} 0\n{{}}\n", Other));
    const auto Read = readCheckpoint(F.path("d"));
    ASSERT_FALSE(Read);
    EXPECT_NE(Read.error().What.find("another version"), std::string::npos);
  }
}

/// Where nothing can be written, the old one stays.
TEST(Checkpoint, AHeaderOfAnotherShapeIsAnError) {
  const TestFolder F;
  ASSERT_TRUE(writeCheckpoint(F.path("c"), sample()));
  const std::string Whole = F.read("c");
  const std::size_t Header = Whole.find('\n') + 1;
  const std::size_t Arrays = Whole.find('\n', Header);
  const auto With = [&](const std::string &Text) {
    const std::string Body = Text + Whole.substr(Arrays);
    F.write("d", fmt::format("vorion-checkpoint 2 {}\n", fnv1a64(Body)) + Body);
    const auto Read = readCheckpoint(F.path("d"));
    return Read ? std::string() : Read.error().What;
  };
  EXPECT_EQ(With(Whole.substr(Header, Arrays - Header)), "");
  EXPECT_EQ(With("[]"), "a document of type array, expected an object");
  EXPECT_EQ(With(R"({"run": 1, "iteration": 4, "sh_degree": 1})"),
            "key run is 1, expected a string");
  EXPECT_EQ(With(R"({"run": "", "iteration": "4", "sh_degree": 1})"),
            "key iteration is of type string, expected a whole number, 0 to "
            "1768");
  EXPECT_EQ(With(R"({"run": "", "iteration": 4, "sh_degree": 9})"),
            "key sh_degree is 9, expected a whole number, 0 to 3");
  EXPECT_EQ(With(R"({"run": "", "iteration": 4, "sh_degree": 1})"),
            "key gaussians is missing, expected a whole number, 0 to 1768");
  EXPECT_EQ(With(std::string(200'000, '[')),
            "lists and objects more than 256 deep in each other, expected "
            "fewer");
}

TEST(Checkpoint, FailedWritesLeaveTheOldOne) {
  const TestFolder F;
  ASSERT_TRUE(writeCheckpoint(F.path("c"), sample()));
  const std::string Before = F.read("c");
  // A full disk, as far as a program can tell: no more bytes are taken.
  rlimit Whole{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &Whole), 0);
  const auto Handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit Small = Whole;
  Small.rlim_cur = 1000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &Small), 0);
  const auto Failed = writeCheckpoint(F.path("c"), sample());
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &Whole), 0);
  std::signal(SIGXFSZ, Handler);
  ASSERT_FALSE(Failed);
  EXPECT_NE(Failed.error().What.find("cannot write"), std::string::npos);
  EXPECT_EQ(Failed.error().Code, ExitCode::InputFile);
  EXPECT_EQ(F.read("c"), Before);
}

} // namespace
