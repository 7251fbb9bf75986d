#include "poses/Colmap.h"

#include "capture/Capture.h"
#include "io/Hash.h"
#include "study/PointStore.h"
#include "study/Process.h"
#include "vorion/support/File.h"
#include "vorion/support/HostMemory.h"
#include "vorion/support/HostProcessors.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

namespace vorion::splat {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

Expected<std::string> findColmap() {
  return findProgram("colmap", "finds the poses of photographs");
}

std::string textOf(const std::string &File) {
  const auto Bytes = readFile(File);
  return Bytes ? std::string(reinterpret_cast<const char *>(Bytes->data()),
                             Bytes->size())
               : std::string();
}

/// The number at the begin of \p Text.
template <typename Number>
std::optional<Number> numberAt(std::string_view Text) {
  Number Value{};
  return std::from_chars(Text.data(), Text.data() + Text.size(), Value).ec ==
                 std::errc()
             ? std::optional(Value)
             : std::nullopt;
}

/// The number behind the last \p Mark of \p Text.
template <typename Number>
std::optional<Number> numberBehind(std::string_view Text,
                                   std::string_view Mark) {
  const std::size_t At = Text.rfind(Mark);
  if (At == std::string_view::npos)
    return std::nullopt;
  return numberAt<Number>(trimmed(Text.substr(At + Mark.size())));
}

/// How far a step is, by a line of COLMAP's output: the parts that are begun.
using Counter = std::optional<std::size_t> (*)(std::string_view Line);

std::optional<std::size_t> featuresIn(std::string_view Line) {
  return numberBehind<std::size_t>(Line, "Processed file [");
}

/// "Matching block [2/3, 1/3]" or "Matching image [5/30]".
std::optional<std::size_t> matchesIn(std::string_view Line) {
  const auto Row = numberBehind<std::size_t>(Line, "Matching block [");
  if (!Row)
    return numberBehind<std::size_t>(Line, "Matching image [");
  const auto Rows =
      numberBehind<std::size_t>(Line.substr(0, Line.find(',')), "/");
  const auto Column = numberBehind<std::size_t>(Line, ", ");
  return Rows && Column ? std::optional((*Row - 1) * *Rows + *Column)
                        : std::nullopt;
}

/// "Registering image #12 (5)", of later versions "(num_reg_frames=5)".
std::optional<std::size_t> registeredIn(std::string_view Line) {
  if (Line.find("Registering image") == std::string_view::npos)
    return std::nullopt;
  const auto Count = numberBehind<std::size_t>(Line, "=");
  return Count ? Count : numberBehind<std::size_t>(Line, "(");
}

/// A step of COLMAP.
struct Step {
  const char *Command;
  const char *Name; ///< for users
  Words Arguments;
  Counter Count;
  std::size_t All; ///< parts; 0 if unknown
};

/// Reads the lines that are appended to a log.
class Follower {
public:
  Follower(const std::string &Log, Counter Count) : File(Log), Count(Count) {}

  /// The parts that are done by the lines so far.
  std::size_t done() {
    File.clear();
    for (std::string Part; std::getline(File, Part);) {
      Line += Part;
      if (File.eof()) // the line is not complete
        break;
      Done = Count(Line).value_or(Done);
      Line.clear();
    }
    return Done;
  }

private:
  std::ifstream File;
  Counter Count;
  std::string Line;
  std::size_t Done = 0;
};

/// Names and bytes, sorted.
using PictureSizes = std::vector<std::pair<std::string, uint64_t>>;

/// COLMAP's work in a capture's folder.
class Work {
public:
  Work(const PoseRequest &R, const PoseProgress &Progress)
      : R(R), Progress(Progress), Folder(fs::path(R.Folder) / "colmap") {}

  Expected<Success> run();

private:
  std::string in(const char *Name) const { return (Folder / Name).string(); }
  /// Text that changes with what a step depends on.
  std::string settings() const;
  PictureSizes pictures() const;
  Expected<Success> begin();
  const std::string &helpOf(const char *Command);
  Words processorArguments(const char *Command, const char *Old,
                           const char *New, unsigned Threads = 0);
  Expected<Success> call(const char *Command, Words Arguments,
                         const std::string &Log,
                         const std::function<bool()> &Poll = {}) const;
  bool isDone(const char *Command) const {
    const Json &Done = State.at("done");
    return std::ranges::find(Done, Json(Command)) != Done.end();
  }
  Expected<Success> take(const Step &S);
  Expected<Success> keep() const {
    return writeFileAtomically(in("state.json"), jsonText(State, 2) + "\n");
  }

