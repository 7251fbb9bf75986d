#include "commands/TrainedOptions.h"

#include "commands/CaptureInfo.h"
#include "commands/Choices.h"
#include "commands/PictureOptions.h"
#include "commands/Usage.h"
#include "vorion/support/CommandLine.h"

#include <fmt/format.h>

namespace vorion::splat {

void addTrainedOptions(CLI::App &App, TrainedArguments &A) {
  TrainRequest &R = A.Request;
  TrainSettings &S = R.Run.Settings;
  takesFile(App.add_option("capture", R.Capture,
                           "Photographs with poses: COLMAP, NeRF-synthetic, "
                           "transforms.json"))
      ->required();
  HelpGroup Group(App, "Training");
  App.add_option(
         "--iterations", S.Iterations,
         fmt::format("Total number of iterations (default {})", S.Iterations))
      ->check(isIterations());
  Group.next("Photographs");
  App.add_option("--downscale", R.Downscale,
                 "Downsampling factor of the photographs (default 1)")
      ->check(isBetween(1, 64));
  Group.next("Training");
  App.add_option("--max-gaussians", S.MostGaussians,
                 fmt::format("Maximum number of Gaussians (default {})",
                             S.MostGaussians))
      ->check(isBetween(4U, 100000000U));
  addChoice(App, "--moments", R.Moments,
            {MomentsChoice::Auto, MomentsChoice::Device, MomentsChoice::Host},
            "Memory of Adam's moments; results are bit-identical. auto: on the "
            "host if the device's memory is too small for --max-gaussians");
  Group.next("Photographs");
  App.add_option("--exclude", R.Read.Exclude,
                 "Exclude this picture; may be repeated")
      ->allow_extra_args(false);
  addHoldOutOption(App, R.Read.HoldOut);
  addPlaceOptions(App, R.Read);
  Group.next("Training");
  App.add_option("--batch", R.Run.Batch,
                 "Views per iteration, distributed over the processes that "
                 "mpirun started, each with its own device (default 1)")
      ->check(isBetween(1U, 4096U));
  App.add_option("--seed", R.Run.Seed, "Seed of all random numbers (default 0)")
      ->check(isBetween<uint64_t>(0, MostSeed));
  App.add_option("--sh-degree", R.ShDegree,
                 "Degree of spherical harmonics (default 3)")
      ->check(isBetween(0, MaxShDegree));
  addBackgroundOption(
      App, R.Run.Background,
      "Background colour, also under transparent pixels (default 0,0,0)");
  App.add_flag("--random-background", R.Run.RandomBackground,
               "Use a random background for each view of an iteration; "
               "--background then applies to held-out views only");
  addMasksOption(App, R.Run.Masks);
  Group.next("Photographs");
  App.add_flag(
      "--distorted",
      [&R](std::int64_t) { R.Run.Pictures = LensOf::Photograph; },
      "Train with the lens distortion of the photographs instead of "
      "undistorting them");
  Group.next("Picture");
  addProjectionOption(App, R.Run.Through);
  addRendererOption(App, R.Run.Kind);
  addFalloffOption(App, R.Run.FalloffDegree);
  App.add_flag(
      "--antialiased", R.Run.Antialiased,
      "Compensate opacities for the dilation; the scene's file records this");
  addRulesOption(App, R.Convention);
  addNearOption(App, R.Run.Near);
  Group.next("Training");
  takesFile(App.add_option("--from", R.From,
                           "Start from the scene, the moments and the "
                           "iteration of another run's checkpoint"));
  addSettingOptions(App, A.Settings);
}

void addTrainPathOptions(CLI::App &App, TrainRequest &R) {
  const HelpGroup Group(App, "Accuracy and speed");
  addPathOption(App, R.Blending.Kind,
                "Unit that runs blending and its backward pass: the rasterizer "
                "or the cores");
  addTileOption(App, R.Blending.Tile, TilesBack, DefaultTileBack);
  addGroupOption(App, R.Blending.SimtGroup);
  addBackwardOptions(App, R.Backward);
}

Expected<Success> completeTrained(const CLI::App &App, TrainedArguments &A) {
  TrainRequest &R = A.Request;
  auto Settings = A.Settings.settings(App, R.Run.Settings);
  if (!Settings)
    return Settings.error();
  R.Run.Settings = *Settings;
  R.Backward.AbsoluteSums = Settings->AbsoluteGradient;
  R.Backward.Depths = looksAtDepths(*Settings);
  R.Backward.Poses = arePosesOn(*Settings);
  R.Read.Masks = R.Run.Masks;
  R.Read.Pictures = R.Run.Pictures;
  return Success{};
}

Expected<Success> checkTrained(const TrainRequest &R) {
  if (auto Checked = checkBackwardOptions(R.Backward, R.Blending.Kind);
      !Checked)
    return Checked;
  if (auto Checked = checkTilesBack(R.Blending.Kind, R.Blending.Tile,
                                    R.Blending.SimtGroup);
      !Checked)
    return Checked;
  if (R.Run.Settings.AbsoluteGradient && R.Blending.Kind != Path::Simt)
    return usage("--absgrad: the rasterizer accumulates no absolute gradients, "
                 "expected --path simt");
  if (R.Run.Pictures == LensOf::Photograph && looksAtDepths(R.Run.Settings))
    return usage("--depth-weight: the depth loss needs undistorted pictures, "
                 "expected no --distorted");
  if (auto Checked = checkFalloff(R.Run.Kind, R.Run.FalloffDegree); !Checked)
    return Checked;
  if (R.Run.Kind != RendererKind::Splat)
    for (const auto &[Is, Option] :
         {std::pair{R.Run.Through != Spread::Jacobian, "--projection"},
          {R.Run.Antialiased, "--antialiased"},
          {R.Run.Pictures == LensOf::Photograph, "--distorted"},
          {R.Run.Settings.AbsoluteGradient, "--absgrad"},
          {looksAtDepths(R.Run.Settings), "--depth-weight"},
          {arePosesOn(R.Run.Settings), "--pose-rate"},
          {R.Backward.Pixels != SimtSums::Ordered, "--simt-sums"}})
      if (Is)
        return excludedByRays(Option, R.Run.Kind);
  if (auto Checked = checkNear(R.Run.Near); !Checked)
    return Checked;
  for (const float V : R.Run.Background)
    if (!(V >= 0 && V <= 1))
      return usage(
          fmt::format("--background {}: expected values of 0 to 1", V));
  return Success{};
}

} // namespace vorion::splat
