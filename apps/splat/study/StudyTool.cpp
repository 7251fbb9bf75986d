// splat-study: the study engine for scripts. It measures the points that
// standard input describes in JSON, and prints the names of their files.
// bench/study.py documents a point. Not installed.

#include "device/Programs.h"
#include "io/Hash.h"
#include "io/Inside.h"
#include "study/Process.h"
#include "study/Study.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"
#include "vorion/support/Printable.h"
#include "vorion/support/Tool.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace {

using namespace vorion;
using namespace vorion::splat;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
using Texts = std::map<std::string, std::string>;

constexpr const char *In = "/dev/stdin";

void log(std::string_view Line) {
  printNote(fmt::format("splat-study: {}\n", escaped(Line)));
}

/// A program with its inputs and outputs.
struct Command {
  std::string Name;
  std::vector<std::string> Words;
  Texts Inputs;                  ///< files and folders, by placeholder
  Texts Variables;               ///< environment variables
  std::vector<std::string> Keep; ///< suffixes of the output files to store
  bool AnyBuild = false;         ///< reuse measurements of other builds
  bool MayBeRefused = false;     ///< a usage error counts as a measurement
};

Command commandOf(const Json &J) {
  return {J["name"], J["command"],   J["inputs"],        J["variables"],
          J["keep"], J["any_build"], J["may_be_refused"]};
}

/// \p Word with the names of files in place of "{scene}" and the like.
std::string filledIn(std::string Word, const Texts &Files) {
  for (const auto &[Name, File] : Files)
    for (std::size_t At = 0;
         (At = Word.find("{" + Name + "}", At)) != Word.npos; At += File.size())
      Word.replace(At, Name.size() + 2, File);
  return Word;
}

/// The program of that name beside this one.
std::string programFile(const std::string &Name) {
  return fs::read_symlink("/proc/self/exe").replace_filename(Name);
}

/// The hash of a file, or of all files of a folder.
Expected<std::string> hashPath(const std::string &Path) {
  std::error_code Ignored;
  return fs::is_directory(Path, Ignored) ? hashScene(Path)
                                         : fnv1a64OfFile(Path);
}

/// Computes the provenance of points. Each input file is hashed once.
class Provenances {
public:
  Expected<Provenance> of(const Command &C);

private:
  Expected<std::string> hashOf(const std::string &Path);

  Texts Hashes; ///< by path
  std::string Programs;
};

Expected<std::string> Provenances::hashOf(const std::string &Path) {
  std::string &Hash = Hashes[Path];
  if (!Hash.empty())
    return Hash;
  auto Found = hashPath(Path);
  if (Found)
    Hash = *Found;
  return Found;
}

Expected<Provenance> Provenances::of(const Command &C) {
  if (Programs.empty()) {
    auto All = hashPrograms(programFile("splat"));
    if (!All)
      return All.error();
    Programs = std::move(*All);
  }
  DeviceOptions Options;
  for (const auto &[Name, Text] : C.Variables)
    Options.set(Name, Text);
  auto Machine = hashMachine(Options);
  if (!Machine)
    return Machine.error();
  Provenance From{{"programs", Programs},
                  {"machine", std::move(*Machine)},
                  {"command", fmt::format("{}", fmt::join(C.Words, " "))}};
  auto Files = C.Inputs;
  Files["program"] = programFile(C.Words.front());
  for (const auto &[Name, Path] : Files) {
    auto Hash = hashOf(Path);
    if (!Hash)
      return Hash.error();
    From[Name] = std::move(*Hash);
  }
  std::vector<std::string> Others;
  for (const auto &[Name, Text] : C.Variables)
    if (Name != "VORION_CONFIG" && Name != "VORION_SET")
      Others.push_back(fmt::format("{}={}", Name, Text));
  From["variables"] = fmt::format("{}", fmt::join(Others, " "));
  return From;
}

