#include "capture/Capture.h"

#include "capture/Colmap.h"
#include "capture/Photo.h"
#include "capture/Transforms.h"
#include "io/Inside.h"
#include "vorion/support/File.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <ranges>
#include <set>

namespace vorion::splat {
namespace {

namespace fs = std::filesystem;

bool fileExists(const fs::path &P) {
  std::error_code Ignored;
  return fs::exists(P, Ignored);
}

/// What is at a path, and where its files are.
struct Location {
  CaptureFormat Format = CaptureFormat::ColmapBinary;
  fs::path Model;    ///< folder of COLMAP's files, or the file of transforms
  fs::path Pictures; ///< folder that pictures' names start from
};

std::optional<Location> find(const fs::path &Path) {
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

/// The same where \p Path may be one of COLMAP's files.
std::optional<Location> findCameras(const fs::path &Path) {
  auto F = find(Path);
  if (!F && (Path.extension() == ".bin" || Path.extension() == ".txt"))
    F = find(Path.has_parent_path() ? Path.parent_path() : fs::path("."));
  return F;
}

/// The picture called \p Name, whose ending may be missing.
fs::path pictureOf(const fs::path &Folder, const std::string &Name) {
  for (const char *Ending : {"", ".png", ".jpg", ".jpeg", ".webp"})
    if (fs::path P = Folder / (Name + Ending); fileExists(P))
      return P;
  return Folder / Name;
}

/// That \p Name, which \p File gives, leaves the folder it starts from; \p
/// Remedy: what would help.
Error isOutside(const std::string &File, const std::string &Name,
                std::string_view Remedy) {
  return {File, fmt::format("names the file `{}`, expected one inside the "
                            "folder, or {}",
                            printable(Name), Remedy)};
}

/// That it does not, unless \p Options allow it.
Expected<Success> checkInside(const std::string &File, const std::string &Name,
                              const CaptureOptions &Options) {
  if (Options.AllowOutside || staysInside(Name))
    return Success{};
  return isOutside(File, Name, "--allow-outside");
}

/// Of the picture \p Name, in the folder \p Masks; empty for none.
std::string maskOf(const fs::path &Masks, const fs::path &Name) {
  fs::path Png = Name;
  for (const fs::path &File :
       {fs::path(Name.string() + ".png"), Name, Png.replace_extension(".png")})
    if (fileExists(Masks / File))
      return (Masks / File).string();
  return {};
}

/// Takes those without a picture out of \p Views, and counts them in \p C.
template <typename View>
void leaveOutMissing(std::vector<View> &Views, Capture &C) {
  C.WithoutPicture += std::erase_if(
      Views, [](const View &V) { return !fileExists(V.Picture); });
}

/// The same, where some picture must be there.
template <typename View>
Expected<Success> leaveOutSome(std::vector<View> &Views, Capture &C) {
  const std::string First = Views.front().Picture;
  leaveOutMissing(Views, C);
  if (Views.empty())
    return Error{First, "no such picture, nor any other of the capture's, "
                        "expected photographs there"};
  return Success{};
}

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
    auto Content = readFile(Parts[I].To.Where);
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

Expected<Success> readColmap(const Location &F, const CaptureOptions &Options,
                             Capture &C) {
  auto Read = readModel(F, /*PosesOnly=*/false);
  if (!Read)
    return Read.error();
  C.Views = std::move(Read->Model.Views);
  C.Points = std::move(Read->Model.Points);
  for (CaptureView &V : C.Views) {
    if (auto Inside = checkInside(Read->Images, V.Pose.Name, Options); !Inside)
      return Inside;
    V.Picture = (F.Pictures / V.Pose.Name).string();
    if (Options.Masks == MaskSource::Files)
      V.Mask = maskOf(F.Pictures.parent_path() / "masks", V.Pose.Name);
  }
  return leaveOutSome(C.Views, C);
}

/// Completes views whose size the file does not say.
Expected<Success> setSizes(TransformsFile &T) {
  std::optional<PhotoSize> Size;
  for (TransformsView &V : T.Views) {
    if (V.hasSize())
      continue;
    // All of a file are of one size; the first says which.
    if (!Size) {
      const auto Picture = readFile(V.Picture);
      if (!Picture)
        return Picture.error();
      const auto Read = photoSize(V.Picture, *Picture);
      if (!Read)
        return Read.error();
      Size = *Read;
    }
    V.Pose.Width = Size->Width;
    V.Pose.Height = Size->Height;
    complete(V.Pose, V.Known);
  }
  return Success{};
}

/// Adds the camera of \p V, which \p File has.
Expected<Success> addCamera(const std::string &File, CaptureView V, LensOf Of,
                            CaptureCameras &To) {
  V.Pose.Id = static_cast<int>(To.Cameras.size());
  // A sphere has no pinhole's picture.
  if (Of == LensOf::Photograph ||
      V.Optics.Model == LensModel::Equirectangular) {
    V.Pose.Optics = V.Optics;
    if (!std::ranges::all_of(V.Optics.K, [](double K) {
          return std::abs(K) <= MostLensCoefficient;
        }))
      return Error{File,
                   fmt::format("view {} has a lens with coefficients "
                               "beyond {:g}, expected smaller ones",
                               printable(V.Pose.Name), MostLensCoefficient)};
  }
  To.Cameras.push_back(std::move(V.Pose));
  return Success{};
}

Expected<TransformsFile> transformsOf(const fs::path &File) {
  const auto Content = readFile(File.string());
  if (!Content)
    return Content.error();
  return parseTransforms(File.string(), *Content);
}

/// Adds the cameras of \p File; of a test set those without a picture, too.
Expected<Success> addPoses(const fs::path &File, LensOf Of,
                           CaptureCameras &To) {
  auto T = transformsOf(File);
  if (!T)
    return T.error();
  const fs::path Folder = File.parent_path();
  for (TransformsView &V : T->Views) {
    // Nothing outside the folder is opened for a size. Who draws has no
    // --allow-outside.
    if (!staysInside(V.Pose.Name) && !V.hasSize())
      return isOutside(File.string(), V.Pose.Name, "the keys w and h");
    V.Picture = pictureOf(Folder, V.Pose.Name).string();
  }
  if (auto Sized = setSizes(*T); !Sized)
    return Sized;
  for (TransformsView &V : T->Views)
    if (auto Added = addCamera(File.string(), std::move(V), Of, To); !Added)
      return Added;
  To.Files.push_back(File.string());
  return Success{};
}

/// Adds COLMAP's files, and what they name as far as they can be read.
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

/// Adds \p File, and what it names as far as it can be read.
void addTransformsFiles(const fs::path &File, std::vector<fs::path> &To) {
  To.push_back(File);
  std::error_code Ignored;
  if (!fs::is_regular_file(File, Ignored)) // a pipe can be read only once
    return;
  const auto T = transformsOf(File);
  if (!T)
    return;
  const fs::path Folder = File.parent_path();
  for (const TransformsView &V : T->Views) {
    const fs::path Picture = pictureOf(Folder, V.Pose.Name);
    To.push_back(Picture);
    To.push_back(V.Mask.empty()
                     ? fs::path(maskOf(Folder / "masks", Picture.filename()))
                     : Folder / V.Mask);
  }
  if (!T->Points.empty())
    To.push_back(Folder / T->Points);
}

/// Whether a pinhole's picture can be made of that of \p V, if one is wanted.
Expected<Success> checkPinhole(const std::string &File, const CaptureView &V,
                               const CaptureOptions &Options) {
  if (Options.Pictures == LensOf::Photograph)
    return Success{};
  if (V.Optics.Model == LensModel::Equirectangular)
    return Error{
        File, fmt::format("frame {} has the camera model EQUIRECTANGULAR, of "
                          "which there is no pinhole's picture, expected "
                          "photographs of perspective or fisheye cameras, "
                          "or --distorted",
                          printable(V.Pose.Name))};
  if (V.Optics.Shutter)
    return Error{File,
                 fmt::format("frame {} has a rolling shutter, of which there "
                             "is no pinhole's picture, expected photographs of "
                             "one moment each (without the key rolling_shutter "
                             "the first pose counts), or --distorted",
                             printable(V.Pose.Name))};
  return Success{};
}

/// Which set of a capture a file of transforms has.
enum class ViewSet { All, Train, Test };

/// Adds the views of \p File; those without a size get their picture's.
Expected<Success> readTransforms(const fs::path &File, ViewSet Set,
                                 const CaptureOptions &Options, Capture &C) {
  auto T = transformsOf(File);
  if (!T)
    return T.error();
  const fs::path Folder = File.parent_path();
  for (TransformsView &V : T->Views) {
    if (auto Straight = checkPinhole(File.string(), V, Options); !Straight)
      return Straight;
    if (auto Inside = checkInside(File.string(), V.Pose.Name, Options); !Inside)
      return Inside;
    V.Picture = pictureOf(Folder, V.Pose.Name).string();
    if (Options.Masks != MaskSource::Files) {
      V.Mask.clear();
    } else if (V.Mask.empty()) {
      V.Mask = maskOf(Folder / "masks", fs::path(V.Picture).filename());
    } else {
      if (auto Inside = checkInside(File.string(), V.Mask, Options); !Inside)
        return Inside;
      V.Mask = (Folder / V.Mask).string();
    }
  }
  // A test set is often passed on without its pictures.
  if (Set == ViewSet::Test)
    leaveOutMissing(T->Views, C);
  else if (auto Left = leaveOutSome(T->Views, C); !Left)
    return Left;
  if (auto Sized = setSizes(*T); !Sized)
    return Sized;
  if (Set == ViewSet::All &&
      std::ranges::any_of(T->Views, &TransformsView::HeldOut))
    C.HeldOutBy = "val_filenames and test_filenames";
  if (Set == ViewSet::Test && !T->Views.empty())
    C.HeldOutBy = File.filename().string();
  for (TransformsView &V : T->Views) {
    V.HeldOut = Set == ViewSet::Test || (Set == ViewSet::All && V.HeldOut);
    C.Views.push_back(std::move(V));
  }
  if (T->Points.empty())
    return Success{};
  if (auto Inside = checkInside(File.string(), T->Points, Options); !Inside)
    return Inside;
  const std::string Points = (Folder / T->Points).string();
  const auto Cloud = readFile(Points);
  if (!Cloud)
    return Cloud.error();
  auto Parsed = parsePointCloud(Points, *Cloud);
  if (!Parsed)
    return Parsed.error();
  C.Points = std::move(*Parsed);
  return Success{};
}

/// 1st, 2nd, 3rd, 4th.
std::string ordinal(unsigned N) {
  const bool Teens = N % 100 > 10 && N % 100 < 14;
  const unsigned Last = Teens ? 0 : N % 10;
  return fmt::format("{}{}", N,
                     Last == 1   ? "st"
                     : Last == 2 ? "nd"
                     : Last == 3 ? "rd"
                                 : "th");
}

/// Holds out every \p Every-th view, or none.
void holdOut(Capture &C, unsigned Every) {
  for (std::size_t I = 0; I < C.Views.size(); ++I)
    C.Views[I].HeldOut = Every != 0 && I % Every == 0;
  C.HeldOutBy = Every == 0 ? "none, as asked"
                           : fmt::format("every {} by name", ordinal(Every));
}

/// What the options ask of masks.
Expected<Success> checkMasks(const std::string &Path, const Capture &C,
                             const CaptureOptions &Options) {
  if (Options.Masks == MaskSource::Files && C.masked() == 0)
    return Error{Path, "no masks, expected masks/NAME.png for the picture "
                       "NAME, or mask_path in the frames"};
  return Success{};
}

/// Whether the user means \p Name by \p Wanted.
bool matchesName(const std::string &Name, const std::string &Wanted) {
  const fs::path Path(Name);
  return Name == Wanted || Path.filename() == Wanted || Path.stem() == Wanted ||
         // Synthetic captures name pictures without their ending.
         (!Path.has_extension() && Path.filename() == fs::path(Wanted).stem());
}

Expected<Success> exclude(const std::string &Path, Capture &C,
                          const std::vector<std::string> &Names) {
  for (const std::string &Name : Names)
    if (std::erase_if(C.Views, [&](const CaptureView &V) {
          return matchesName(V.Pose.Name, Name);
        }) == 0) {
      const auto Known = std::views::transform(
          C.Views, [](const CaptureView &V) { return V.Pose.Name; });
      return Error{Path,
                   fmt::format("no picture {} to exclude, expected one of the "
                               "capture's{}",
                               Name, didYouMean(Name, Known)),
                   ExitCode::Usage};
    }
  if (C.Views.size() < 2)
    return Error{Path, fmt::format("{}, expected at least two",
                                   counted(C.Views.size(), "view"))};
  return Success{};
}

/// That no two of \p Views are the same picture, under whatever names: it would
/// be trained on several times, and take that much memory.
Expected<Success> checkOnce(const std::string &Path,
                            const std::vector<CaptureView> &Views) {
  std::set<std::string> Pictures;
  for (const CaptureView &V : Views)
    if (!Pictures.insert(fs::path(V.Picture).lexically_normal().string())
             .second)
      return Error{Path, fmt::format("picture {} is there twice, expected it "
                                     "once",
                                     printable(V.Pose.Name))};
  return Success{};
}

Expected<Success> checkPicture(const CaptureView &V) {
  const auto File = readFile(V.Picture);
  if (!File)
    return File.error();
  const auto Size = photoSize(V.Picture, *File);
  if (!Size)
    return Size.error();
  if (Size->Width != V.Pose.Width || Size->Height != V.Pose.Height)
    return Error{V.Picture,
                 fmt::format("{}x{} pixels, expected {}x{} as its camera says",
                             Size->Width, Size->Height, V.Pose.Width,
                             V.Pose.Height)};
  return Success{};
}

} // namespace

std::string_view name(CaptureFormat F) {
  constexpr std::array<std::string_view, 4> Names{
      "colmap-text", "colmap-binary", "nerf-synthetic", "transforms"};
  return Names[static_cast<std::size_t>(F)];
}

std::size_t Capture::heldOut() const {
  return static_cast<std::size_t>(
      std::ranges::count(Views, true, &CaptureView::HeldOut));
}

std::size_t Capture::masked() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      Views, [](const CaptureView &V) { return !V.Mask.empty(); }));
}