  const PoseRequest &R;
  const PoseProgress &Progress;
  fs::path Folder;
  std::string Program;
  Json State = Json::object();
  std::map<std::string, std::string> Helps; ///< of commands
};

std::string Work::settings() const {
  return fmt::format("{} {}{}", R.Lens, R.OneLens ? "one" : "each",
                     R.HasMasks ? " masks" : "");
}

PictureSizes Work::pictures() const {
  PictureSizes Sizes;
  for (const std::string &Name : R.Pictures) {
    std::error_code Ignored;
    Sizes.emplace_back(
        Name, fs::file_size(fs::path(R.Folder) / "images" / Name, Ignored));
  }
  return Sizes;
}

/// Reads what earlier runs have done. A database of other settings or of
/// pictures that have changed is of no use.
Expected<Success> Work::begin() {
  std::error_code Failed;
  fs::create_directories(Folder, Failed);
  if (fs::exists(in("state.json"))) {
    auto Read = readOwnJson(in("state.json"));
    if (!Read)
      return Read.error();
    State = std::move(*Read);
  }
  const PictureSizes Now = pictures(),
                     Before = State.value("pictures", PictureSizes{});
  if (State.value("settings", "") != settings() ||
      !std::ranges::includes(Now, Before))
    for (const char *Suffix : {"", "-wal", "-shm", "-journal"})
      fs::remove(in("database.db") + Suffix, Failed);
  if (State.value("settings", "") != settings() || Now != Before)
    State["done"] = Json::array();
  State["settings"] = settings();
  State["pictures"] = Now;
  return keep();
}

/// Runs COLMAP's \p Command.
Expected<Success> Work::call(const char *Command, Words Arguments,
                             const std::string &Log,
                             const std::function<bool()> &Poll) const {
  Arguments.insert(Arguments.begin(), {Program, Command});
  const auto Ended = runProgram(std::move(Arguments), {}, Log, Log, Poll);
  if (Ended && Ended->Code == ExitCode::Ok)
    return Success{};
  const std::string Said = printable(trimmed(lastLine(Log)), 200);
  if (!Ended)
    return Error{
        Log,
        fmt::format("colmap {} was terminated by a signal: {}; expected "
                    "enough memory: the same command continues",
                    Command, Said),
        ExitCode::LimitReached};
  return Error{Log, fmt::format("colmap {} failed: {}", Command, Said)};
}

/// What \p Command says about its options.
const std::string &Work::helpOf(const char *Command) {
  std::string &Help = Helps[Command];
  if (Help.empty()) {
    // Its exit code differs between versions.
    static_cast<void>(call(Command, {"-h"}, in("help.log")));
    Help = textOf(in("help.log"));
  }
  return Help;
}

/// The arguments of \p Command for a processor, which computes what COLMAP
/// leaves to a GPU if it was built with CUDA. The prefix of the options is \p
/// Old before COLMAP 3.13, and \p New since.
Words Work::processorArguments(const char *Command, const char *Old,
                               const char *New, unsigned Threads) {
  if (helpOf("help").find("without CUDA") == std::string::npos)
    return {};
  const char *Prefix =
      helpOf(Command).find(New) != std::string::npos ? New : Old;
  Words Arguments{fmt::format("--{}.use_gpu", Prefix), "0"};
  if (Threads != 0)
    Arguments.insert(Arguments.end(), {fmt::format("--{}.num_threads", Prefix),
                                       fmt::format("{}", Threads)});
  return Arguments;
}

/// So many that their pictures fit into memory.
unsigned featureThreads() {
  constexpr double Each = 1.5e9; // bytes for a picture of 3200 pixels
  return std::clamp(
      static_cast<unsigned>(static_cast<double>(hostMemory()) / Each), 1U,
      hostProcessors());
}

/// Runs \p S unless it is done.
Expected<Success> Work::take(const Step &S) {
  if (isDone(S.Command))
    return Success{};
  const std::string Log = in((std::string(S.Command) + ".log").c_str());
  std::optional<Follower> Lines;
  auto Next = std::chrono::steady_clock::now();
  Progress(S.Name, 0, S.All);
  const auto Poll = [&] {
    const auto Now = std::chrono::steady_clock::now();
    if (Now < Next)
      return false;
    Next = Now + std::chrono::milliseconds(200);
    if (!Lines)
      Lines.emplace(Log, S.Count);
    Progress(S.Name, Lines->done(), S.All);
    return false; // it goes on
  };
  if (auto Ran = call(S.Command, S.Arguments, Log, Poll); !Ran)
    return Ran;
  Progress(S.Name, S.All, S.All);
  State["done"].push_back(S.Command);
  return keep();
}

Expected<Success> Work::run() {
  auto Found = findColmap();
  if (!Found)
    return Found.error();
  Program = std::move(*Found);
  if (auto Begun = begin(); !Begun)
    return Begun;
  const std::string Images = (fs::path(R.Folder) / "images").string(),
                    Database = in("database.db"), Models = in("models");
  const std::size_t Count = R.Pictures.size();

  Words Features = processorArguments("feature_extractor", "SiftExtraction",
                                      "FeatureExtraction", featureThreads());
  Features.insert(Features.end(),
                  {"--database_path", Database, "--image_path", Images,
                   "--ImageReader.camera_model", R.Lens,
                   "--ImageReader.single_camera", R.OneLens ? "1" : "0"});
  if (R.HasMasks)
    Features.insert(Features.end(), {"--ImageReader.mask_path",
                                     (fs::path(R.Folder) / "masks").string()});
  if (auto Taken = take({"feature_extractor", "features", std::move(Features),
                         featuresIn, Count});
      !Taken)
    return Taken;

  const char *Matcher =
      R.Sequential ? "sequential_matcher" : "exhaustive_matcher";
  Words Matches =
      processorArguments(Matcher, "SiftMatching", "FeatureMatching");
  Matches.insert(Matches.end(), {"--database_path", Database});
  // A block is the unit of progress: smaller than COLMAP's 50.
  std::size_t Block = 50;
  constexpr const char *BlockSize = "ExhaustiveMatching.block_size";
  if (!R.Sequential && helpOf(Matcher).find(BlockSize) != std::string::npos) {
    Block = std::clamp<std::size_t>(Count / 10, 5, Block);
    Matches.insert(Matches.end(),
                   {fmt::format("--{}", BlockSize), fmt::format("{}", Block)});
  }
  const std::size_t Blocks = (Count + Block - 1) / Block;
  if (auto Taken = take({Matcher, "matches", std::move(Matches), matchesIn,
                         R.Sequential ? Count : Blocks * Blocks});
      !Taken)
    return Taken;

  std::error_code Failed;
  if (!isDone("mapper")) {
    fs::remove_all(Models, Failed);
    fs::create_directories(Models, Failed);
  }
  if (auto Taken = take({"mapper",
                         "poses",
                         {"--database_path", Database, "--image_path", Images,
                          "--output_path", Models},
                         registeredIn,
                         Count});
      !Taken)
    return Taken;
  if (fs::exists(Models)) {
    const fs::path Sparse = fs::path(R.Folder) / "sparse";
    fs::remove_all(Sparse, Failed);
    fs::rename(Models, Sparse, Failed);
    if (Failed)
      return Error{Sparse.string(), fmt::format("cannot write: {}, expected a "
                                                "writable folder",
                                                Failed.message())};
  }
  return Success{};
}

/// "a.jpg", or "a.jpg to d.jpg" for several.
std::string gapText(const std::vector<std::string> &Names) {
  return Names.size() == 1 ? escaped(Names.front())
                           : fmt::format("{} to {}", escaped(Names.front()),
                                         escaped(Names.back()));
}

} // namespace

