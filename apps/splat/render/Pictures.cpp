#include "render/Pictures.h"

#include "io/Inside.h"
#include "io/Npz.h"
#include "io/ReportHead.h"
#include "picture/View.h"
#include "render/FrameTime.h"
#include "render/Report.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

Expected<Success> writePairs(const std::string &File, const SortedPairs &P) {
  // The bits are those of unsigned words; NumPy's view("u4") shows them so.
  const auto Words = [](const std::vector<uint32_t> &V) {
    return NpyArray::of({V.size()}, std::vector<int32_t>(V.begin(), V.end()));
  };
  return writeNpz(File, {{"tile", Words(P.Tiles)},
                         {"depth_bits", Words(P.DepthBits)},
                         {"index", Words(P.Gaussians)}});
}

} // namespace

ViewFacts factsOfAll(const Scene &S, const std::vector<Camera> &Cameras,
                     const RenderOptions &O) {
  std::optional<ViewFacts> All;
  for (const Camera &C : Cameras) {
    const ViewFacts Own = factsOf(S, makeView(relativeTo(C, S.Origin), O), O);
    All = All ? combined(*All, Own) : Own;
  }
  return *All;
}

/// What --energy adds to a report of these stages.
static Expected<Success> addEnergy(Json &Report, const PictureJob &J,
                                   const std::vector<StageReport> &Stages) {
  if (!J.Energy)
    return Success{};
  auto Energy = frameEnergyJson(Stages, *J.Energy);
  if (!Energy)
    return Energy.error();
  if (!Energy->is_null())
    Report["energy"] = std::move(*Energy);
  return Success{};
}

Expected<Json> reportOf(const PictureJob &J, const std::string &Output,
                        const Camera &C, const RenderResult &R) {
  auto Report =
      jsonReport({J.ScenePath, J.AxesChange, J.CameraFile, Output, J.Input,
                  J.Gaussians, C, J.Options, J.Plan, J.Launch.device(), R});
  if (!Report)
    return Report;
  if (const auto Time = Report->find("time"); Time != Report->end())
    (*Report)["bounds"] = boundsJson(*Time, J.Others);
  if (!J.Others.empty())
    (*Report)["what_if"] = whatIfJson(J.Others, pictureHash(R.Picture));
  if (const auto Added = addEnergy(*Report, J, R.Stages); !Added)
    return Added.error();
  return Report;
}

Expected<RenderResult> drawPicture(const PictureJob &J, const Camera &C) {
  return render(J.Launch, J.Plan, std::move(J.Input.Gaussians), C, J.Options,
                !J.Pairs.empty());
}

Expected<Success> writePicture(const PictureJob &J, const Camera &C,
                               const RenderResult &R) {
  if (auto Written = writeImage(J.Output, R.Picture, J.Format); !Written)
    return Written;
  if (!J.Pairs.empty())
    if (auto Written = writePairs(J.Pairs, *R.Sorted); !Written)
      return Written;
  if (auto Written = writeLayers(J.Layers, R, J.Options); !Written)
    return Written;
  if (J.Json.empty())
    return Success{};
  const auto Report = reportOf(J, J.Output, C, R);
  if (!Report)
    return Report.error();
  return writeFileAtomically(J.Json, jsonText(*Report, 2) + "\n");
}

std::string pictureFile(const std::string &Output, const Camera &C) {
  const std::filesystem::path Path(Output);
  return (Path.parent_path() / (Path.stem().string() + "." +
                                asFileName(C.Name) + Path.extension().string()))
      .string();
}

Expected<Success>
writePictures(const PictureJob &J, const std::vector<Camera> &Cameras,
              bool Overlap, const SequenceResult &R,
              const std::function<void(const std::string &)> &Written) {
  Json Reports = Json::array();
  for (std::size_t N = 0; N < Cameras.size(); ++N) {
    const std::string Output = pictureFile(J.Output, Cameras[N]);
    if (auto Done = writeImage(Output, R.Frames[N].Picture, J.Format); !Done)
      return Done;
    Written(Output);
    if (J.Json.empty())
      continue;
    auto Report = reportOf(J, Output, Cameras[N], R.Frames[N]);
    if (!Report)
      return Report.error();
    Reports.push_back(std::move(*Report));
  }
  if (J.Json.empty())
    return Success{};
  Json All = reportHead("splat-render-views");
  All.update({{"overlap", Overlap}, {"pictures", std::move(Reports)}});
  if (Json Time = sequenceJson(R); !Time.is_null())
    All["time"] = std::move(Time);
  if (const auto Added = addEnergy(All, J, R.Stages); !Added)
    return Added;
  return writeFileAtomically(J.Json, jsonText(All, 2) + "\n");
}

} // namespace vorion::splat
