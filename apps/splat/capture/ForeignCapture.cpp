#include "capture/ForeignCapture.h"

#include "capture/CaptureFiles.h"
#include "io/Bytes.h"
#include "vorion/support/File.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace vorion::splat {

namespace fs = std::filesystem;

namespace {

/// A program's export.
struct Export {
  std::string_view What, Advice;
};

constexpr Export Polycam{
    "Polycam's raw data",
    "`ns-process-data polycam` of nerfstudio converts it to transforms.json"};
constexpr Export Record3d{
    "a capture of Record3D",
    "`ns-process-data record3d` of nerfstudio converts it to transforms.json"};
constexpr Export Metashape{
    "cameras of Metashape",
    "Metashape exports COLMAP's files (File, Export, Export Cameras), and "
    "`ns-process-data metashape` of nerfstudio converts the XML file"};
constexpr Export RealityCapture{
    "cameras of RealityCapture",
    "RealityCapture exports COLMAP's files (Export, Registration), and "
    "`ns-process-data realitycapture` of nerfstudio converts the table"};
constexpr Export Lcc{"a scene of XGRIDS (LCC)",
                     "`splat-transform SCENE.lcc SCENE.ply` converts it to a "
                     "scene that splat reads"};
constexpr Export OpenSfm{
    "a reconstruction of OpenSfM or OpenDroneMap",
    "`ns-process-data odm` of nerfstudio converts it to transforms.json"};
constexpr Export Llff{"a capture of LLFF",
                      "find the poses of its photographs with COLMAP"};
constexpr Export Bundler{"a reconstruction of Bundler",
                         "`colmap model_converter` or the program that wrote "
                         "it exports COLMAP's files"};
constexpr Export Database{"COLMAP's database without a model",
                          "`colmap mapper` makes the model from it"};
constexpr Export Photographs{"photographs without poses",
                             "`splat capture` finds their poses"};

/// Exports that a file in a folder shows: all of \c Files are there.
const struct {
  std::vector<const char *> Files;
  const Export &Is;
} InFolder[] = {
    {{"keyframes/corrected_cameras"}, Polycam},
    {{"keyframes/cameras"}, Polycam},
    {{"metadata", "rgbd"}, Record3d},
    {{"metadata.json", "rgbd"}, Record3d},
    {{"reconstruction.json"}, OpenSfm},
    {{"opensfm"}, OpenSfm},
    {{"odm_report"}, OpenSfm},
    {{"poses_bounds.npy"}, Llff},
    {{"bundle.out"}, Bundler},
    {{"bundle.rd.out"}, Bundler},
};

/// Exports by the extension of a file.
const struct {
  std::string_view Ending;
  const Export &Is;
} ByEnding[] = {{".r3d", Record3d},
                {".lcc", Lcc},
                {".lcc2", Lcc},
                {".psx", Metashape},
                {".psz", Metashape},
                {".rcproj", RealityCapture},
                {".rsproj", RealityCapture}};

const Export *ofFile(const fs::path &File) {
  const std::string Ending = lowerCase(File.extension().string());
  for (const auto &[Known, Is] : ByEnding)
    if (Ending == Known)
      return &Is;
  constexpr std::size_t Looked = 4096;
  if (Ending != ".xml" && Ending != ".csv" && Ending != ".out")
    return nullptr;
  const auto Start = readStart(File.string(), Looked);
  if (!Start)
    return nullptr;
  const std::string_view Text = asText(*Start);
  if (Ending == ".xml")
    return Text.find("<document") != std::string_view::npos &&
                   Text.find("<chunk") != std::string_view::npos
               ? &Metashape
               : nullptr;
  if (Ending == ".csv")
    return Text.starts_with("#name,x,y") ? &RealityCapture : nullptr;
  return Text.starts_with("# Bundle file") ? &Bundler : nullptr;
}

const Export *ofFolder(const fs::path &Folder) {
  for (const auto &[Files, Is] : InFolder)
    if (std::ranges::all_of(
            Files, [&](const char *F) { return fileExists(Folder / F); }))
      return &Is;
  std::error_code Ignored;
  const Export *Found = nullptr;
  for (fs::directory_iterator It(Folder, Ignored), End; It != End && !Found;
       It.increment(Ignored))
    Found = ofFile(It->path());
  if (Found)
    return Found;
  if (fileExists(Folder / "database.db"))
    return &Database;
  // The pictures beside a SOG's index are its Gaussians.
  if (fileExists(Folder / "meta.json") || fileExists(Folder / "lod-meta.json"))
    return nullptr;
  for (const fs::path &In : {Folder, Folder / "images", Folder / "input"})
    for (fs::directory_iterator It(In, Ignored), End; It != End;
         It.increment(Ignored))
      if (isPictureName(It->path()))
        return &Photographs;
  return nullptr;
}

} // namespace

std::optional<Error> foreignCapture(const fs::path &Path) {
  std::error_code Ignored;
  const Export *Is = fs::is_directory(Path, Ignored) ? ofFolder(Path)
                     : fileExists(Path)              ? ofFile(Path)
                                                     : nullptr;
  if (!Is)
    return std::nullopt;
  return Error{Path.string(),
               fmt::format("{}, expected a capture as COLMAP's files or "
                           "transforms.json; {}",
                           Is->What, Is->Advice)};
}

} // namespace vorion::splat
