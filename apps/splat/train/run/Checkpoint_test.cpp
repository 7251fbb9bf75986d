#include "train/run/Checkpoint.h"

#include "io/Hash.h"
#include "io/TestFiles.h"
#include "picture/Layout.h"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fmt/format.h>
#include <limits>
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
  Fill(C.Exposures, 36);
  Fill(C.Poses, 18);
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
  EXPECT_EQ(B->Exposures, A.Exposures);
  EXPECT_EQ(B->Poses, A.Poses);
  // Most runs have none, and say nothing of them.
  Checkpoint Without = A;
  Without.Exposures.clear();
  Without.Poses.clear();
  ASSERT_TRUE(writeCheckpoint(F.path("d"), Without));
  EXPECT_TRUE(readCheckpoint(F.path("d"))->Exposures.empty());
  EXPECT_TRUE(readCheckpoint(F.path("d"))->Poses.empty());
  EXPECT_EQ(F.read("d").find("exposures"), std::string::npos);
  EXPECT_EQ(F.read("d").find("poses"), std::string::npos);
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
    EXPECT_NE(Read.error().What.find("unsupported checkpoint version"),
              std::string::npos);
  }
}

/// A whole file around \p Body, as a checkpoint's first line has it.
std::string signedFile(const std::string &Body) {
  return fmt::format("vorion-checkpoint 2 {}\n", fnv1a64(Body)) + Body;
}

/// What a header asks for is held against the file before it is allocated.
TEST(Checkpoint, AHeaderMakesNoMemory) {
  const TestFolder F;
  constexpr std::size_t Size = 4'000'000;
  const std::string Header = fmt::format(
      R"({{"run": "", "iteration": {0}, "sh_degree": 3, "gaussians": {0}}})"
      "\n",
      Size);
  F.write("d", signedFile(Header + std::string(Size, '\0')));
  const auto PeakKib = [] {
    rusage Usage{};
    getrusage(RUSAGE_SELF, &Usage);
    return Usage.ru_maxrss;
  };
  const long Before = PeakKib();
  const auto Read = readCheckpoint(F.path("d"));
  EXPECT_LT(PeakKib() - Before, 64 * 1024);
  ASSERT_FALSE(Read);
  EXPECT_NE(Read.error().What.find("damaged checkpoint"), std::string::npos);
}

TEST(Checkpoint, ValuesThatAreNoNumbersAreSaid) {
  const TestFolder F;
  ASSERT_TRUE(writeCheckpoint(F.path("c"), sample()));
  const std::string Whole = F.read("c");
  const std::size_t Begin = Whole.find('\n') + 1;
  const std::string Body = Whole.substr(Begin);
  const std::size_t Arrays = Body.find('\n') + 1;
  for (const float Bad : {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity()}) {
    std::string Changed = Body;
    std::memcpy(Changed.data() + Arrays + 4 * 5, &Bad, 4);
    F.write("d", signedFile(Changed));
    const auto Read = readCheckpoint(F.path("d"));
    ASSERT_FALSE(Read);
    EXPECT_EQ(Read.error().What,
              fmt::format("geometry after iteration 4: value 5 is {}, expected "
                          "finite numbers",
                          Bad));
    EXPECT_EQ(Read.error().Code, ExitCode::InputFile);
  }
  // A run that has come to that keeps its last good state.
  Checkpoint C = sample();
  C.SecondSh[7] = std::numeric_limits<float>::quiet_NaN();
  const auto Written = writeCheckpoint(F.path("c"), C);
  ASSERT_FALSE(Written);
  EXPECT_EQ(Written.error().What,
            "not written: colours' second moments after iteration 4: value 7 "
            "is nan, expected finite numbers");
  EXPECT_EQ(Written.error().Code, ExitCode::GuestFailed);
  EXPECT_EQ(F.read("c"), Whole);
}

/// The checksum guards against accidents: whoever writes one that is right must
/// not end the program, whatever the fields are.
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
            "4294967295");
  EXPECT_EQ(With(R"({"run": "", "iteration": 4, "sh_degree": 9})"),
            "key sh_degree is 9, expected a whole number, 0 to 3");
  EXPECT_EQ(With(R"({"run": "", "iteration": 4, "sh_degree": 1})"),
            "key gaussians is missing, expected a whole number, 0 to "
            "4294967295");
  EXPECT_EQ(With(std::string(200'000, '[')),
            "200000 bytes of JSON, expected at most 65536");
}

/// Where nothing can be written, the old one stays.
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
