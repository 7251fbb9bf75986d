#include "cameras/CameraFile.h"
#include "commands/Commands.h"
#include "commands/ReportDifference.h"
#include "io/Hash.h"
#include "io/ReportHead.h"
#include "sweep/Process.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"
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
  std::string Result, Folder;
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
    return Fits.error();
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
        const auto Alone = hashFile(File);
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
      return wrong(A, fmt::format("program.environment.{} is not known, "
                                  "expected what splat recorded",
                                  Name));
    setenv(Name.c_str(), Value.get<std::string>().c_str(), 1);
  }
  return Success{};
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

Expected<Success> replay(const ReplayArguments &A,
                         const DeviceOptions &Machine) {
  const auto Result = readResult(A.Result);
  if (!Result)
    return Result.error();
  const Json &Program = (*Result)["program"];
  const auto Words = Program["arguments"].get<std::vector<std::string>>();
  // One without --json in it cannot have made this; accuracy's folder is kept.
  if (std::ranges::none_of(Words, [](const std::string &Word) {
        return Word.starts_with("--json");
      }))
    return wrong(A, "was made without --json, expected a report that can be "
                    "made again");

  const CLI::App *Command = calledCommand(*A.Splat, Words);
  if (!Command)
    return wrong(A, "program.arguments call no subcommand, expected what splat "
                    "recorded");
  const auto Temporary = TemporaryFolder::make("splat-replay");
  if (!Temporary)
    return Temporary.error();
  const std::string Folder =
      A.Folder.empty() ? Program["folder"].get<std::string>() : A.Folder;
  std::error_code Failed;
  std::filesystem::current_path(Folder, Failed);
  if (Failed)
    return Error{Folder, fmt::format("{}, expected the folder in which the "
                                     "result was made (--folder)",
                                     Failed.message())};
  std::vector<std::string> Changed;
  findChanged(*Result, Changed);
  if (!Changed.empty()) {
    std::ranges::sort(Changed);
    Changed.erase(std::ranges::unique(Changed).begin(), Changed.end());
    std::string Named;
    for (const std::string &File : Changed)
      Named += (Named.empty() ? "" : ", ") + printable(File);
    return wrong(A, fmt::format("inputs have changed since: {}, expected them "
                                "as they were",
                                Named));
  }
  if (auto Taken = takeEnvironment(A, Program); !Taken)
    return Taken;
  sayVersions(A, Program);

  const std::string Report = Temporary->path() + "/replayed.json";
  if (auto Done = runSplat(redirected(Words, writingOptions(*Command),
                                      Temporary->path(), Report),
                           Machine, Temporary->path() + "/log");
      !Done)
    return Done;
  const auto Again = readJson<Json>(Report, "what splat --json wrote");
  if (!Again)
    return Again.error();
  const ReportDifference D = differenceOf(*Result, *Again);
  for (const std::string &Line : D.Lines)
    printOut("{}\n", escaped(Line));
  std::fflush(stdout); // before the error that counts them
  if (D.Differing == 0) {
    printOut("{}: the same bits again ({} values compared)\n",
             escaped(A.Result), D.Compared);
    return Success{};
  }
  return Error{A.Result,
               fmt::format("{} of {} values differ, expected the same bits",
                           D.Differing, D.Compared),
               ExitCode::GuestFailed};
}

} // namespace

Runner addReplay(CLI::App &App) {
  auto A = std::make_shared<ReplayArguments>();
  A->Splat = App.get_parent();
  takesFile(App.add_option("result", A->Result,
                           "What --json wrote: render, gradients, analyze, "
                           "info, train, eval or compare"),
            {".json"})
      ->required();
  takesFolder(App.add_option("--folder", A->Folder,
                             "Where names of files are looked up (default: "
                             "where the result was made)"));
  return [A](const DeviceOptions &Machine) {
    // The folder changes before the file is read again.
    std::error_code Failed;
    A->Result = std::filesystem::absolute(A->Result, Failed).string();
    return replay(*A, Machine);
  };
}

} // namespace vorion::splat