Expected<Success> findPoses(const PoseRequest &R,
                            const PoseProgress &Progress) {
  return Work(R, Progress).run();
}

Expected<std::vector<PoseModel>> posedModels(const std::string &Folder) {
  const auto Program = findColmap();
  if (!Program)
    return Program.error();
  const std::string Log =
      (fs::path(Folder) / "colmap" / "model_analyzer.log").string();
  std::vector<PoseModel> Models;
  std::error_code Failed;
  for (const auto &Entry :
       fs::directory_iterator(fs::path(Folder) / "sparse", Failed)) {
    if (!Entry.is_directory(Failed))
      continue;
    const std::string Path = Entry.path().string();
    const auto Read = readCaptureCameras(Path);
    if (!Read)
      return Read.error();
    const auto Ended =
        runProgram({*Program, "model_analyzer", "--path", Path}, {}, Log, Log);
    if (!Ended)
      return Ended.error();
    const std::string Said = textOf(Log);
    PoseModel M{"sparse/" + Entry.path().filename().string(), {}};
    for (const Camera &C : Read->Cameras)
      M.Pictures.push_back(C.Name);
    const auto Error = numberBehind<double>(Said, "Mean reprojection error: ");
    if (!Error)
      return vorion::Error{Log, "no reprojection error, expected the output of "
                                "colmap model_analyzer"};
    M.Error = *Error;
    M.Points = numberBehind<std::size_t>(Said, "Points: ").value_or(0);
    M.TrackLength =
        numberBehind<double>(Said, "Mean track length: ").value_or(0);
    Models.push_back(std::move(M));
  }
  if (Models.empty())
    return Error{Folder, "COLMAP found no model, expected photographs of which "
                         "each overlaps the next by two thirds"};
  std::ranges::sort(Models, [](const PoseModel &A, const PoseModel &B) {
    return A.Pictures.size() != B.Pictures.size()
               ? A.Pictures.size() > B.Pictures.size()
               : A.Name < B.Name;
  });
  return Models;
}

