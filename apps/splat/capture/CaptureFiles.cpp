#include "capture/CaptureFiles.h"

#include "capture/PictureNames.h"
#include "io/Bytes.h"
#include "io/Inside.h"
#include "vorion/support/File.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace vorion::splat {

namespace fs = std::filesystem;

bool fileExists(const fs::path &P) {
  std::error_code Ignored;
  return fs::exists(P, Ignored);
}

/// The extensions of pictures that photographs may have.
constexpr const char *PictureEndings[] = {".png", ".jpg", ".jpeg", ".webp"};

bool isPictureName(const fs::path &Path) {
  const std::string Ending = lowerCase(Path.extension().string());
  return std::ranges::find(PictureEndings, Ending) != std::end(PictureEndings);
}

namespace {

/// A model of COLMAP in \p Folder; empty if there is none.
std::optional<Location> modelIn(const fs::path &Folder, const fs::path &Root) {
  for (const auto &[Ending, Format] :
       {std::pair(".bin", CaptureFormat::ColmapBinary),
        std::pair(".txt", CaptureFormat::ColmapText)})
    if (fileExists(Folder / (std::string("cameras") + Ending)))
      return Location{Format, Folder, Root, {}};
  return std::nullopt;
}

/// The number of images of \p Model: what its file says, or the lines of text
/// that are not comments, two for each image.
std::size_t imagesOf(const Location &Model) {
  if (Model.Format == CaptureFormat::ColmapBinary) {
    const auto Start =
        readStart((Model.Model / "images.bin").string(), sizeof(uint64_t));
    return Start && Start->size() == sizeof(uint64_t)
               ? static_cast<std::size_t>(load<uint64_t>(*Start, 0))
               : 0;
  }
  const auto File = readRegularFile((Model.Model / "images.txt").string());
  if (!File)
    return 0;
  std::size_t Lines = 0;
  bool IsStart = true, IsComment = false;
  for (const std::byte B : *File) {
    const char C = static_cast<char>(B);
    IsComment = IsStart ? C == '#' : IsComment;
    IsStart = C == '\n';
    Lines += IsStart && !IsComment ? 1 : 0;
  }
  return Lines / 2;
}

/// The sub-folders of \p Folder by name, at most \p Depth deep.
std::vector<fs::path> foldersIn(const fs::path &Folder, int Depth) {
  constexpr std::size_t MostEntries = 100'000;
  std::vector<fs::path> Folders;
  std::error_code Ignored;
  std::size_t Count = 0;
  for (fs::recursive_directory_iterator It(
           Folder, fs::directory_options::skip_permission_denied, Ignored);
       It != fs::recursive_directory_iterator() && ++Count < MostEntries;
       It.increment(Ignored)) {
    if (It.depth() + 1 >= Depth)
      It.disable_recursion_pending();
    if (It->is_directory(Ignored))
      Folders.push_back(It->path());
  }
  std::ranges::sort(Folders);
  return Folders;
}

/// The model of the most images in \p Folders.
std::optional<Location> largestOf(const std::vector<fs::path> &Folders,
                                  const fs::path &Root) {
  std::vector<Location> Models;
  for (const fs::path &Folder : Folders)
    if (auto Model = modelIn(Folder, Root))
      Models.push_back(std::move(*Model));
  if (Models.size() < 2)
    return Models.empty() ? std::nullopt : std::optional(Models.front());
  const auto Largest = std::ranges::max_element(Models, {}, imagesOf);
  Largest->Note =
      fmt::format("the model {} with {}, the largest of {}",
                  Largest->Model.lexically_relative(Root).string(),
                  counted(imagesOf(*Largest), "image"), Models.size());
  return *Largest;
}

/// The model in \p Folder, or the largest in its sub-folders.
std::optional<Location> modelAt(const fs::path &Folder, const fs::path &Root) {
  auto Model = largestOf(foldersIn(Folder, 1), Root);
  return Model ? Model : modelIn(Folder, Root);
}

/// Whether a place of pictures exists for the model at \p F, or the capture's
/// folder has some beside its other files.
bool hasPictures(const Location &F) {
  std::error_code Ignored;
  for (const fs::path &Folder : pictureFolders(F, {}))
    if (Folder.filename() != "." && fileExists(Folder))
      return true;
  return std::ranges::any_of(
      fs::directory_iterator(F.Root, Ignored),
      [](const fs::directory_entry &Entry) { return isPictureName(Entry); });
}

/// The largest model that has pictures, as COLMAP's undistorter writes them
/// beside a model; empty if there is none.
std::optional<Location> modelWithPictures(const fs::path &Root) {
  std::vector<fs::path> Folders = foldersIn(Root, 3);
  std::erase_if(Folders, [&](const fs::path &Folder) {
    const auto Model = modelIn(Folder, Root);
    return !Model || !hasPictures(*Model);
  });
  return largestOf(Folders, Root);
}

/// \p Found, with a note that names the model.
Location named(Location Found) {
  if (Found.Note.empty())
    Found.Note = fmt::format(
        "the model {}", Found.Model.lexically_relative(Found.Root).string());
  return Found;
}

} // namespace

