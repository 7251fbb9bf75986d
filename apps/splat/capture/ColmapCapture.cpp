#include "capture/ColmapCapture.h"

#include "capture/Colmap.h"
#include "capture/Transforms.h"
#include "vorion/support/File.h"

namespace vorion::splat {

namespace fs = std::filesystem;

namespace {

/// A COLMAP model and the names of the files that it was read from.
struct ReadModel {
  ColmapModel Model;
  std::string Cameras, Images;
};

/// The points of a model that has them as a point cloud.
constexpr const char *PlyName = "points3D.ply";

std::vector<std::string> namesOf(const std::vector<CaptureView> &Views) {
  std::vector<std::string> Names;
  Names.reserve(Views.size());
  for (const CaptureView &V : Views)
    Names.push_back(V.Pose.Name);
  return Names;
}

/// The mask of \p Picture, which is in \p Pictures and the model's \p Name.
std::string maskBeside(const fs::path &Pictures, const fs::path &Picture,
                       const std::string &Name) {
  const fs::path Masks = Pictures.parent_path() / "masks";
  const std::string Mask = maskOf(Masks, Picture.lexically_relative(Pictures));
  return Mask.empty() ? maskOf(Masks, Name) : Mask;
}

Expected<ReadModel> readModel(const Location &F, bool PosesOnly) {
  const bool Text = F.Format == CaptureFormat::ColmapText;
  const char *Ending = Text ? ".txt" : ".bin";
  ColmapFiles Files;
  // Without COLMAP's own points there may be those of a PLY, or none.
  const std::string PointsName = std::string("points3D") + Ending;
  Files.PosesOnly = PosesOnly || !fileExists(F.Model / PointsName);
  std::vector<std::byte> Contents[3];
  const struct {
    const char *Name;
    ColmapFile &To;
  } Parts[] = {{"cameras", Files.Cameras},
               {"images", Files.Images},
               {"points3D", Files.Points}};
  for (std::size_t I = 0; I < (Files.PosesOnly ? 2U : 3U); ++I) {
    Parts[I].To.Where = (F.Model / (std::string(Parts[I].Name) + Ending))
                            .lexically_normal()
                            .string();
    auto Content = readRegularFile(Parts[I].To.Where);
    if (!Content)
      return Content.error();
    Contents[I] = std::move(*Content);
    Parts[I].To.Content = Contents[I];
  }
  auto Model = Text ? parseColmapText(Files) : parseColmapBinary(Files);
  if (!Model)
    return Model.error();
  if (const fs::path Cloud = F.Model / PlyName;
      !PosesOnly && Files.PosesOnly && fileExists(Cloud)) {
    const auto Content = readRegularFile(Cloud.string());
    if (!Content)
      return Content.error();
    auto Points = parsePointCloud(Cloud.string(), *Content);
    if (!Points)
      return Points.error();
    Model->Points = std::move(*Points);
  }
  return ReadModel{std::move(*Model), Files.Cameras.Where, Files.Images.Where};
}

} // namespace

Expected<Success> readColmap(const Location &F, const CaptureOptions &Options,
                             Capture &C) {
  auto Read = readModel(F, /*PosesOnly=*/false);
  if (!Read)
    return Read.error();
  C.Views = std::move(Read->Model.Views);
  C.Points = std::move(Read->Model.Points);
  for (CaptureView &V : C.Views) {
    if (auto Straight = checkPinhole(Read->Images, "image", V, Options);
        !Straight)
      return Straight;
    if (auto Inside = checkInside(Read->Images, V.Pose.Name, Options); !Inside)
      return Inside;
  }
  if (!F.Note.empty())
    C.Notes.push_back(F.Note);
  const auto [Folder, Files] = findPictures(pictureFolders(F, Options.Images),
                                            namesOf(C.Views), C.Notes);
  for (std::size_t I = 0; I < C.Views.size(); ++I) {
    C.Views[I].Picture = Files[I].string();
    if (Options.Masks == MaskSource::Files)
      C.Views[I].Mask = maskBeside(Folder, Files[I], C.Views[I].Pose.Name);
  }
  return leaveOutSome(C.Views, C);
}

Expected<Success> addColmapCameras(const Location &F, LensOf Of,
                                   CaptureCameras &To) {
  auto Read = readModel(F, /*PosesOnly=*/true);
  if (!Read)
    return Read.error();
  for (CaptureView &V : Read->Model.Views)
    if (auto Added = addCamera(Read->Cameras, std::move(V), Of, To); !Added)
      return Added;
  To.Files = {Read->Cameras, Read->Images};
  return Success{};
}

void addColmapFiles(const Location &F, std::vector<fs::path> &To) {
  const bool Text = F.Format == CaptureFormat::ColmapText;
  for (const char *Name : {"cameras", "images", "points3D"})
    To.push_back(F.Model / (std::string(Name) + (Text ? ".txt" : ".bin")));
  const auto Read = readModel(F, /*PosesOnly=*/true);
  if (!Read)
    return;
  To.push_back(F.Model / PlyName);
  std::vector<std::string> Notes;
  const std::vector<std::string> Names = namesOf(Read->Model.Views);
  const auto [Folder, Files] =
      findPictures(pictureFolders(F, {}), Names, Notes);
  for (std::size_t I = 0; I < Files.size(); ++I) {
    To.push_back(Files[I]);
    To.emplace_back(maskBeside(Folder, Files[I], Names[I]));
  }
}

} // namespace vorion::splat