std::size_t Capture::distorted() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(Views, [](const CaptureView &V) {
        return !V.Optics.isPinhole() || V.Optics.Shutter;
      }));
}

std::size_t Capture::photographsAlone() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(Views, [](const CaptureView &V) {
        return V.Optics.Model == LensModel::Equirectangular || V.Optics.Shutter;
      }));
}

CameraRing cameraRing(const Capture &C) {
  CameraRing Ring;
  double Count = 0;
  for (const CaptureView &V : C.Views)
    if (!V.HeldOut) {
      Count += 1;
      for (std::size_t K = 0; K < 3; ++K)
        Ring.Centre[K] += V.Pose.Position[K];
    }
  for (double &V : Ring.Centre)
    V /= Count;
  for (const CaptureView &V : C.Views)
    if (!V.HeldOut) {
      double Squares = 0;
      for (std::size_t K = 0; K < 3; ++K) {
        const double D = V.Pose.Position[K] - Ring.Centre[K];
        Squares += D * D;
      }
      Ring.Radius = std::max(Ring.Radius, std::sqrt(Squares));
    }
  // Poses that are the same differ by the rounding of their inverses.
  const auto [X, Y, Z] = Ring.Centre;
  if (Ring.Radius <=
      std::numeric_limits<float>::epsilon() * std::hypot(X, Y, Z))
    Ring.Radius = 0;
  return Ring;
}

