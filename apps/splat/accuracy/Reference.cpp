#include "accuracy/Reference.h"

#include "analyze/ToReference.h"
#include "cameras/CameraFile.h"
#include "io/Inside.h"
#include "io/Npz.h"
#include "picture/SceneUnit.h"
#include "reference/Mesh.h"
#include "reference/Render.h"

#include <fmt/format.h>
#include <memory>
#include <optional>
#include <utility>

namespace vorion::splat {

namespace {

std::string referenceFile(const SweepPlan &P, const Point &Of) {
  return fmt::format("{}/references/{}-{}.npz", P.Folder,
                     asFileName(Of.View->Name),
                     Of.Chosen.value(KnobId::Support));
}

/// The scene, once a reference needs it.
struct ReadScene {
  std::optional<reference::Gaussians<double>> Scene;
  std::optional<reference::Mesh> Surface; ///< where there is one
  WorldPoint Origin{};
  reference::Options Options;

  Expected<Success> load(const SweepPlan &P) {
    if (Scene)
      return Success{};
    auto File = P.Load();
    if (!File)
      return File.error();
    // As the processes that draw do.
    const auto Cameras = readCameraFile(P.CameraFile);
    std::optional<float> Near;
    prepareToDraw(File->Gaussians, Cameras ? Cameras->Cameras : P.Views,
                  Rules::Inria, Near);
    Scene = toReference<double>(File->Gaussians);
    Origin = File->Gaussians.Origin;
    if (P.Surface) {
      Surface = toReference(*P.Surface, P.Light);
      for (glm::dvec3 &At : Surface->Positions)
        At -= glm::dvec3(Origin[0], Origin[1], Origin[2]);
    }
    Options = toReference(File->DrawnAs);
    Options.Near = double{Near.value_or(0)};
    return Success{};
  }
};

Expected<Success> writeReference(const std::string &Path, const ReadScene &Of,
                                 const Camera &View, Support Reach) {
  reference::Options O = Of.Options;
  O.Reach = toReference(Reach);
  const auto C = toReference<double>(relativeTo(View, Of.Origin));
  std::optional<reference::Surface<double>> Behind;
  if (Of.Surface)
    Behind = reference::surfaceOf(*Of.Surface, C,
                                  reference::viewOf(*Of.Surface, C, O));
  const auto Picture =
      reference::render(*Of.Scene, C, O, Behind ? &*Behind : nullptr);
  std::vector<double> Render;
  Render.reserve(3 * Picture.Render.size());
  for (const auto &Pixel : Picture.Render)
    Render.insert(Render.end(), {Pixel.x, Pixel.y, Pixel.z});
  const auto Height = static_cast<std::size_t>(Picture.Height);
  const auto Width = static_cast<std::size_t>(Picture.Width);
  return writeNpz(Path, {{"render", NpyArray::of({Height, Width, 3}, Render)}});
}

} // namespace

std::function<Expected<Success>(const Point &)>
referenceMaker(const SweepPlan &P, std::function<void(std::string_view)> Log) {
  return [&P, Log = std::move(Log),
          Read = std::make_shared<ReadScene>()](const Point &Of) {
    const std::string Path = referenceFile(P, Of);
    const Support Reach = Of.Chosen.support();
    Provenance From = provenanceOf(P, Of);
    From["support"] = name(Reach);
    return makeOnce({Path}, From, [&]() -> Expected<Success> {
      if (auto Loaded = Read->load(P); !Loaded)
        return Loaded;
      Log(fmt::format("reference of {}, support {}", Of.View->Name,
                      name(Reach)));
      return writeReference(Path, *Read, *Of.View, Reach);
    });
  };
}

Expected<ExactImage> referenceOf(const SweepPlan &P, const Point &Of) {
  return readImage(referenceFile(P, Of));
}

} // namespace vorion::splat
