#include "commands/WorkloadParts.h"

#include "cameras/Motion.h"
#include "commands/StudyArguments.h"
#include "io/Hash.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <utility>

namespace vorion::splat {
namespace {

/// The same view with fewer pixels, where it is wider than \p Most.
Camera smaller(Camera View, int Most) {
  return View.Width <= Most ? View : resized(std::move(View), Most);
}

/// A task of the last part of \p To for each of \p Views, which are \p Small.
void addFrames(GivenWorkload &To, const SceneArguments &Scene,
               std::vector<Camera> Views, bool Small) {
  const std::size_t Of = To.Does.Parts.size() - 1;
  const std::string &Part = To.Does.Parts.back().Name;
  const std::string File =
      fmt::format("{}/{}{}{}.json", To.Folder, Small ? "small" : "cameras",
                  Part.empty() ? "" : "-", Part);
  auto &Tasks = Small ? To.Does.Small : To.Does.Whole;
  for (const Camera &View : Views) {
    std::vector<std::string> Words{"render", Scene.Path, "--cameras",
                                   File,     "--view",   View.Name};
    std::ranges::copy(wordsOf(Scene), std::back_inserter(Words));
    Tasks.push_back({Of,
                     Part.empty() ? View.Name : Part + "@" + View.Name,
                     View.Name,
                     View.Width,
                     View.Height,
                     0,
                     std::move(Words),
                     {{"view", hashView(View)}}});
  }
  To.ViewFiles.push_back({File, std::move(Views), Small});
}

} // namespace

Expected<Success> addScene(GivenWorkload &To, const PartHead &Head,
                           const SceneArguments &Scene,
                           const CameraArguments &Cameras,
                           const std::string &Where) {
  auto Views = studyViews(Cameras, Scene, Where);
  if (!Views)
    return Views.error();
  auto Hash = hashScene(Scene.Path);
  if (!Hash)
    return Hash.error();
  To.Does.Parts.push_back(
      {Head.Name,
       Work::Frames,
       Head.Weight,
       {{"scene", std::move(*Hash)},
        {"options", fmt::format("{}", fmt::join(wordsOf(Scene), " "))}}});
  std::vector<Camera> Small;
  for (const Camera &View : *Views)
    Small.push_back(smaller(View, To.SmallWidth));
  addFrames(To, Scene, std::move(*Views), false);
  addFrames(To, Scene, std::move(Small), true);
  return Success{};
}

void completeWorkload(GivenWorkload &W) {
  bool AnySmaller = false;
  for (std::size_t I = 0; I < W.Does.Whole.size(); ++I) {
    Task &Small = W.Does.Small[I];
    if (Small.Width < W.Does.Whole[I].Width) {
      Small.Name += "@small";
      AnySmaller = true;
    } else {
      Small = W.Does.Whole[I];
    }
  }
  if (AnySmaller)
    return;
  W.Does.Small.clear();
  std::erase_if(W.ViewFiles, [](const ViewFile &F) { return F.IsSmall; });
}

} // namespace vorion::splat
