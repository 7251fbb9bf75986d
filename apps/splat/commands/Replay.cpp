#include "cameras/CameraFile.h"
#include "commands/Commands.h"
#include "commands/InputFiles.h"
#include "commands/OutputFile.h"
#include "commands/ReportDifference.h"
#include "io/Hash.h"
#include "io/ReportHead.h"
#include "study/Process.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Environment.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"
#include "vorion/support/TemporaryFolder.h"
#include "vorion/support/Version.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

struct ReplayArguments {
  std::string Result, Folder, JsonFile;
  const CLI::App *Splat = nullptr; ///< which knows what each option writes
};

Error wrong(const ReplayArguments &A, std::string What) {
  return {A.Result, std::move(What)};
}

Expected<Json> readResult(const std::string &File) {
  auto Result = readJson<Json>(File, "what splat --json wrote");
  if (!Result)
    return Result;
  const JsonShape Wanted = JsonShape::object(
      {{"schema", JsonShape::object({{"name", JsonShape::text()},
                                     {"version", JsonShape::whole()}})},
       {"program",
        JsonShape::object({{"version", JsonShape::text()},
                           {"commit", JsonShape::text()},
                           {"arguments", JsonShape::list(JsonShape::text(), 1)},
                           {"folder", JsonShape::text()},
                           {"environment", JsonShape::object({})}})}});
  if (auto Fits = Wanted.check(*Result, File); !Fits)
    return Error{File, "not a report of splat:  " + Fits.error().What};
  return Result;
}

/// The inputs in \p J that are not what they were, one a line: whatever has a
/// hash beside a file's name.
void findChanged(const Json &J, std::vector<std::string> &Changed) {
  if (J.is_object() && J.contains("fnv1a64") && J["fnv1a64"].is_string())
    for (const char *Key : {"file", "upstream"})
      if (J.contains(Key) && J[Key].is_string()) {
        const auto File = J[Key].get<std::string>();
        const auto Was = J["fnv1a64"].get<std::string>();
        // Of a scene that is a folder, or stands for one, or of one file.
        const auto Scene = hashScene(File);
        const auto Alone = fnv1a64OfFile(File);
        const auto Cameras = hashCameraFile(File);
        if (File.empty()) // made, not read
          continue;
        if (!Scene && !Alone && !Cameras)
          Changed.push_back(File + " (cannot be read)");
        else if ((!Scene || *Scene != Was) && (!Alone || *Alone != Was) &&
                 (!Cameras || *Cameras != Was))
          Changed.push_back(File);
      }
  if (J.is_structured())
    for (const Json &Inner : J)
      findChanged(Inner, Changed);
}

/// Adds the files of all that \p J has a hash of.
void addHashed(const Json &J, InputFiles &To) {
  if (J.is_object() && J.contains("fnv1a64"))
    for (const char *Key : {"file", "upstream"})
      if (J.contains(Key) && J[Key].is_string()) {
        const auto File = J[Key].get<std::string>();
        To.scene(File, "an input").cameras(File);
      }
  if (J.is_structured())
    for (const Json &Inner : J)
      addHashed(Inner, To);
}

/// What the command line of \p Result reads.
InputFiles inputsOf(const Json &Result) {
  InputFiles Inputs;
  addHashed(Result, Inputs);
  if (Result.contains("capture") && Result["capture"].is_string())
    Inputs.capture(Result["capture"].get<std::string>());
  return Inputs;
}

/// \p Words with every file that they write in \p Folder instead, and the
/// report at \p Report. \p Outputs are the options that name these files.
std::vector<std::string> redirected(std::vector<std::string> Words,
                                    const std::vector<std::string> &Outputs,
                                    const std::string &Folder,
                                    const std::string &Report) {
  const auto Elsewhere = [&](std::string_view Option, const std::string &File) {
    if (Option == "--json")
      return Report;
    // As it is called, for its ending and for views' names.
    return Folder + "/" +
           (File == "-" ? "out"
                        : std::filesystem::path(File).filename().string());
  };
  for (std::size_t I = 0; I < Words.size(); ++I)
    for (const std::string &Option : Outputs)
      if (Words[I] == Option && I + 1 < Words.size()) {
        Words[I + 1] = Elsewhere(Option, Words[I + 1]);
        ++I;
        break;
      } else if (Words[I].starts_with(fmt::format("{}=", Option))) {
        Words[I] =
            fmt::format("{}={}", Option,
                        Elsewhere(Option, Words[I].substr(Option.size() + 1)));
        break;
      } else if (Option.size() == 2 && Words[I].size() > 2 &&
                 Words[I].starts_with(Option)) {
        Words[I] =
            fmt::format("{}{}", Option, Elsewhere(Option, Words[I].substr(2)));
        break;
      }
  return Words;
}

