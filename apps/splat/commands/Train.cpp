#include "commands/CaptureInfo.h"
#include "commands/Choices.h"
#include "commands/Commands.h"
#include "commands/DeviceArguments.h"
#include "commands/EnergyArguments.h"
#include "commands/InputFiles.h"
#include "commands/OutputFile.h"
#include "commands/PictureOptions.h"
#include "commands/Progress.h"
#include "commands/TrainPictures.h"
#include "commands/TrainedOptions.h"

#include "capture/Undistort.h"
#include "io/ReportHead.h"
#include "scene/LocalFrame.h"
#include "scene/formats/Ply.h"
#include "train/run/TrainReport.h"
#include "train/run/Training.h"
#include "view/TrainServer.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"
#include "vorion/support/StatusLine.h"
#include "vorion/support/Terminal.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace vorion::splat {

namespace {

struct TrainArguments {
  TrainedArguments Trained;
  std::string Output, Json, Device;
  TrainPictures Pictures;
  bool Time = false, View = false;
  std::optional<int> Port;
  EnergyArguments Energy;
  std::optional<unsigned> GivenTimeEvery;

  bool isClocked() const { return Time || Energy.isWanted(); }
  unsigned timeEvery() const { return GivenTimeEvery.value_or(50); }
};

/// One line that says how far the run is; on a terminal it is overwritten.
void showProgress(const TrainProgress &P) {
  if (isProgressHidden())
    return;
  const bool Terminal = canOverwrite();
  constexpr unsigned Every = 50;
  const StepReport &R = P.Step;
  if (!Terminal && R.Iteration % Every != 0 && R.Iteration != 1)
    return;
  const std::string Line = fmt::format(
      "iteration {}/{}: loss {:.5f}{}, {}, {:.2f} it/s of wall time{}",
      R.Iteration, P.Last, R.Loss.Value,
      timeLeftText(P.Seconds - P.FirstSeconds, R.Iteration - P.First - 1,
                   P.Last - P.First - 1),
      counted(R.Gaussians, "Gaussian"), (R.Iteration - P.First) / P.Seconds,
      P.MachineRate
          ? fmt::format(", {:.3f} it/s of modelled time", *P.MachineRate)
          : "");
  if (Terminal)
    showStatus(Line);
  else
    printNote(Line + "\n");
}

Expected<Success> writeOutputs(const TrainArguments &A, const TrainOutcome &Out,
                               const std::optional<EnergyRequest> &Energy) {
  const auto Report = trainReport(A.Trained.Request, Out, Energy);
  if (!Report)
    return Report.error();
  if (auto Written = writePly(A.Output, Out.Result,
                              {A.Trained.Request.Run.Antialiased, std::nullopt,
                               "--antialiased", A.Trained.Request.Run.Kind,
                               A.Trained.Request.Run.FalloffDegree});
      !Written)
    return Written;
  if (auto Written = writeTrainPictures(A.Pictures, A.Output, Out, *Report);
      !Written)
    return Written;
  if (A.Json.empty())
    return Success{};
  return writeFileAtomically(A.Json, jsonText(*Report, 2) + "\n");
}

void printOutcome(const TrainArguments &A, const TrainOutcome &Out) {
  const TrainRequest &R = A.Trained.Request;
  printOut("{}: {} after {}\n", escaped(A.Output),
           counted(Out.Result.size(), "Gaussian"),
           counted(Out.Iterations, "iteration"));
  printOut("pictures     {} to train on, {} held out ({}); {}\n",
           Out.TrainingViews, Out.HeldOut.size(), Out.HeldOutBy, PhotoFilter);
  printOut("{}", readerLines(Out.Notes, Out.WithoutPicture));
  if (Out.Distorted != 0 && R.Run.Pictures == LensOf::Undistorted)
    printOut("undistorted  {}; {}\n", counted(Out.Distorted, "picture"),
             LensFilter);
  else if (Out.Distorted != 0)
    printOut("distorted    {}, used as {}\n", counted(Out.Distorted, "picture"),
             Out.Distorted == 1 ? "it is" : "they are");
  if (R.Run.Through == Spread::Unscented)
    printOut("projection   unscented: eval and render need --projection "
             "unscented, too\n");
  if (R.Run.Kind != RendererKind::Splat)
    printOut("renderer     {}{}, which the scene's file says\n",
             name(R.Run.Kind),
             R.Run.FalloffDegree == 2 ? "" : ", falloff of degree 4");
  if (Out.Near)
    printOut("near plane   at depth {:g}: render from other distances needs "
             "--near {:g}, too\n",
             *Out.Near, *Out.Near);
  if (const auto &[X, Y, Z] = Out.Result.Origin;
      Out.Result.Origin != WorldPoint{})
    printOut("frame        trained around ({:.9g}, {:.9g}, {:.9g}), because "
             "fp32 has too few digits here; written in the capture's frame, "
             "positions as {}\n",
             X, Y, Z, needsDoubles(Out.Result) ? "doubles" : "floats");
  if (R.Run.Masks != MaskSource::None)
    printOut("masks        {}\n", R.Run.Masks == MaskSource::Alpha
                                      ? "transparent pixels are masked out"
                                      : "of " + counted(Out.Masked, "picture"));
  if (Out.Depths != 0)
    printOut("depths       of {} of points in the pictures\n",
             counted(Out.Depths, "place"));
  if (const auto &P = Out.Poses)
    printOut(
        "poses        rotated by {:.4f} rad and translated by {:.4g}, mean of "
        "pictures; maximum {:.4f} rad and {:.4g}\n",
        P->MeanTurn, P->MeanShift, P->MostTurn, P->MostShift);
  if (R.Run.Batch != 1 || Out.Processes != 1)
    printOut("views        {} an iteration, on {}\n", R.Run.Batch,
             counted(Out.Processes, "device"));
  if (R.Run.Settings.Method != DensityMethod::Classic)
    printOut("density      {}\n", name(R.Run.Settings.Method));
  printOut("rules        {}, support exact, path {}{}, opacity rate {}\n",
           name(R.Convention), name(R.Blending.Kind),
           toString(R.Backward, R.Blending.Kind), R.Run.Settings.OpacityRate);
  if (Out.Iterations > Out.First)
    printOut("wall time    {:.1f} s, {:.3f} it/s\n", Out.Seconds,
             (Out.Iterations - Out.First) / Out.Seconds);
  if (!Out.Timed.empty())
    printOut("machine time {}\nmachine      {}\n", Out.Timed.text(),
             escaped(Out.Timed.machine()));
  else if (A.isClocked())
    printOut("machine time unknown: none of the iterations {} to {} was timed, "
             "expected --time-every below {}\n",
             Out.First + 1, Out.Iterations, A.timeEvery());
  if (const auto &B = Out.Without)
    printOut("held out     {:.3f} dB (PSNR of 8-bit values, mean of views)\n"
             "baselines    constant {:.3f} dB, mean picture {:.3f} dB, best "
             "training view {:.3f} dB\n",
             Out.meanDb(), B->Constant, B->Mean, B->BestView);
  else
    printOut("held out     no held-out views\n");
  printOut("cameras      {}\n", escaped(camerasFor(A.Output)));
  if (!Out.Timed.empty())
    printOut("{}", Out.Timed.lastByStage());
}

/// Of the last iteration that was timed.
Expected<Success> printEnergy(const ClockSamples &Timed,
                              const std::optional<EnergyRequest> &Energy) {
  if (!Energy || Timed.empty())
    return Success{};
  const auto Text = frameEnergyText(Timed.last().Stages, *Energy, "iteration");
  if (!Text)
    return Text.error();
  printOut("{}", *Text);
  return Success{};
}

Expected<Success> check(const TrainArguments &A) {
  const TrainRequest &R = A.Trained.Request;
  for (const auto &Checked :
       {checkEnding("-o", A.Output, {".ply"}), checkJsonName(A.Json),
        checkTrainPictures(A.Pictures)})
    if (!Checked)
      return Checked;
  if (auto Checked = checkTrained(R); !Checked)
    return Checked;
  if (R.Read.HoldOut == 0U && A.Pictures.any())
    return Error{
        "",
        "--html, --figures and --pictures show held-out views, expected "
        "--hold-out above 0",
        ExitCode::Usage};
  if (R.Read.HoldOut == 0U && R.ScoreEvery != 0)
    return Error{
        "",
        "--score-every evaluates held-out views, expected --hold-out above 0",
        ExitCode::Usage};
  if (A.GivenTimeEvery && !A.isClocked())
    return Error{"", "--time-every: expected --time or --energy",
                 ExitCode::Usage};
  if (R.ScoreEvery != 0 && A.Json.empty() && !A.Pictures.Page.any() && !A.View)
    return Error{"", "--score-every: expected --json, --html or --view",
                 ExitCode::Usage};
  if (A.Port && !A.View)
    return Error{"", "--port: expected --view", ExitCode::Usage};
  const InputFiles Inputs = InputFiles()
                                .watched()
                                .capture(R.Capture)
                                .file("--from", R.From)
                                .file("--technology", A.Energy.Technology);
  return claimOutputs({{"-o", A.Output},
                       {"--json", A.Json},
                       {"the cameras", camerasFor(A.Output)},
                       {"--html", A.Pictures.Page.Html},
                       {"--checkpoint", R.Checkpoint}},
                      Inputs.named());
}

Expected<Device> openClocked(const TrainArguments &A, DeviceOptions Machine,
                             const std::optional<EnergyRequest> &Energy) {
  if (A.isClocked())
    Machine.set("VORION_TIME", "profiled", "--time");
  auto D = openDevice(A.Device, A.Trained.Request.Blending.Kind, Machine);
  if (D && A.isClocked() && !D->isVorion())
    return Error{
        "",
        fmt::format("{} has no clock for --time, expected a Vorion device",
                    D->name()),
        ExitCode::Usage};
  if (D)
    checkEnergyOf(*D, Energy);
  return D;
}

/// Serves the page of the run.
Expected<std::unique_ptr<TrainServer>> serve(const TrainArguments &A,
                                             const TrainingSet &Pictures) {
  auto Page = TrainServer::start(
      A.Port.value_or(0),
      printable(std::filesystem::path(A.Output).filename().string()), Pictures);
  if (Page) {
    clearStatus();
    printOut("splat train: {}\n", (*Page)->address());
    // Who waits for the address may read it from a pipe.
    std::fflush(stdout);
  }
  return Page;
}

Expected<Success> run(TrainArguments &A, const DeviceOptions &Machine) {
  const auto Energy = requestedEnergy(A.Energy, std::nullopt);
  if (!Energy)
    return Energy.error();
  if (A.isClocked())
    A.Trained.Request.TimeEvery = A.timeEvery();
  std::unique_ptr<TrainServer> Page;
  const auto Begin = [&](const TrainingSet &Pictures) -> Expected<Success> {
    auto Started = serve(A, Pictures);
    if (!Started)
      return Started.error();
    Page = std::move(*Started);
    return Success{};
  };
  const auto Between = [&](const TrainMoment &Now) {
    return Page->between(Now);
  };
  using Host = TrainHost;
  const auto Out = train(
      A.Trained.Request,
      {.Check = [&A] { return check(A); },
       .OpenDevice = [&] { return openClocked(A, Machine, *Energy); },
       .ShowBuildLog = showBuildLog,
       .Progress = showProgress,
       .EndProgress = keepStatus,
       .Note =
           [](std::string_view Line) { printNote(std::string(Line) + "\n"); },
       .Begin = A.View ? Begin : decltype(Host::Begin)(),
       .Between = A.View ? Between : decltype(Host::Between)()});
  if (!Out)
    return Out.error();
  if (!*Out)
    return Success{};
  if (auto Written = writeOutputs(A, **Out, *Energy); !Written)
    return Written;
  if (Page)
    Page->end(**Out);
  printOutcome(A, **Out);
  return printEnergy((*Out)->Timed, *Energy);
}

} // namespace

