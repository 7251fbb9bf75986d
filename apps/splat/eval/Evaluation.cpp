#include "eval/Evaluation.h"

#include "io/Metrics.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace vorion::splat {
namespace {

/// As the metrics take them, from 0 to 1.
std::vector<double> levels(const Photo &P) {
  std::vector<double> Values(P.Rgb.size());
  std::ranges::transform(P.Rgb, Values.begin(),
                         [](uint8_t Level) { return Level / 255.0; });
  return Values;
}

Expected<Photo> rounded(const Camera &C, const Image &I) {
  // As a byte a NaN would be black.
  if (std::ranges::any_of(I.Render, [](float V) { return std::isnan(V); }))
    return Error{
        "",
        fmt::format(
            "view {} of the scene has non-finite values, expected a picture",
            printable(C.Name)),
        ExitCode::GuestFailed};
  Photo P{I.Width, I.Height, std::vector<uint8_t>(I.Render.size())};
  std::ranges::transform(I.Render, P.Rgb.begin(), toByte);
  return P;
}

} // namespace

std::vector<JudgedView> judgedViews(const TrainingSet &Set, bool All) {
  std::vector<JudgedView> Views;
  Views.reserve(Set.HeldOut.size() + Set.Training.size());
  for (const TrainView &V : Set.HeldOut)
    Views.push_back({&V, true});
  if (All)
    for (const TrainView &V : Set.Training)
      Views.push_back({&V, false});
  std::ranges::sort(Views, {}, [](const JudgedView &V) -> const std::string & {
    return V.View->Pose.Name;
  });
  return Views;
}

ViewScore scoreOf(const JudgedView &V, Photo Drawn) {
  const Photo &Wanted = V.View->Picture;
  const std::vector<uint8_t> &Counts = V.View->Counts;
  // What does not count is black in both, for SSIM's windows too.
  for (std::size_t I = 0; I < Counts.size(); ++I)
    if (Counts[I] == 0)
      std::fill_n(Drawn.Rgb.begin() + static_cast<std::ptrdiff_t>(3 * I), 3, 0);
  const std::vector<double> A = levels(Wanted), B = levels(Drawn);
  const auto Width = static_cast<std::size_t>(Wanted.Width);
  ViewScore Score{V.View->Pose.Name,
                  V.HeldOut,
                  {},
                  psnrOfBytes(Drawn.Rgb, Wanted.Rgb, Counts),
                  ssim(A, B, Width, 3),
                  msSsim(A, B, Width, 3)};
  Score.Drawn = std::move(Drawn);
  return Score;
}

std::optional<MeanScore> meanOf(const std::vector<ViewScore> &Scores,
                                std::optional<bool> HeldOut) {
  MeanScore Mean;
  double MsSsim = 0;
  bool Whole = true;
  for (const ViewScore &S : Scores) {
    if (HeldOut && S.HeldOut != *HeldOut)
      continue;
    ++Mean.Views;
    Mean.PsnrDb += S.PsnrDb;
    Mean.Ssim += S.Ssim;
    MsSsim += S.MsSsim.value_or(0);
    Whole = Whole && S.MsSsim;
  }
  if (Mean.Views == 0)
    return {};
  const auto Views = static_cast<double>(Mean.Views);
  Mean.PsnrDb /= Views;
  Mean.Ssim /= Views;
  if (Whole)
    Mean.MsSsim = MsSsim / Views;
  return Mean;
}

Expected<std::vector<ViewScore>>
evaluate(Launcher &Launch, const RenderPlan &Plan, const Scene &S,
         const RenderOptions &Options, const std::vector<JudgedView> &Views) {
  if (auto Built = build(Launch, Plan, S); !Built)
    return Built.error();
  Launch.beginStage(Stage::Upload);
  const GaussianBuffers Gaussians = uploadGaussians(Launch, S, Plan.Effects);
  activate(Launch, Plan, Gaussians);
  std::vector<ViewScore> Scores;
  for (const JudgedView &V : Views) {
    const Camera &Pose = V.View->Pose;
    const auto Drawn =
        draw(Launch, Plan, Gaussians, Pose, Options, /*KeepPairs=*/false);
    if (!Drawn)
      return Drawn.error();
    auto Picture = rounded(Pose, Drawn->Picture);
    if (!Picture)
      return Picture.error();
    Scores.push_back(scoreOf(V, std::move(*Picture)));
  }
  return Scores;
}

} // namespace vorion::splat
