#include "capture/CaptureFiles.h"
#include "capture/ColmapRecords.h"
#include "commands/Commands.h"
#include "commands/Progress.h"
#include "io/PhotoFile.h"
#include "poses/Colmap.h"
#include "poses/Video.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"
#include "vorion/support/StatusLine.h"
#include "vorion/support/Terminal.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace vorion::splat {

namespace {

namespace fs = std::filesystem;

struct CaptureArguments {
  std::string Input, Output, Masks, Model;
  std::size_t Frames = 150;
  bool CamerasDiffer = false;
};

/// The pictures of a new capture, in its images/.
struct Pictures {
  std::vector<std::string> Names; ///< sorted
  std::size_t Masks = 0;
  PhotoSize Size;      ///< of the first
  bool OneSize = true; ///< all have it
  bool OfVideo = false;
};

/// Files that are no photographs, as ".heic 3, .txt 1".
std::string otherFiles(const std::map<std::string, std::size_t> &Others) {
  std::vector<std::string> Each;
  Each.reserve(Others.size());
  for (const auto &[Ending, Count] : Others)
    Each.push_back(fmt::format("{} {}", escaped(Ending), Count));
  return fmt::format("{}", fmt::join(Each, ", "));
}

/// The photographs in \p Folder and its sub-folders, sorted by name, without
/// masks.
Expected<std::vector<std::string>> photographsIn(const fs::path &Folder,
                                                 const fs::path &Masks) {
  std::vector<std::string> Names;
  std::map<std::string, std::size_t> Others;
  std::error_code Failed;
  for (fs::recursive_directory_iterator It(Folder, Failed);
       !Failed && It != fs::recursive_directory_iterator();
       It.increment(Failed)) {
    std::error_code Ignored;
    const fs::path &Path = It->path();
    if (Path.filename().string().starts_with(".") ||
        fs::equivalent(Path, Masks, Ignored)) {
      It.disable_recursion_pending();
      continue;
    }
    if (!It->is_regular_file(Ignored))
      continue;
    if (isPictureName(Path))
      Names.push_back(Path.lexically_relative(Folder).string());
    else
      ++Others[lowerCase(Path.extension().string())];
  }
  if (Failed)
    return Error{Folder.string(), fmt::format("cannot read: {}, expected a "
                                              "folder of photographs",
                                              Failed.message())};
  if (Names.empty())
    return Error{
        Folder.string(),
        fmt::format("no photographs{}, expected .jpg, .png or .webp",
                    Others.empty() ? "" : ", but " + otherFiles(Others))};
  if (!Others.empty())
    printDiagnostic("splat", "note", Folder.string(),
                    fmt::format("other files are not used ({}), expected .jpg, "
                                ".png or .webp",
                                otherFiles(Others)));
  std::ranges::sort(Names);
  return Names;
}

/// Copies \p From to \p To unless that has the same size already. The copy is
/// complete or missing.
Expected<Success> copyFile(const fs::path &From, const fs::path &To) {
  std::error_code Failed;
  if (fs::exists(To, Failed) &&
      (fs::equivalent(From, To, Failed) ||
       fs::file_size(From, Failed) == fs::file_size(To, Failed)))
    return Success{};
  const fs::path Part = To.parent_path() / ".part";
  fs::create_directories(To.parent_path(), Failed);
  fs::copy_file(From, Part, fs::copy_options::overwrite_existing, Failed);
  if (!Failed)
    fs::rename(Part, To, Failed);
  if (Failed)
    return Error{To.string(),
                 fmt::format("cannot copy {}: {}, expected a "
                             "writable folder with enough space",
                             escaped(From.string()), Failed.message())};
  return Success{};
}

/// Checks that each picture can be read, and compares their sizes.
Expected<Success> measure(const fs::path &Images, Pictures &P) {
  for (const std::string &Name : P.Names) {
    const std::string File = (Images / Name).string();
    const auto Bytes = readFile(File);
    if (!Bytes)
      return Bytes.error();
    const auto Size = photoSize(File, *Bytes);
    if (!Size)
      return Size.error();
    if (Name == P.Names.front())
      P.Size = *Size;
    P.OneSize = P.OneSize && Size->Width == P.Size.Width &&
                Size->Height == P.Size.Height;
  }
  return Success{};
}

/// Checks that images/ has no pictures of something else.
Expected<Success> checkOwn(const CaptureArguments &A,
                           const std::vector<std::string> &Names) {
  const fs::path Images = fs::path(A.Output) / "images";
  std::error_code Ignored;
  if (!fs::exists(Images, Ignored))
    return Success{};
  const std::set<std::string> Known(Names.begin(), Names.end());
  for (const auto &Entry : fs::recursive_directory_iterator(Images, Ignored)) {
    const std::string Name = Entry.path().lexically_relative(Images).string();
    if (isPictureName(Entry.path()) && !Entry.is_directory(Ignored) &&
        !Known.contains(Name))
      return Error{Entry.path().string(),
                   fmt::format("not a picture of {}, expected a new folder, or "
                               "that of an earlier run with the same input",
                               escaped(A.Input))};
  }
  return Success{};
}

Expected<Pictures> takePhotographs(const CaptureArguments &A) {
  const fs::path Masks =
      A.Masks.empty() ? fs::path(A.Input) / "masks" : fs::path(A.Masks);
  const auto Names = photographsIn(A.Input, Masks);
  if (!Names)
    return Names.error();
  if (auto Own = checkOwn(A, *Names); !Own)
    return Own.error();
  Pictures P{*Names, 0, {}};
  const fs::path To(A.Output);
  for (const std::string &Name : P.Names) {
    if (auto Copied = copyFile(fs::path(A.Input) / Name, To / "images" / Name);
        !Copied)
      return Copied.error();
    const std::string Mask = maskOf(Masks, Name);
    if (Mask.empty())
      continue;
    if (auto Copied = copyFile(Mask, To / "masks" / (Name + ".png")); !Copied)
      return Copied.error();
    ++P.Masks;
  }
  if (!A.Masks.empty() && P.Masks == 0)
    return Error{A.Masks,
                 fmt::format("no mask of a photograph, expected {}.png",
                             escaped(P.Names.front()))};
  return P;
}

/// The frames of earlier runs, if they are of the same video.
Expected<Pictures> takeFrames(const CaptureArguments &A) {
  const fs::path Folder(A.Output), Images = Folder / "images",
                                   Stamp = Folder / "colmap" / "frames.txt";
  std::error_code Failed;
  fs::create_directories(Images, Failed);
  fs::create_directories(Stamp.parent_path(), Failed);
  const std::string Made = fmt::format(
      "{} of {} bytes, --frames {}\n", fs::path(A.Input).filename().string(),
      fs::file_size(A.Input, Failed), A.Frames);
  Pictures P;
  P.OfVideo = true;
  const auto Kept = readFile(Stamp.string());
  const bool IsMade =
      Kept && std::string(reinterpret_cast<const char *>(Kept->data()),
                          Kept->size()) == Made;
  if (!IsMade) {
    if (auto Own = checkOwn(A, {}); !Own)
      return Own.error();
    const auto Show = progressOfParts("frames");
    const auto Measured =
        measureVideo(A.Input, [&Show](std::size_t Frame) { Show(Frame, 0); });
    clearStatus();
    if (!Measured)
      return Measured.error();
    const ChosenFrames Chosen = chooseFrames(*Measured, A.Frames);
    if (auto Written = extractFrames(A.Input, Chosen.Frames, Images.string());
        !Written)
      return Written.error();
    printOut("frames       {} of {}: the sharpest of equal spans{}\n",
             Chosen.Frames.size(), Measured->size(),
             Chosen.Still == 0
                 ? ""
                 : fmt::format("; {} in which nothing moves {} skipped",
                               counted(Chosen.Still, "span"),
                               Chosen.Still == 1 ? "is" : "are"));
    if (auto Written = writeFileAtomically(Stamp.string(), Made); !Written)
      return Written.error();
  }
  for (const auto &Entry : fs::directory_iterator(Images, Failed))
    if (isPictureName(Entry.path()))
      P.Names.push_back(Entry.path().filename().string());
  std::ranges::sort(P.Names);
  return P;
}

Expected<Success> check(const CaptureArguments &A) {
  std::error_code Ignored;
  const fs::path To = fs::weakly_canonical(A.Output, Ignored),
                 From = fs::weakly_canonical(A.Input, Ignored);
  const auto [Rest, _] = std::ranges::mismatch(From, To);
  if (Rest == From.end())
    return Error{
        "",
        fmt::format("-o {}: in the folder of the photographs, expected "
                    "another folder",
                    escaped(A.Output)),
        ExitCode::Usage};
  if (!fs::is_directory(From, Ignored)) {
    if (!fs::exists(From, Ignored))
      return Error{A.Input, "no such file or folder, expected a folder of "
                            "photographs or a video"};
    if (isPictureName(From))
      return otherKindAt(A.Input, "a folder of photographs or a video", "");
    if (!A.Masks.empty())
      return Error{"",
                   "--masks are those of photographs, expected a folder of "
                   "photographs",
                   ExitCode::Usage};
  }
  return Success{};
}

/// The line about the pictures and their cameras.
std::string picturesText(const Pictures &P, bool OneLens,
                         const std::string &Model) {
  return fmt::format(
      "pictures     {}, {}{}x{}; {} {}{}\n", counted(P.Names.size(), "picture"),
      P.OneSize ? "" : "of several sizes, the first ", P.Size.Width,
      P.Size.Height, OneLens ? "one camera" : "a camera each", Model,
      P.Masks == 0 ? "" : "; " + counted(P.Masks, "mask"));
}

Expected<Success> run(const CaptureArguments &A) {
  if (auto Checked = check(A); !Checked)
    return Checked;
  std::error_code Ignored;
  auto Taken =
      fs::is_directory(A.Input, Ignored) ? takePhotographs(A) : takeFrames(A);
  if (!Taken)
    return Taken.error();
  Pictures &P = *Taken;
  if (auto Measured = measure(fs::path(A.Output) / "images", P); !Measured)
    return Measured;
  constexpr std::size_t Fewest = 3, MostExhaustive = 200;
  if (P.Names.size() < Fewest)
    return Error{A.Input,
                 fmt::format("{}, expected at least {}: poses follow "
                             "from what several pictures show",
                             counted(P.Names.size(), "picture"), Fewest)};
  const bool OneLens = P.OneSize && !A.CamerasDiffer;
  const std::string Model = !A.Model.empty() ? A.Model
                            : OneLens        ? "OPENCV"
                                             : "SIMPLE_RADIAL";
  printOut("{}", picturesText(P, OneLens, Model));

  std::string Last;
  std::function<void(std::size_t, std::size_t)> Show;
  const PoseProgress Progress = [&](std::string_view Step, std::size_t Done,
                                    std::size_t All) {
    if (Last != Step) {
      Last = Step;
      Show = progressOfParts(Last);
    }
    Show(Done, All);
  };
  const PoseRequest Request{
      A.Output, P.Names, P.Masks > 0,
      Model,    OneLens, P.OfVideo && P.Names.size() > MostExhaustive};
  auto Found = findPoses(Request, Progress);
  clearStatus();
  if (!Found)
    return Found;
  const auto Models = posedModels(A.Output);
  if (!Models)
    return Models.error();
  printOut("{}next         splat train {} -o scene.ply{}\n",
           judgePoses(*Models, P.Names), escaped(A.Output),
           P.Masks == 0 ? "" : " --masks files");
  return Success{};
}

/// COLMAP's camera models that splat reads.
std::vector<std::string> knownModels() {
  std::vector<std::string> Names;
  for (const ColmapCameraModel &M : colmapCameraModels())
    if (M.Lens)
      Names.emplace_back(M.Name);
  return Names;
}

} // namespace

