#include "capture/CaptureFiles.h"

#include "io/Inside.h"
#include "vorion/support/Printable.h"

#include <cmath>
#include <fmt/format.h>

namespace vorion::splat {

namespace fs = std::filesystem;

bool fileExists(const fs::path &P) {
  std::error_code Ignored;
  return fs::exists(P, Ignored);
}

std::optional<Location> findCapture(const fs::path &Path) {
  if (Path.extension() == ".json" && fileExists(Path))
    return Location{CaptureFormat::Transforms, Path, Path.parent_path()};
  for (const char *Sub : {"sparse/0", "sparse", "."})
    for (const auto &[Ending, Format] :
         {std::pair(".bin", CaptureFormat::ColmapBinary),
          std::pair(".txt", CaptureFormat::ColmapText)})
      if (fileExists(Path / Sub / (std::string("cameras") + Ending)))
        return Location{Format, Path / Sub, Path / "images"};
  if (fileExists(Path / "transforms_train.json"))
    return Location{CaptureFormat::NerfSynthetic,
                    Path / "transforms_train.json", Path};
  if (fileExists(Path / "transforms.json"))
    return Location{CaptureFormat::Transforms, Path / "transforms.json", Path};
  return std::nullopt;
}

std::optional<Location> findCameras(const fs::path &Path) {
  auto F = findCapture(Path);
  if (!F && (Path.extension() == ".bin" || Path.extension() == ".txt"))
    F = findCapture(Path.has_parent_path() ? Path.parent_path()
                                           : fs::path("."));
  return F;
}

fs::path pictureOf(const fs::path &Folder, const std::string &Name) {
  for (const char *Ending : {"", ".png", ".jpg", ".jpeg", ".webp"})
    if (fs::path P = Folder / (Name + Ending); fileExists(P))
      return P;
  return Folder / Name;
}

Error isOutside(const std::string &File, const std::string &Name,
                std::string_view Remedy) {
  return {
      File,
      fmt::format(
          "refers to the file `{}`, expected a file inside the folder, or {}",
          printable(Name), Remedy)};
}

Expected<Success> checkInside(const std::string &File, const std::string &Name,
                              const CaptureOptions &Options) {
  if (Options.AllowOutside || staysInside(Name))
    return Success{};
  return isOutside(File, Name, "--allow-outside");
}

std::string maskOf(const fs::path &Masks, const fs::path &Name) {
  fs::path Png = Name;
  for (const fs::path &File :
       {fs::path(Name.string() + ".png"), Name, Png.replace_extension(".png")})
    if (fileExists(Masks / File))
      return (Masks / File).string();
  return {};
}

Expected<Success> checkPinhole(const std::string &File, std::string_view Kind,
                               const CaptureView &V,
                               const CaptureOptions &Options) {
  if (Options.Pictures == LensOf::Photograph)
    return Success{};
  if (V.Optics.Model->CoversSphere)
    return Error{
        File, fmt::format("{} {} has the camera model {}, which cannot be "
                          "undistorted to a pinhole, expected photographs of "
                          "perspective or fisheye cameras, or --distorted",
                          Kind, printable(V.Pose.Name), V.Optics.Model->Name)};
  if (V.Optics.Shutter)
    return Error{
        File,
        fmt::format("{} {} has a rolling shutter, which cannot be undistorted "
                    "to a pinhole, expected a global shutter (without the key "
                    "rolling_shutter the first pose is used), or --distorted",
                    Kind, printable(V.Pose.Name))};
  return Success{};
}

Expected<Success> addCamera(const std::string &File, CaptureView V, LensOf Of,
                            CaptureCameras &To) {
  V.Pose.Id = static_cast<int>(To.Cameras.size());
  // A sphere has no pinhole's picture.
  if (Of == LensOf::Photograph || V.Optics.Model->CoversSphere) {
    V.Pose.Optics = V.Optics;
    if (!std::ranges::all_of(V.Optics.K, [](double K) {
          return std::abs(K) <= MostLensCoefficient;
        }))
      return Error{File,
                   fmt::format("view {} has lens coefficients above {:g}, "
                               "expected smaller coefficients",
                               printable(V.Pose.Name), MostLensCoefficient)};
  }
  To.Cameras.push_back(std::move(V.Pose));
  return Success{};
}

} // namespace vorion::splat