/// Runs a command in its own folder, and stores its outputs.
class CommandRun {
public:
  CommandRun(const std::string &Folder, const Command &C)
      : C(C), Kept(fmt::format("{}/points/{}", Folder, asFileName(C.Name))),
        Work(fmt::format("{}/work/{}", Folder, asFileName(C.Name))) {}

  /// Whether the stored files match the hashes in \p Measured.
  bool hasFiles(const Json &Measured) const;
  /// Removes a stale measurement with its files.
  void forget() const;
  Expected<Json> measure() const;

private:
  Expected<ProcessEnd> run() const;
  Expected<Json> outcome() const;

  const Command &C;
  const std::string Kept, Work;
};

bool CommandRun::hasFiles(const Json &Measured) const {
  const Texts Files = Measured["kept"];
  return Measured.contains("refused") ||
         std::ranges::all_of(C.Keep, [&](const std::string &Ending) {
           const auto At = Files.find(Ending);
           const auto Hash = hashPath(Kept + Ending);
           return At != Files.end() && Hash && *Hash == At->second;
         });
}

void CommandRun::forget() const {
  std::error_code Ignored;
  if (!fs::remove(Kept + ".json", Ignored))
    return; // the files are of an interrupted run, which may be resumed
  for (const std::string &Ending : C.Keep)
    fs::remove_all(Kept + Ending, Ignored);
}

Expected<ProcessEnd> CommandRun::run() const {
  Texts Files = C.Inputs;
  Files["out"] = Work + "/out";
  Files["kept"] = Kept;
  std::vector<std::string> Words;
  Words.reserve(C.Words.size());
  for (const std::string &Word : C.Words)
    Words.push_back(filledIn(Word, Files));
  Words.front() = programFile(Words.front());
  Texts Variables;
  for (const auto &[Name, Text] : C.Variables)
    Variables[Name] = filledIn(Text, Files);
  return runProgram(Words, Variables, Work + "/said", Work + "/log");
}

/// The hash of the outputs, the report, and the hashes of the files to store,
/// which are moved into the store.
Expected<Json> CommandRun::outcome() const {
  std::vector<std::string> Written;
  for (const auto &Entry : fs::directory_iterator(Work))
    if (const std::string File = Entry.path().filename();
        Entry.is_regular_file() && File.starts_with("out.") &&
        File != "out.json")
      Written.push_back(File);
  std::ranges::sort(Written);
  std::string All;
  for (const std::string &File : Written) {
    const auto Hash = fnv1a64OfFile(Work + "/" + File);
    if (!Hash)
      return Hash.error();
    All += *Hash;
  }
  Json Outcome{{"output_fnv1a64", fnv1a64(All)}, {"kept", Json::object()}};
  for (const std::string &Ending : C.Keep) {
    if (const std::string Made = Work + "/out" + Ending; fs::exists(Made)) {
      fs::remove_all(Kept + Ending);
      fs::rename(Made, Kept + Ending);
    }
    const auto Hash = hashPath(Kept + Ending);
    if (!Hash)
      return Hash.error();
    Outcome["kept"][Ending] = *Hash;
  }
  if (const std::string Report = Work + "/out.json"; fs::exists(Report)) {
    auto Read = readOwnJson(Report);
    if (!Read)
      return Read;
    Outcome["report"] = std::move(*Read);
  }
  return Outcome;
}

Expected<Json> CommandRun::measure() const {
  fs::create_directories(Work);
  const auto Begin = std::chrono::steady_clock::now();
  const auto Ended = run();
  const std::chrono::duration<double> Seconds =
      std::chrono::steady_clock::now() - Begin;
  if (!Ended)
    return Ended.error();
  Json Times{{"seconds", Seconds.count()},
             {"processor_seconds", Ended->ProcessorSeconds}};
  if (Ended->Code != ExitCode::Ok) {
    const std::string Why = lastLine(Work + "/log");
    if (!C.MayBeRefused || Ended->Code != ExitCode::Usage)
      return Error{C.Name, Why, Ended->Code};
    fs::remove_all(Work);
    Times["refused"] = Why;
    Times["kept"] = Json::object();
    return Times;
  }
  auto Outcome = outcome();
  if (Outcome) {
    Outcome->update(Times);
    fs::remove_all(Work);
  }
  return Outcome;
}