bool isCapture(const std::string &Path) {
  return find(Path).has_value() &&
         (!Path.ends_with(".json") ||
          fs::path(Path).filename().string().starts_with("transforms"));
}

static Error noCapture(const std::string &Path) {
  std::error_code Ignored;
  const char *Why = !fileExists(Path)                 ? ": no such folder"
                    : fs::is_directory(Path, Ignored) ? ""
                                                      : ": not a folder";
  return {Path, fmt::format("no capture{}, expected a folder with COLMAP's "
                            "sparse/0/cameras.bin or .txt, "
                            "transforms_train.json or transforms.json",
                            Why)};
}

Expected<CaptureCameras> readCaptureCameras(const std::string &Path,
                                            LensOf Of) {
  const auto F = findCameras(Path);
  if (!F)
    return noCapture(Path);
  CaptureCameras C;
  C.Format = F->Format;
  if (F->Format == CaptureFormat::ColmapText ||
      F->Format == CaptureFormat::ColmapBinary) {
    auto Read = readModel(*F, /*PosesOnly=*/true);
    if (!Read)
      return Read.error();
    for (CaptureView &V : Read->Model.Views)
      if (auto Added = addCamera(Read->Cameras, std::move(V), Of, C); !Added)
        return Added.error();
    C.Files = {Read->Cameras, Read->Images};
  } else {
    const fs::path Test = fs::path(Path) / "transforms_test.json";
    auto Added = addPoses(F->Model, Of, C);
    if (Added && F->Format == CaptureFormat::NerfSynthetic && fileExists(Test))
      Added = addPoses(Test, Of, C);
    if (!Added)
      return Added.error();
  }
  std::ranges::sort(C.Cameras, {}, &Camera::Name);
  return C;
}

