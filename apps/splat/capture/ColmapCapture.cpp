#include "capture/ColmapCapture.h"

#include "capture/Colmap.h"
#include "vorion/support/File.h"

namespace vorion::splat {

namespace fs = std::filesystem;

namespace {

/// A COLMAP model and the names of the files that it was read from.
struct ReadModel {
  ColmapModel Model;
  std::string Cameras, Images;
};

Expected<ReadModel> readModel(const Location &F, bool PosesOnly) {
  const bool Text = F.Format == CaptureFormat::ColmapText;
  const char *Ending = Text ? ".txt" : ".bin";
  ColmapFiles Files;
  Files.PosesOnly = PosesOnly;
  std::vector<std::byte> Contents[3];
  const struct {
    const char *Name;
    ColmapFile &To;
  } Parts[] = {{"cameras", Files.Cameras},
               {"images", Files.Images},
               {"points3D", Files.Points}};
  for (std::size_t I = 0; I < (PosesOnly ? 2U : 3U); ++I) {
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
    V.Picture = (F.Pictures / V.Pose.Name).string();
    if (Options.Masks == MaskSource::Files)
      V.Mask = maskOf(F.Pictures.parent_path() / "masks", V.Pose.Name);
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
  for (const CaptureView &V : Read->Model.Views) {
    To.push_back(F.Pictures / V.Pose.Name);
    To.emplace_back(maskOf(F.Pictures.parent_path() / "masks", V.Pose.Name));
  }
}

} // namespace vorion::splat
