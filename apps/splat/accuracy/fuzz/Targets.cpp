#include "accuracy/fuzz/Targets.h"

#include "accuracy/Page.h"
#include "accuracy/Reference.h"
#include "accuracy/Sweep.h"
#include "accuracy/TrainSweep.h"

#include "io/Hash.h"
#include "train/run/Checkpoint.h"
#include "train/run/RunRecord.h"
#include "vorion/support/File.h"
#include "vorion/support/Printable.h"
#include "vorion/support/TemporaryFolder.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace vorion::splat::fuzz {
namespace {

using Json = nlohmann::ordered_json;

/// Aborts unless \p Holds: what libFuzzer and the replaying test notice.
void require(bool Holds) {
  if (!Holds)
    std::abort();
}

/// With nothing that a terminal would act on.
void requireOneLine(std::string_view Text) {
  require(!Text.empty());
  require(escaped(Text) == Text);
}

/// A folder for as long as the program runs; its files change with each input.
class Folder {
public:
  Folder() : Made(TemporaryFolder::make("vorion-fuzz")) {
    require(Made && makeFolders(path()));
  }
  const std::string &path() const { return Made->path(); }

  /// Writes the parts of \p Input, which bytes 0xFF divide, to \p Files, below
  /// this; the last gets all that is left. A part that is empty or missing is
  /// no file.
  void fill(Bytes Input, const std::vector<std::string> &Files) const {
    std::string_view Rest = asText(Input);
    for (const std::string &File : Files) {
      const std::string_view Part = Rest.substr(
          0, &File == &Files.back() ? Rest.npos : Rest.find(Divider));
      Rest.remove_prefix(std::min(Part.size() + 1, Rest.size()));
      const std::string Path = this->path() + "/" + File;
      if (Part.empty())
        std::filesystem::remove(Path);
      else
        std::ofstream(Path, std::ios::binary)
            .write(Part.data(), std::streamsize(Part.size()));
    }
  }

  /// What fill() takes for these files.
  std::string bundled(const std::vector<std::string> &Files) const {
    std::string All;
    for (const std::string &File : Files) {
      const auto Content = readFile(path() + "/" + File);
      require(static_cast<bool>(Content));
      All += All.empty() ? "" : std::string(1, Divider);
      All += asText(*Content);
    }
    return All;
  }

private:
  static constexpr char Divider = '\xFF';
  Expected<TemporaryFolder> Made;
};

/// One Gaussian, two settings, one view.
SweepPlan smallSweep(const std::string &Folder) {
  SweepPlan P;
  P.Folder = Folder;
  P.Views = {Camera::ahead(2, 2, 2)};
  P.Views.front().Name = "front";
  P.Knobs = {{KnobId::Tile, "tile", {"64", "32"}, ""}};
  P.From = {{"programs", "1"}, {"scene", "2"}};
  P.Load = []() -> Expected<SceneFile> {
    SceneFile File;
    Scene &S = File.Gaussians;
    S.Means = {0, 0, 2};
    S.LogScales = {-1, -1, -1};
    S.Quats = {1, 0, 0, 0};
    S.OpacityLogits = {1};
    S.Sh = {1, 1, 1};
    return File;
  };
  return P;
}

std::vector<std::string> filesOf(const SweepPlan &P) {
  std::vector<std::string> Files;
  for (const Point &Of : pointsOf(P, singleChanges(P.Knobs)))
    Files.push_back(fmt::format("points/{}.json", Of.name()));
  Files.emplace_back("references/front-exact.npz.origin");
  // The last, since any byte may be in it.
  Files.emplace_back("references/front-exact.npz");
  return Files;
}

Json measured(const Point &Of) {
  const Json Errors{{"ssim", 1.0},
                    {"largest", 0.001},
                    {"off_share", 0.25},
                    {"psnr_db", nullptr}};
  return {{"setting", Of.Chosen.name()},
          {"view", Of.View->Name},
          {"clocked_machine", "prototype, 530 MHz, clock version 1"},
          {"errors", Errors},
          {"cores_errors", Errors},
          {"times",
           {{"cycles", 1000.0},
            {"equal_area_cycles", 900.5},
            {"cores_cycles", nullptr},
            {"chip_joules", nullptr}}},
          {"lane_area_relative", 1.0},
          {"made_by", Json::object()},
          {"picture", "data:,"},
          {"difference", "data:,"}};
}

TrainSweepPlan smallTrainSweep(const std::string &Folder) {
  TrainSweepPlan P;
  P.Folder = Folder;
  P.Seeds = 1;
  P.From = {{"programs", "1"}, {"capture", "2"}};
  return P;
}

std::vector<std::string> filesOf(const TrainSweepPlan &P) {
  std::vector<std::string> Files;
  for (const TrainPoint &Of : trainPoints(P))
    Files.push_back(fmt::format("points/{}.json", Of.name()));
  return Files;
}

Json measured(const TrainPoint &Of) {
  if (!Of.Seed)
    return {{"setting", Of.Chosen.name()},
            {"errors",
             {{"means", 1e-6},
              {"quats", 1e-6},
              {"scales", 1e-6},
              {"opacities", 1e-6},
              {"colors", 1e-6},
              {"largest", 1e-6}}}};
  const auto At = [](unsigned Iteration) {
    return Json{{"iteration", Iteration},
                {"machine_seconds", 0.5 * Iteration},
                {"psnr8_db", 10.0 + Iteration}};
  };
  return {{"setting", Of.Chosen.name()},
          {"seed", Of.at()},
          {"clocked_machine", "prototype, 530 MHz, clock version 1"},
          {"psnr8_db", 12.0},
          {"cycles", 1e6},
          {"chip_joules", nullptr},
          {"reciprocal_um2", {1, 2, 3, 4, 5, 6, 7}},
          {"curve", {At(1), At(2)}}};
}

void tryCheckpoint(std::string_view Text, std::size_t &Whole) {
  const auto Read = parseCheckpoint("input", std::as_bytes(std::span(Text)));
  if (!Read)
    return requireOneLine(Read.error().What);
  ++Whole;
  require(Read->Losses.size() == Read->Iteration);
  require(Read->Sh.size() % 3 == 0);
  require(Read->Identities.size() == Read->gaussians());
  if (const auto Same = checkSameRun("input", Read->Run, Json{{"seed", 3}});
      !Same)
    requireOneLine(Same.error().What);
}

} // namespace