std::optional<Location> findCapture(const fs::path &Path, bool NeedsPictures) {
  if (Path.extension() == ".json" && fileExists(Path))
    return Location{CaptureFormat::Transforms, Path, Path.parent_path(), {}};
  auto Found = modelAt(Path / "sparse", Path);
  if (!Found)
    Found = modelIn(Path, Path);
  for (const auto &[Name, Format] :
       {std::pair("transforms_train.json", CaptureFormat::NerfSynthetic),
        std::pair("transforms.json", CaptureFormat::Transforms)})
    if (!Found && fileExists(Path / Name))
      return Location{Format, Path / Name, Path, {}};
  if (Found && NeedsPictures && !hasPictures(*Found))
    if (auto Other = modelWithPictures(Path))
      return named(std::move(*Other));
  if (Found)
    return Found;
  // nerfstudio's layout, and that of INRIA before it undistorts pictures.
  for (const char *Sub : {"colmap/sparse", "colmap", "distorted/sparse"})
    if (!Found)
      Found = modelAt(Path / Sub, Path);
  if (!Found)
    Found = largestOf(foldersIn(Path, 3), Path);
  return Found ? std::optional(named(std::move(*Found))) : std::nullopt;
}

std::vector<fs::path> pictureFolders(const Location &F,
                                     const std::string &Given) {
  if (!Given.empty()) {
    const fs::path Inside = F.Root / Given;
    return {fileExists(Inside) ? Inside : fs::path(Given)};
  }
  if (!F.isColmap())
    return {F.Root};
  std::vector<fs::path> Folders{F.Root / "images"};
  // Beside the model, and beside each folder on the way to it.
  for (fs::path At = F.Model.lexically_normal();
       At != F.Root.lexically_normal() && At.has_relative_path();
       At = At.parent_path())
    Folders.push_back(At / "images");
  // INRIA's scripts keep distorted photographs in `input`.
  for (const char *Name : {"input", "images_2", "images_4", "images_8", "."})
    Folders.push_back(F.Root / Name);
  return Folders;
}

PicturePlaces findPictures(const std::vector<fs::path> &Folders,
                           const std::vector<std::string> &Names,
                           std::vector<std::string> &Notes) {
  for (const fs::path &Folder : Folders) {
    if (!fileExists(Folder))
      continue;
    MatchedPictures M = matchPictures(Folder, Names);
    if (M.Found == 0)
      continue;
    if (&Folder != &Folders.front())
      Notes.push_back("pictures in " +
                      escaped(Folder.lexically_normal().string()));
    Notes.insert(Notes.end(), M.Notes.begin(), M.Notes.end());
    return {Folder, std::move(M.Files)};
  }
  PicturePlaces Missing{Folders.front(), {}};
  for (const std::string &Name : Names)
    Missing.Files.push_back(pictureOf(Folders.front(), Name));
  return Missing;
}

std::optional<Location> findCameras(const fs::path &Path) {
  auto F = findCapture(Path, /*NeedsPictures=*/false);
  if (!F && (Path.extension() == ".bin" || Path.extension() == ".txt"))
    F = findCapture(Path.has_parent_path() ? Path.parent_path() : fs::path("."),
                    /*NeedsPictures=*/false);
  return F;
}

fs::path pictureOf(const fs::path &Folder, const std::string &Name) {
  if (fs::path P = Folder / Name; fileExists(P))
    return P;
  for (const char *Ending : PictureEndings)
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