Runner addTrain(CLI::App &App) {
  auto A = std::make_shared<TrainArguments>();
  TrainRequest &R = A->Trained.Request;
  writesFile(App.add_option("-o,--output", A->Output,
                            "Scene to write, INRIA's PLY (default: the "
                            "capture's name with .ply, in the current folder)"),
             {".ply"});
  addTrainedOptions(App, A->Trained);
  addTrainPathOptions(App, R);
  writesFile(App.add_option(
      "--checkpoint", R.Checkpoint,
      "Checkpoint file (default: the output's name with .checkpoint)"));
  HelpGroup Group(App, "Output");
  App.add_option("--checkpoint-every", R.CheckpointEvery,
                 "Iterations between checkpoints (default 1000)")
      ->check(isIterations());
  App.add_flag("--resume", R.Resume,
               "Continue from the checkpoint if it exists");
  Group.next("Time and energy");
  App.add_flag("--time", A->Time,
               "Report the modelled time of iterations, and of the last timed "
               "one by stage (docs/model.md)");
  App.add_option("--time-every", A->GivenTimeEvery,
                 "Time one of N iterations, sampled at random from the seed "
                 "(default 50)")
      ->check(isIterations());
  addEnergyOptions(App, A->Energy,
                   "the last timed iteration (in --json: of each)");
  Group.next("Output");
  App.add_option("--score-every", R.ScoreEvery,
                 "Evaluate the held-out views every N iterations, for --json, "
                 "--html and --view (default: with --html or --view a "
                 "twentieth of the run, else only at the end)")
      ->check(isIterations());
  writesFile(App.add_option("--json", A->Json,
                            "Write a report with options, losses and times"),
             {".json"});
  addTrainPictures(App, A->Pictures);
  App.add_flag("--view", A->View,
               "Serve a page of the run: picture, curves, pause and stop");
  App.add_option("--port", A->Port,
                 "TCP port of --view on 127.0.0.1 (default 0: any free port)")
      ->check(isBetween(0, 65535));
  addDeviceOption(App, A->Device);
  return [A, &App](const DeviceOptions &Machine) -> Expected<Success> {
    if (auto Completed = completeTrained(App, A->Trained); !Completed)
      return Completed;
    nameOutput("-o", A->Output, A->Trained.Request.Capture, ".ply");
    if (A->Trained.Request.Checkpoint.empty())
      A->Trained.Request.Checkpoint = A->Output + ".checkpoint";
    TrainRequest &R = A->Trained.Request;
    R.KeepPictures = A->Pictures.any();
    if (R.ScoreEvery == 0 && R.Read.HoldOut != 0U &&
        (A->View || A->Pictures.Page.any()))
      R.ScoreEvery = std::max(1U, R.Run.Settings.Iterations / 20);
    return run(*A, Machine);
  };
}

} // namespace vorion::splat
