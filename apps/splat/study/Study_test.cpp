#include "study/Study.h"

#include "io/TestFiles.h"
#include "study/Process.h"
#include "vorion/support/Tool.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <fstream>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace vorion;
using namespace vorion::splat;

namespace {

using Json = nlohmann::ordered_json;

class StudyTest : public ::testing::Test {
protected:
  StudyTest() { Options.Folder = Folder.path("o"); }

  PointStore open() {
    return {Options.Folder, [](const Json &J) { return J.contains("cycles"); },
            [this](std::string_view Line) { Log.emplace_back(Line); }};
  }

  /// A point that has \p Cycles, or fails without.
  StudyPoint point(const std::string &Name, std::optional<int> Cycles = 1) {
    StudyPoint P;
    P.Name = Name;
    P.From = {{"scene", "A"}};
    P.Prepare = [this, Name] {
      Done.push_back("prepare " + Name);
      return Success{};
    };
    P.Measure = [this, Name, Cycles]() -> Expected<Json> {
      Done.push_back(Name);
      if (Cycles)
        return Json{{"cycles", *Cycles}};
      return Error{Name, "broken"};
    };
    P.Describe = [](const Json &) { return "done"; };
    return P;
  }

  Expected<Success> run(std::function<std::vector<StudyPoint>()> Round) {
    PointStore Kept = open();
    StudySteps Steps;
    Steps.Round = [&Round] { return Round(); };
    Steps.Named = [&Round](const std::vector<std::string> &Names) {
      return pointsNamed(Round(), Names, "point", "one of those");
    };
    Steps.Begin = [this] {
      Done.emplace_back("begin");
      return Success{};
    };
    Steps.End = [this] {
      Done.emplace_back("end");
      return Success{};
    };
    return runStudy(Options, Kept, Steps,
                    [this](std::string_view Line) { Log.emplace_back(Line); });
  }

  using Lines = std::vector<std::string>;
  TestFolder Folder;
  StudyOptions Options;
  Lines Done, Log;
};

TEST_F(StudyTest, EndsWhenARoundLacksNothing) {
  int Rounds = 0;
  ASSERT_TRUE(run([&] {
    // The second round has one more, which the first found out.
    std::vector<StudyPoint> Points{point("a"), point("b")};
    if (++Rounds > 1)
      Points.push_back(point("c"));
    return Points;
  }));
  EXPECT_EQ(Done, (Lines{"begin", "prepare a", "prepare b", "a", "b",
                         "prepare c", "c", "end"}));
  EXPECT_EQ(Log.front().substr(0, 13), "[1/2] a: done");
  EXPECT_EQ(Rounds, 3);
  Done.clear();
  ASSERT_TRUE(run([&] { return std::vector{point("a"), point("c")}; }));
  EXPECT_EQ(Done, (Lines{"begin", "end"}));
}

TEST_F(StudyTest, NamedPointsAreMeasuredAlone) {
  Options.Only = {"b"};
  ASSERT_TRUE(run([&] { return std::vector{point("a"), point("b")}; }));
  EXPECT_EQ(Done, (Lines{"begin", "prepare b", "b"}));
  Options.Only = {"defaults"};
  const auto Unknown =
      run([&] { return std::vector{point("a"), point("default")}; });
  ASSERT_FALSE(Unknown);
  EXPECT_EQ(Unknown.error().Code, ExitCode::Usage);
  EXPECT_EQ(Unknown.error().What,
            "--only defaults: unknown point, expected one "
            "of those; did you mean default?");
}

TEST_F(StudyTest, AFailureEndsItAndWhatWasMeasuredIsKept) {
  const auto Failed = run([&] {
    return std::vector{point("a"), point("b", std::nullopt), point("c")};
  });
  ASSERT_FALSE(Failed);
  EXPECT_EQ(Failed.error().What, "broken");
  EXPECT_EQ(Done.back(), "b");
  PointStore Kept = open();
  EXPECT_TRUE(Kept.get("a", {{"scene", "A"}}));
  const auto Missing = Kept.get("c", {{"scene", "A"}});
  ASSERT_FALSE(Missing);
  EXPECT_EQ(Missing.error().What,
            "point c is missing, expected its measurement");
}

TEST(RunProgram, ASignalEndsWhatItHasStarted) {
  const TestFolder Folder;
  const std::string Started = Folder.path("started");
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
  const pid_t Child = ::fork();
  if (Child == 0) {
    catchEndingSignals();
    const auto Ended = runProgram(
        {"/bin/sh", "-c", // in a subshell, so that the test reaps it
         fmt::format(
             "(sleep 5 & echo $! > {0}.new) && mv {0}.new {0}; exec sleep 5",
             Started)},
        {}, "/dev/null", "/dev/null");
    ::_exit(Ended ? 0 : 1);
  }
  pid_t Grandchild = 0;
  while (!(std::ifstream(Started) >> Grandchild))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(Child, SIGTERM);
  int Status = 0;
  ::waitpid(Child, &Status, 0);
  EXPECT_TRUE(WIFSIGNALED(Status));
  ASSERT_EQ(::waitpid(Grandchild, &Status, 0), Grandchild);
  EXPECT_TRUE(WIFSIGNALED(Status));
}

} // namespace