/// \p Words of a training that ends after \p Iteration.
std::vector<std::string> upTo(std::vector<std::string> Words,
                              uint64_t Iteration) {
  constexpr std::string_view Option = "--iterations";
  std::erase_if(Words, [&](const std::string &Word) {
    return Word.starts_with(fmt::format("{}=", Option));
  });
  if (const auto At = std::ranges::find(Words, Option); At != Words.end())
    Words.erase(At, At + std::min<std::ptrdiff_t>(2, Words.end() - At));
  Words.insert(Words.end(), {std::string(Option), std::to_string(Iteration)});
  return Words;
}

/// Runs the command line of \p Result, of which \p Words are redirected. A
/// training that went on from a checkpoint is made up to there first: its
/// report is of the rest alone.
Expected<Success> runAgain(const Json &Result,
                           const std::vector<std::string> &Words,
                           const DeviceOptions &Machine,
                           const std::string &Log) {
  if (const auto After = Result.find("resumed_after");
      After != Result.end() && After->is_number_unsigned())
    if (auto Done = runSplat(upTo(Words, After->get<uint64_t>()), Machine, Log);
        !Done)
      return Done.error();
  const auto Done = runSplat(Words, Machine, Log);
  return Done ? Expected<Success>(Success{}) : Done.error();
}

/// This process's variables are those under which \p Program ran.
Expected<Success> takeEnvironment(const ReplayArguments &A,
                                  const Json &Program) {
  std::vector<std::string> Here;
  for (char **Each = environ; *Each; ++Each)
    Here.emplace_back(*Each, std::string_view(*Each).find('='));
  for (const std::string &Name : Here)
    if (isRecordedVariable(Name))
      unsetenv(Name.c_str());
  for (const auto &[Name, Value] : Program["environment"].items()) {
    if (!isRecordedVariable(Name) || !Value.is_string())
      return wrong(A, fmt::format("program.environment.{} is unknown, expected "
                                  "a variable that splat records",
                                  Name));
    setenv(Name.c_str(), Value.get<std::string>().c_str(), 1);
  }
  return Success{};
}

/// The clock that \p Result was made under: what watches a run may have turned
/// it on, and does not watch this one.
void takeClock(const Json &Result) {
  constexpr const char *Variable = "VORION_TIME";
  if (Result.contains("time") && !environmentVariable(Variable))
    setenv(Variable, "on", 1);
}

/// Of another program than the one that made the result.
void sayVersions(const ReplayArguments &A, const Json &Program) {
  const auto Was =
      fmt::format("{}, commit {}", Program["version"].get<std::string>(),
                  Program["commit"].get<std::string>());
  const auto Is =
      fmt::format("{}, commit {}", projectVersion(), commitOfTree());
  if (Was != Is)
    printDiagnostic("splat", "note", A.Result,
                    fmt::format("made by splat {}; this is {}", Was, Is));
}

/// \p Report begins it: it was made before the folder changed.
std::string jsonReport(Json Report, const ReportDifference &D) {
  Json First = Json::array();
  for (const ValueDifference &V : D.First)
    First.push_back({{"path", V.Path}, {"is", V.Is}, {"was", V.Was}});
  Report.update({{"equal", D.Differing == 0},
                 {"compared", D.Compared},
                 {"differing", D.Differing},
                 {"first_differences", std::move(First)}});
  return jsonText(Report, 2) + "\n";
}