std::size_t readCheckpoint(Bytes Input) {
  std::size_t Whole = 0;
  const std::string_view Text = asText(Input);
  tryCheckpoint(Text, Whole);
  const std::string_view Body =
      Text.substr(std::min(Text.find('\n'), Text.size() - 1) + 1);
  tryCheckpoint(fmt::format("vorion-checkpoint 2 {}\n{}", fnv1a64(Body), Body),
                Whole);
  return Whole;
}

std::size_t readSweep(Bytes Input) {
  static const Folder At;
  const SweepPlan P = smallSweep(At.path());
  At.fill(Input, filesOf(P));
  const std::vector<Setting> Settings = singleChanges(P.Knobs);
  const std::vector<Point> Points = pointsOf(P, Settings);
  PointStore Kept = storeOf(P, requireOneLine);
  const auto Study = studyPoints(P, Points, requireOneLine);
  const std::size_t Missing = missing(Kept, Study).size();
  const auto Measured = candidates(P, Kept, Settings, {&P.Views.front()});
  const auto Page = pageOf(P, Kept, {"", {}, "", 50, {}}, Settings);
  require(static_cast<bool>(Measured) == (Missing == 0));
  require(static_cast<bool>(Page) == (Missing == 0));
  if (Measured)
    for (std::size_t A = 0; A < TimeAxes; ++A)
      recommend(*Measured, static_cast<TimeAxis>(A), 50);
  for (const StudyPoint &One : Study)
    require(static_cast<bool>(One.Prepare()));
  require(static_cast<bool>(referenceOf(P, Points.front())));
  return Points.size() - Missing;
}

std::size_t readTrainSweep(Bytes Input) {
  static const Folder At;
  const TrainSweepPlan P = smallTrainSweep(At.path());
  At.fill(Input, filesOf(P));
  PointStore Kept = storeOf(P, requireOneLine);
  const auto All = studyPoints(P, trainPoints(P), requireOneLine);
  const std::size_t Missing = missing(Kept, All).size();
  const auto Results = trainResults(P, Kept);
  require(static_cast<bool>(Results) == (Missing == 0));
  if (Results) {
    require(!trainTable(*Results).empty());
    require(!trainPageOf(*Results, {}).empty());
  }
  return All.size() - Missing;
}

Seeds checkpointSeeds() {
  const Folder At;
  Seeds All;
  for (const int ShDegree : {0, 3}) {
    Checkpoint C;
    C.Run = R"({"seed":3,"background":[0.0,0.0,0.0]})";
    C.Iteration = 2;
    C.ShDegree = ShDegree;
    const std::size_t Sh = 3 * shCoefficients(ShDegree);
    for (auto *A : {&C.Geometry, &C.FirstGeometry, &C.SecondGeometry})
      A->assign(GEOMETRY_PLANES, 0.5F);
    for (auto *A : {&C.Sh, &C.FirstSh, &C.SecondSh})
      A->assign(Sh, 0.25F);
    C.Identities = {1};
    C.Notes = {{0.5F}, {3}, {2}};
    C.Losses = {0.5F, 0.25F};
    const std::string File = At.path() + "/checkpoint";
    require(static_cast<bool>(writeCheckpoint(File, C)));
    const auto Content = readFile(File);
    require(static_cast<bool>(Content));
    All.emplace_back(fmt::format("degree{}", ShDegree), asText(*Content));
  }
  return All;
}

Seeds sweepSeeds() {
  const Folder At;
  const SweepPlan P = smallSweep(At.path());
  const std::vector<Point> Points = pointsOf(P, singleChanges(P.Knobs));
  PointStore Kept = storeOf(P, requireOneLine);
  for (const StudyPoint &One : studyPoints(P, Points, requireOneLine))
    require(static_cast<bool>(One.Prepare()));
  for (const Point &Of : Points)
    require(static_cast<bool>(
        Kept.keep(Of.name(), provenanceOf(P, Of), measured(Of))));
  std::vector<std::string> Files = filesOf(P);
  Seeds All{{"whole", At.bundled(Files)}};
  // Each file under another's name.
  std::ranges::rotate(Files, Files.begin() + 1);
  All.emplace_back("foreign", At.bundled(Files));
  return All;
}

Seeds trainSweepSeeds() {
  const Folder At;
  const TrainSweepPlan P = smallTrainSweep(At.path());
  PointStore Kept = storeOf(P, requireOneLine);
  for (const TrainPoint &Of : trainPoints(P))
    require(static_cast<bool>(Kept.keep(Of.name(), P.From, measured(Of))));
  std::vector<std::string> Files = filesOf(P);
  Seeds All{{"whole", At.bundled(Files)}};
  std::ranges::rotate(Files, Files.begin() + 1);
  All.emplace_back("foreign", At.bundled(Files));
  return All;
}

} // namespace vorion::splat::fuzz
