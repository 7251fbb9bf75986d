#include "commands/WorkloadState.h"

#include "capture/Photo.h"
#include "train/run/Checkpoint.h"
#include "train/settings/SettingsTable.h"
#include "vorion/support/File.h"
#include "vorion/support/Hash.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace vorion::splat {
namespace {

constexpr int MostDownscale = 64; // of splat train

/// The multiple of \p Downscale that makes pictures of \p Width no wider than
/// \p Most, or the largest that there is.
int smallDownscale(int Width, int Downscale, int Most) {
  int Small = Downscale;
  while (shrunkSide(Width, Small) > Most && Small + Downscale <= MostDownscale)
    Small += Downscale;
  return Small;
}

/// Has \p State begin with the checkpoint that it names; its hash.
Expected<std::string> beginWithCheckpoint(GivenState &State) {
  TrainRequest &R = State.Request;
  const auto Begin = readCheckpoint(R.From);
  if (!Begin)
    return Begin.error();
  R.Run.Settings.Iterations += Begin->Iteration;
  if (!State.HasDegree) {
    R.ShDegree = Begin->ShDegree;
    State.Words.push_back(fmt::format("--sh-degree={}", R.ShDegree));
  }
  if (auto Checked = checkBeginning(R, *Begin); !Checked)
    return Checked.error();
  return fnv1a64OfFile(R.From);
}

} // namespace

Expected<Success> addState(GivenWorkload &To, const PartHead &Head,
                           GivenState State) {
  TrainRequest &R = State.Request;
  const unsigned Timed = R.Run.Settings.Iterations;
  Provenance From{
      {"options", State.Options},
      {"iterations", std::to_string(Timed)},
      {"training", fnv1a64(jsonText(settingsJson(R.Run.Settings)))}};
  if (!R.From.empty()) {
    auto Hash = beginWithCheckpoint(State);
    if (!Hash)
      return Hash.error();
    From["state"] = std::move(*Hash);
  }
  State.Words.push_back(
      fmt::format("--iterations={}", R.Run.Settings.Iterations));
  const auto C = readCapture(R.Capture, R.Read);
  if (!C)
    return C.error();
  auto Hash = hashCapture(*C);
  if (!Hash)
    return Hash.error();
  From["capture"] = std::move(*Hash);
  const Camera &Widest =
      std::ranges::max_element(C->Views, {}, [](const CaptureView &V) {
        return V.Pose.Width;
      })->Pose;
  const auto AddTo = [&](std::vector<Task> &Tasks, int Downscale) {
    Task What{To.Does.Parts.size(),
              Head.Name,
              "",
              shrunkSide(Widest.Width, Downscale),
              shrunkSide(Widest.Height, Downscale),
              Timed,
              State.Words,
              {{"downscale", std::to_string(Downscale)}}};
    What.Words.push_back(fmt::format("--downscale={}", Downscale));
    Tasks.push_back(std::move(What));
  };
  AddTo(To.Does.Whole, R.Downscale);
  AddTo(To.Does.Small,
        smallDownscale(Widest.Width, R.Downscale, To.SmallWidth));
  To.Does.Parts.push_back(
      {Head.Name, Work::Iterations, Head.Weight, std::move(From)});
  return Success{};
}

} // namespace vorion::splat