Expected<Success> replay(const ReplayArguments &A,
                         const DeviceOptions &Machine) {
  if (auto Checked = checkJsonName(A.JsonFile); !Checked)
    return Checked;
  if (auto Claimed =
          claimOutputs({{"--json", A.JsonFile}}, {{"the result", A.Result}});
      !Claimed)
    return Claimed;
  const auto Hash = fnv1a64OfFile(A.Result);
  if (!Hash)
    return Hash.error();
  Json Report = reportHead("splat-replay");
  std::error_code Failed;
  Report["result"] = {
      {"file", std::filesystem::absolute(A.Result, Failed).string()},
      {"fnv1a64", *Hash}};
  const auto Result = readResult(A.Result);
  if (!Result)
    return Result.error();
  const Json &Program = (*Result)["program"];
  const auto Words = Program["arguments"].get<std::vector<std::string>>();
  // One without --json in it cannot have made this; accuracy's folder is kept.
  if (std::ranges::none_of(Words, [](const std::string &Word) {
        return Word.starts_with("--json");
      }))
    return wrong(
        A,
        "was written without --json, expected a report that can be repeated");

  const CLI::App *Command = calledCommand(*A.Splat, Words);
  if (!Command)
    return wrong(A, "program.arguments have no subcommand, expected a command "
                    "line that splat recorded");
  const auto Temporary = TemporaryFolder::make("splat-replay");
  if (!Temporary)
    return Temporary.error();
  const std::string Folder =
      A.Folder.empty() ? Program["folder"].get<std::string>() : A.Folder;
  std::filesystem::current_path(Folder, Failed);
  if (Failed)
    return Error{
        Folder,
        fmt::format(
            "{}, expected the folder in which the command ran (--folder)",
            Failed.message())};
  std::vector<std::string> Changed;
  findChanged(*Result, Changed);
  if (!Changed.empty()) {
    std::ranges::sort(Changed);
    Changed.erase(std::ranges::unique(Changed).begin(), Changed.end());
    std::string Named;
    for (const std::string &File : Changed)
      Named += (Named.empty() ? "" : ", ") + escaped(File);
    return wrong(
        A, fmt::format("inputs have changed: {}, expected the recorded hashes",
                       Named));
  }
  if (auto Claimed =
          claimOutputs({{"--json", A.JsonFile}}, inputsOf(*Result).named());
      !Claimed)
    return Claimed;
  if (auto Taken = takeEnvironment(A, Program); !Taken)
    return Taken;
  takeClock(*Result);
  sayVersions(A, Program);

  const std::string Replayed = Temporary->path() + "/replayed.json";
  if (auto Done = runAgain(*Result,
                           redirected(Words, writingOptions(*Command),
                                      Temporary->path(), Replayed),
                           Machine, Temporary->path() + "/log");
      !Done)
    return Done;
  const auto Again = readJson<Json>(Replayed, "what splat --json wrote");
  if (!Again)
    return Again.error();
  const ReportDifference D = differenceOf(*Result, *Again);
  if (!A.JsonFile.empty())
    if (auto Written =
            writeFileAtomically(A.JsonFile, jsonReport(std::move(Report), D));
        !Written)
      return Written;
  for (const ValueDifference &V : D.First)
    printOut("{}: {}, was {}\n", escaped(V.Path), V.Is, V.Was);
  if (D.Differing > D.First.size())
    printOut("... and {} more\n", D.Differing - D.First.size());
  std::fflush(stdout); // before the error that counts them
  if (D.Differing == 0) {
    printOut("{}: bit-identical ({} compared)\n", escaped(A.Result),
             counted(D.Compared, "value"));
    return Success{};
  }
  return Error{A.Result,
               fmt::format("{} of {} differ, expected bit-identical results",
                           D.Differing, counted(D.Compared, "value")),
               ExitCode::GuestFailed};
}

} // namespace

Runner addReplay(CLI::App &App) {
  auto A = std::make_shared<ReplayArguments>();
  A->Splat = App.get_parent();
  takesFile(
      App.add_option(
          "result", A->Result,
          "Report (--json) of any command except accuracy, explore and doctor"),
      {".json"})
      ->required();
  takesFolder(App.add_option("--folder", A->Folder,
                             "Folder of relative file names (default: the "
                             "folder in which the command ran)"));
  writesFile(
      App.add_option("--json", A->JsonFile, "Write the comparison as JSON"),
      {".json"});
  return [A](const DeviceOptions &Machine) {
    // The folder changes before it is written.
    std::error_code Failed;
    if (!A->JsonFile.empty() && A->JsonFile != StandardOutput)
      A->JsonFile = std::filesystem::absolute(A->JsonFile, Failed).string();
    return replay(*A, Machine);
  };
}

} // namespace vorion::splat