std::vector<std::string> captureFiles(const std::string &Path) {
  const auto F = findCameras(Path);
  if (!F)
    return {Path};
  std::vector<fs::path> Files;
  if (F->Format == CaptureFormat::ColmapText ||
      F->Format == CaptureFormat::ColmapBinary) {
    addColmapFiles(*F, Files);
  } else {
    addTransformsFiles(F->Model, Files);
    if (F->Format == CaptureFormat::NerfSynthetic)
      addTransformsFiles(fs::path(Path) / "transforms_test.json", Files);
  }
  std::vector<std::string> Named;
  for (const fs::path &File : Files)
    if (fileExists(File))
      Named.push_back(File.string());
  return Named;
}

Expected<Capture> readCapture(const std::string &Path,
                              const CaptureOptions &Options) {
  const auto F = find(Path);
  if (!F)
    return noCapture(Path);
  Capture C;
  C.Format = F->Format;
  const fs::path Test = fs::path(Path) / "transforms_test.json";
  const bool OwnTest =
      F->Format == CaptureFormat::NerfSynthetic && fileExists(Test);
  Expected<Success> Read = Success{};
  if (F->Format == CaptureFormat::ColmapText ||
      F->Format == CaptureFormat::ColmapBinary)
    Read = readColmap(*F, Options, C);
  else
    Read = readTransforms(F->Model, OwnTest ? ViewSet::Train : ViewSet::All,
                          Options, C);
  if (Read && OwnTest)
    Read = readTransforms(Test, ViewSet::Test, Options, C);
  if (Read)
    Read = exclude(Path, C, Options.Exclude);
  if (Read)
    Read = checkMasks(Path, C, Options);
  if (!Read)
    return Read.error();

  std::ranges::sort(C.Views, {}, [](const CaptureView &V) -> const auto & {
    return V.Pose.Name;
  });
  if (auto Once = checkOnce(Path, C.Views); !Once)
    return Once.error();
  if (Options.HoldOut || C.HeldOutBy.empty())
    holdOut(C, Options.HoldOut.value_or(HoldOutEvery));
  if (C.heldOut() == C.Views.size())
    return Options.HoldOut == 1U
               ? Error{Path,
                       "--hold-out 1 leaves no view to train on, expected 0 "
                       "for none, or 2 and more",
                       ExitCode::Usage}
               : Error{Path, "no view to train on, expected at least one"};
  for (const CaptureView &V : C.Views)
    if (auto Good = checkPicture(V); !Good)
      return Good.error();
  return C;
}

} // namespace vorion::splat
