#include "commands/Compare.h"
#include "commands/OutputFile.h"

#include "io/ReportHead.h"
#include "page/TrainingsPage.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// Iterations over which the last losses are averaged.
constexpr std::size_t LastLosses = 100;

/// What is read below; the curves, too (page/TrainingsPage.h).
JsonShape trainingShape() {
  const auto At = [](std::vector<JsonField> More) {
    More.push_back({"iteration", JsonShape::whole()});
    return JsonShape::list(JsonShape::object(std::move(More)));
  };
  return JsonShape::object(
      {{"capture", JsonShape::text()},
       {"iterations", JsonShape::whole()},
       {"psnr8_db", JsonShape::number().orNull()},
       {"gaussians", JsonShape::whole()},
       {"seconds", JsonShape::number()},
       {"settings", JsonShape::object({})},
       {"run", JsonShape::object({})},
       {"losses", JsonShape::list(JsonShape::number())},
       {"gaussian_counts", At({{"gaussians", JsonShape::whole()}})},
       {"scores", At({{"psnr8_db", JsonShape::number()}})},
       {"timed", At({{"time", JsonShape::object(
                                  {{"frame_ms", JsonShape::number()}})}})}});
}

Expected<Json> readTraining(const std::string &File) {
  auto Report = readJson<Json>(File, "a report of `splat train --json`");
  if (!Report)
    return Report;
  if (auto Checked = trainingShape().check(*Report, File); !Checked)
    return Checked.error();
  return Report;
}

std::string textOf(const Json &Value) {
  return Value.is_string() ? printable(Value.get<std::string>())
                           : jsonText(Value);
}

std::string lastLoss(const Json &Report) {
  const auto Losses = Report.at("losses").get<std::vector<double>>();
  const std::size_t Count = std::min(Losses.size(), LastLosses);
  return Count == 0
             ? ""
             : fmt::format("{:.5f}", std::accumulate(
                                         Losses.end() -
                                             static_cast<std::ptrdiff_t>(Count),
                                         Losses.end(), 0.0) /
                                         static_cast<double>(Count));
}

std::string machineTime(const Json &Report) {
  const Json &Timed = Report.at("timed");
  double Sum = 0;
  for (const Json &Each : Timed)
    Sum += Each.at("time").at("frame_ms").get<double>();
  return Timed.empty() ? ""
                       : fmt::format("{:.3f} ms",
                                     Sum / static_cast<double>(Timed.size()));
}

std::vector<TrainingChange> changesOf(const Json &A, const Json &B) {
  std::vector<TrainingChange> All;
  const auto Add = [&](const char *Name, const auto &Text) {
    if (TrainingChange C{Name, Text(A), Text(B)}; !C.A.empty() || !C.B.empty())
      All.push_back(std::move(C));
  };
  const auto Plain = [](const char *Key) {
    return [Key](const Json &Report) { return textOf(Report.at(Key)); };
  };
  Add("capture", Plain("capture"));
  Add("iterations", Plain("iterations"));
  Add("PSNR of held-out views", [](const Json &R) {
    const Json &Db = R.at("psnr8_db");
    return Db.is_number() ? fmt::format("{:.3f} dB", Db.get<double>()) : "";
  });
  Add("loss, mean of the last 100", lastLoss);
  Add("Gaussians", Plain("gaussians"));
  Add("time of an iteration on the machine", machineTime);
  Add("time of the simulation", [](const Json &R) {
    return fmt::format("{:.1f} s", R.at("seconds").get<double>());
  });
  // What determines the result, where it differs.
  for (const char *Part : {"settings", "run"})
    for (const auto &[Key, Value] : A.at(Part).items()) {
      const Json Other = B.at(Part).value(Key, Json());
      // "run" holds hashes of files, too, and some of the settings.
      if (Value != Other && !Value.is_structured() &&
          (Part == std::string_view("settings") ||
           !A.at("settings").contains(Key)))
        All.push_back({Key, textOf(Value), textOf(Other)});
    }
  return All;
}

void print(const CompareArguments &A, const std::vector<TrainingChange> &All) {
  std::size_t Name = 0, First = A.Reference.size();
  for (const TrainingChange &C : All) {
    Name = std::max(Name, C.Name.size());
    First = std::max(First, C.A.size());
  }
  printOut("{:<{}}  {:<{}}  {}\n", "", Name, escaped(A.Reference), First,
           escaped(A.Picture));
  for (const TrainingChange &C : All)
    printOut("{:<{}}  {:<{}}  {}\n", C.Name, Name, C.A, First, C.B);
}

} // namespace

Expected<Success> compareTrainings(const CompareArguments &A) {
  if (auto Checked = checkPage(A.Page); !Checked)
    return Checked;
  if (auto Claimed = claimOutputs({{"--html", A.Page.Html}},
                                  {{"a training report", A.Reference},
                                   {"a training report", A.Picture}});
      !Claimed)
    return Claimed;
  std::vector<Json> Reports;
  for (const std::string &File : {A.Reference, A.Picture}) {
    auto Report = readTraining(File);
    if (!Report)
      return Report.error();
    Reports.push_back(std::move(*Report));
  }
  const auto Changes = changesOf(Reports[0], Reports[1]);
  print(A, Changes);
  if (!A.Page.any())
    return Success{};
  return writePage(A.Page, trainingsPageOf({A.Reference, A.Picture}, Reports,
                                           Changes, {madeBy()}));
}

} // namespace vorion::splat
