#include "commands/AccuracyTrain.h"

#include "commands/CaptureInfo.h"
#include "commands/Choices.h"
#include "commands/PictureOptions.h"
#include "commands/StudyArguments.h"

#include "accuracy/Page.h"
#include "capture/Capture.h"
#include "io/ReportHead.h"
#include "study/Study.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Printable.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {

void addTrainOptions(CLI::App &App, TrainSweepPlan &P,
                     const std::vector<CLI::Option *> &OfScenes) {
  CLI::Option *Train =
      App.add_option("--train", P.Capture,
                     "Measure training on this capture instead of rendering a "
                     "scene: gradients, time and PSNR with each reciprocal "
                     "unit and summation order (docs/accuracy.md)");
  Train->option_text("CAPTURE");
  for (CLI::Option *O : OfScenes)
    Train->excludes(O);
  const std::size_t First = App.get_options().size();
  App.add_option(
         "--iterations", P.Iterations,
         fmt::format("--train: iterations per run (default {})", P.Iterations))
      ->check(isIterations());
  App.add_option("--seeds", P.Seeds,
                 fmt::format("--train: runs per setting (default {})", P.Seeds))
      ->check(isBetween(1U, 1000U));
  App.add_option("--score-every", P.ScoreEvery,
                 fmt::format("--train: iterations between evaluations of the "
                             "held-out views (default {})",
                             P.ScoreEvery))
      ->check(isIterations());
  App.add_option("--time-every", P.TimeEvery,
                 fmt::format("--train: time one of N iterations (default {})",
                             P.TimeEvery))
      ->check(isIterations());
  App.add_option("--downscale", P.Downscale,
                 "--train: downsampling factor of the photographs (default 1)")
      ->check(isBetween(1, 64));
  App.add_option("--max-gaussians", P.MostGaussians,
                 "--train: maximum number of Gaussians");
  App.add_option("--exclude", P.Exclude,
                 "--train: exclude this picture; may be repeated")
      ->allow_extra_args(false);
  addOutsideOption(App, P.AllowOutside);
  addBackgroundOption(App, P.Background,
                      "--train: background colour (default 0,0,0)");
  for (CLI::Option *O : optionsFrom(App, First))
    O->needs(Train);
}

/// That every run will have times and scores; gives what it is made from.
static Expected<Provenance> check(const TrainSweepPlan &P) {
  for (const auto &[Option, Every] : {std::pair("--score-every", P.ScoreEvery),
                                      std::pair("--time-every", P.TimeEvery)})
    if (Every > P.Iterations)
      return Error{"",
                   fmt::format("{} {}: expected at most --iterations, {}",
                               Option, Every, P.Iterations),
                   ExitCode::Usage};
  const auto C = readCapture(P.Capture, {P.Exclude, P.AllowOutside});
  if (!C)
    return C.error();
  if (C->heldOut() == 0)
    return Error{P.Capture, "no held-out views, expected some for the PSNR"};
  return provenanceOf(P, *C);
}

static Expected<Success> finish(const TrainSweepPlan &P, PointStore &Kept) {
  const auto Results = trainResults(P, Kept);
  if (!Results)
    return Results.error();
  nlohmann::ordered_json Report = reportHead("splat-accuracy-train");
  Report.update(*Results);
  const std::string Made = fmt::format(
      "{}, {} iterations, seeds 0 to {}, pictures {}", P.Capture, P.Iterations,
      P.Seeds - 1,
      P.Downscale == 1 ? "as they are"
                       : fmt::format("{} times smaller", P.Downscale));
  if (auto Written =
          writeStudy(P.Folder, "training.json", Report,
                     trainPageOf(*Results, {Made, madeBy(), hashLine(P.From)}));
      !Written)
    return Written;
  printOut("{}{}/index.html\n", trainTable(*Results), P.Folder);
  return Success{};
}

Expected<Success> measureTraining(TrainSweepPlan P, const StudyOptions &O) {
  auto From = check(P);
  if (!From)
    return From.error();
  P.From = std::move(*From);
  PointStore Kept = storeOf(P, logStudy);
  std::vector<StudyPoint> All = studyPoints(P, trainPoints(P), logStudy);
  StudySteps Steps;
  Steps.Round = [&All] { return All; };
  Steps.Named = [&All](const std::vector<std::string> &Names) {
    return pointsNamed(All, Names, "point", "one of those printed by --list");
  };
  Steps.End = [&] { return finish(P, Kept); };
  return runStudy(O, Kept, Steps, logStudy);
}

} // namespace vorion::splat
