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
  App.add_option("--iterations", S.Iterations,
                 fmt::format("Iterations in all (default {})", S.Iterations))
      ->check(isIterations());
  App.add_option("--downscale", R.Downscale,
                 "Pictures so many times smaller (default 1)")
      ->check(isBetween(1, 64));
  App.add_option("--max-gaussians", S.MostGaussians,
                 fmt::format("No more Gaussians than this (default {})",
                             S.MostGaussians))
      ->check(isBetween(4U, 100000000U));
  addChoice(App, "--moments", R.Moments,
            {MomentsChoice::Auto, MomentsChoice::Device, MomentsChoice::Host},
            "Where Adam's moments lie, which changes no bit: with auto on the "
            "host if the device does not hold --max-gaussians with them");
  App.add_option("--exclude", R.Read.Exclude, "Leave out this picture")
      ->allow_extra_args(false);
  addHoldOutOption(App, R.Read.HoldOut);
  addOutsideOption(App, R.Read.AllowOutside);
  App.add_option("--batch", R.Run.Batch,
                 "Views an iteration, shared out to the processes that mpirun "
                 "started, each with a device of its own (default 1)")
      ->check(isBetween(1U, 4096U));
  App.add_option("--seed", R.Run.Seed, "Of all random numbers (default 0)")
      ->check(isBetween<uint64_t>(0, MostSeed));
  App.add_option("--sh-degree", R.ShDegree,
                 "Bands of spherical harmonics (default 3)")
      ->check(isBetween(0, MaxShDegree));
  addBackgroundOption(App, R.Run.Background,
                      "Colour r,g,b behind the scene and under transparent "
                      "pixels (default 0,0,0)");
  App.add_flag(
      "--random-background", R.Run.RandomBackground,
      "Another colour for each view of an iteration; --background is that of "
      "held-out views");
  addMasksOption(App, R.Run.Masks);
  App.add_flag(
      "--distorted",
      [&R](std::int64_t) { R.Run.Pictures = LensOf::Photograph; },
      "Train on photographs as they are, through their lenses, instead of "
      "undistorting them");
  addProjectionOption(App, R.Run.Through);
  App.add_flag(
      "--antialiased", R.Run.Antialiased,
      "Lower opacities where the dilation widens a Gaussian; the scene "
      "says that it is to be drawn so");
  addRulesOption(App, R.Convention);
  takesFile(
      App.add_option("--from", R.From,
                     "Begin with the scene, the moments and the iteration of "
                     "another run's checkpoint"));
  addSettingOptions(App, A.Settings);
}

void addTrainPathOptions(CLI::App &App, TrainRequest &R) {
  addPathOption(App, R.Blending.Kind,
                "Who blends and goes back: the rasterizer or the cores");
  addSimtOptions(App, R.Blending.SimtTile, R.Blending.SimtGroup, SimtTilesBack);
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
  if (auto Checked = checkSimtOptions(R.Blending.Kind, R.Blending.SimtTile,
                                      R.Blending.SimtGroup);
      !Checked)
    return Checked;
  if (R.Run.Settings.AbsoluteGradient && R.Blending.Kind != Path::Simt)
    return usage("--absgrad: the rasterizer's nine sums have no absolute "
                 "values, expected --path simt with it");
  if (R.Run.Pictures == LensOf::Photograph && looksAtDepths(R.Run.Settings))
    return usage("--depth-weight: depths are known in undistorted pictures "
                 "alone, expected no --distorted with it");
  for (const float V : R.Run.Background)
    if (!(V >= 0 && V <= 1))
      return usage(
          fmt::format("--background {}: expected values of 0 to 1", V));
  return Success{};
}

} // namespace vorion::splat