std::string judgePoses(const std::vector<PoseModel> &Models,
                       const std::vector<std::string> &Pictures) {
  const PoseModel &Best = Models.front();
  constexpr double GoodError = 1, PoorError = 2; // pixels
  const auto Share = static_cast<double>(Best.Pictures.size()) /
                     static_cast<double>(Pictures.size());
  std::string Text = fmt::format(
      "registered   {} of {}\n"
      "error        {:.2f} pixels of reprojection, mean: {}\n"
      "points       {}, each in {:.1f} pictures\n",
      Best.Pictures.size(), counted(Pictures.size(), "picture"), Best.Error,
      Best.Error < GoodError   ? "good"
      : Best.Error < PoorError ? "high: blurred pictures, or another lens"
                               : "poor: blurred pictures, or the wrong lens",
      Best.Points, Best.TrackLength);
  std::vector<std::vector<std::string>> Gaps;
  bool InGap = false;
  for (const std::string &Name : Pictures) {
    const bool IsThere = std::ranges::binary_search(Best.Pictures, Name);
    if (!IsThere && !InGap)
      Gaps.emplace_back();
    if (!IsThere)
      Gaps.back().push_back(Name);
    InGap = !IsThere;
  }
  Text += fmt::format("gaps         {}\n", Gaps.empty() ? "none" : "");
  if (!Gaps.empty()) {
    Text.pop_back();
    std::vector<std::string> Named;
    constexpr std::size_t MostNamed = 5;
    for (const auto &Gap : Gaps)
      if (Named.size() < MostNamed)
        Named.push_back(gapText(Gap));
    Text +=
        fmt::format("{}: {}{}\n",
                    counted(Pictures.size() - Best.Pictures.size(), "picture"),
                    fmt::join(Named, ", "),
                    Gaps.size() > MostNamed
                        ? fmt::format(" and {} more", Gaps.size() - MostNamed)
                        : "");
  }
  for (std::size_t I = 1; I < Models.size(); ++I)
    Text +=
        fmt::format("{}     not connected with {}: {}\n", Models[I].Name,
                    Best.Name, counted(Models[I].Pictures.size(), "picture"));
  constexpr double GoodShare = 0.95, PoorShare = 0.7;
  Text += fmt::format(
      "judgement    {}\n",
      Share >= GoodShare && Best.Error < GoodError ? "good"
      : Share >= PoorShare && Best.Error < PoorError
          ? "usable: places that only missing pictures show will be blurred"
          : "poor: take more pictures, each overlapping the next by two "
            "thirds, "
            "sharp, with one zoom");
  return Text;
}

} // namespace vorion::splat