bool isMeasurement(const Json &J) {
  const JsonShape Number = JsonShape::number();
  return J.contains("kept") && J["kept"].is_object() &&
         std::ranges::all_of(J["kept"],
                             [](const Json &One) { return One.is_string(); }) &&
         bool(JsonShape::object(
                  {{"seconds", Number}, {"processor_seconds", Number}})
                  .check(J, ""));
}

std::string lineOf(const Json &Measured) {
  return fmt::format("{:.1f} s{}", Measured["seconds"].get<double>(),
                     Measured.contains("refused") ? ", refused" : "");
}

Expected<Json> readRequest() {
  auto J = readJson<Json>(In, "points of a study");
  if (!J)
    return J;
  const JsonShape Text = JsonShape::text(), Words = JsonShape::list(Text);
  const JsonShape Any = JsonShape::object({});
  const JsonShape Point =
      JsonShape::object({{"name", Text},
                         {"command", JsonShape::list(Text, 1)},
                         {"inputs", Any},
                         {"variables", Any},
                         {"keep", Words},
                         {"any_build", JsonShape::boolean()},
                         {"may_be_refused", JsonShape::boolean()}})
          .closed();
  if (auto Fits = JsonShape::object({{"folder", Text},
                                     {"jobs", JsonShape::whole(1, 256)},
                                     {"measure", JsonShape::boolean()},
                                     {"points", JsonShape::list(Point)}})
                      .closed()
                      .check(*J, In);
      !Fits)
    return Fits.error();
  return J;
}

/// The files of the points in \p Request; null for missing points.
Expected<Json> study(const Json &Request) {
  const std::string Folder = Request["folder"];
  const bool Measures = Request["measure"];
  if (auto Made = makeFolders(Folder); !Made)
    return Made.error();
  std::vector<Command> Commands;
  for (const Json &Of : Request["points"])
    Commands.push_back(commandOf(Of));
  PointStore Kept(Folder, isMeasurement, log);
  std::vector<StudyPoint> Left;
  Json Files = Json::array();
  Provenances All;
  for (const Command &C : Commands) {
    auto From = All.of(C);
    if (!From && !Measures) { // an input is itself a missing measurement
      Files.push_back(nullptr);
      continue;
    }
    if (!From)
      return From.error();
    Provenance Serves = *From;
    if (C.AnyBuild)
      for (const char *Name : {"programs", "program"})
        Serves.erase(Name);
    const CommandRun Run(Folder, C);
    const Json *Found = Kept.find(C.Name, Serves);
    const bool Has = Found && Run.hasFiles(*Found);
    Files.push_back(
        Has || Measures
            ? Json(fmt::format("{}/points/{}.json", Folder, asFileName(C.Name)))
            : Json());
    if (!Has)
      Left.push_back({C.Name, std::move(*From),
                      [Run]() -> Expected<Success> {
                        Run.forget();
                        return Success{};
                      },
                      [Run] { return Run.measure(); }, lineOf});
  }
  if (Measures)
    if (auto Done = measureAll(Kept, std::move(Left),
                               Request["jobs"].get<unsigned>(), log);
        !Done)
      return Done.error();
  return Files;
}

} // namespace

int main() {
  return runTool("splat-study", [] {
    const auto Request = readRequest();
    const auto Files =
        Request ? study(*Request) : Expected<Json>(Request.error());
    if (!Files)
      return reportError("splat-study", Files.error());
    printOut("{}\n", jsonText(*Files));
    return EXIT_SUCCESS;
  });
}