Runner addCapture(CLI::App &App) {
  auto A = std::make_shared<CaptureArguments>();
  takesFile(App.add_option("input", A->Input,
                           "Folder of photographs (.jpg, .png, .webp), or a "
                           "video"))
      ->required();
  writesFolder(App.add_option("-o,--output", A->Output,
                              "Folder of the capture; that of an interrupted "
                              "run is continued"))
      ->required();
  App.add_option("--frames", A->Frames,
                 "Number of frames to use of a video (default 150)")
      ->check(isBetween(3, 5000));
  takesFolder(App.add_option("--masks", A->Masks,
                             "Folder of masks, NAME.png for the photograph "
                             "NAME; black pixels are not used (default: masks "
                             "in the folder of the photographs)"));
  App.add_option("--camera-model", A->Model,
                 "COLMAP's camera model, such as SIMPLE_RADIAL or "
                 "OPENCV_FISHEYE (default: OPENCV for one camera, "
                 "SIMPLE_RADIAL for several)")
      ->check(isOneOf(knownModels()))
      ->option_text("MODEL");
  App.add_flag("--cameras-differ", A->CamerasDiffer,
               "Give each picture a camera of its own, for zoom lenses and "
               "several cameras (default: one camera if all pictures have the "
               "same size)");
  return [A](const DeviceOptions &) { return run(*A); };
}

} // namespace vorion::splat
