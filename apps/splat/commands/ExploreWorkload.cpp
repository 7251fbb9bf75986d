#include "commands/ExploreWorkload.h"

#include "commands/StudyArguments.h"
#include "commands/TrainedOptions.h"
#include "commands/WorkloadState.h"
#include "explore/Space.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Json.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <set>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

/// Iterations after a state that are timed unless the workload says how many:
/// each is of another view.
constexpr unsigned TimedIterations = 3;

void addSceneAndViews(CLI::App &App, SceneArguments &Scene,
                      CameraArguments &Cameras) {
  addSceneOptions(App, Scene);
  addCameraOptions(App, Cameras, /*Several=*/true);
  const HelpGroup Group(App, "Cameras");
  takesView(
      App.add_option("--view", Cameras.Views, "Views to render (default: all)"))
      ->delimiter(',')
      ->option_text("VIEW,...");
}

/// Reads the entries of a workload's file, whose keys are options of a command.
class WorkloadReader {
public:
  WorkloadReader(const std::string &Where, GivenWorkload &To)
      : Where(Where), To(To) {}

  Expected<Success> read(const Json &All);

private:
  /// An entry's keys beside the options.
  struct Entry {
    std::string Key; ///< scenes[0]
    PartHead Head;
    /// By key, the words that say the same on a command line.
    std::vector<std::pair<std::string, std::vector<std::string>>> Words;

    /// All words but those of the keys \p Left.
    std::vector<std::string> words(const std::set<std::string> &Left) const;
  };

  Error expected(const std::string &Key, const std::string &What) const {
    return {Where, fmt::format("key {}: expected {}", Key, What)};
  }
  /// An error of an entry's options; one of a file already says where.
  Error said(const std::string &Key, const Error &Of) const {
    return Of.Where.empty()
               ? Error{Where, fmt::format("key {}: {}", Key, Of.What)}
               : Of;
  }
  /// The entry \p Of as options of \p App, whose positional is \p Input.
  Expected<Entry> entryOf(CLI::App &App, const std::string &Input,
                          const std::string &Key, const Json &Of);
  Expected<std::vector<std::string>>
  wordsFor(const CLI::Option &O, const std::string &Key, const Json &Value);
  Expected<std::string> nameOf(const Json &Of, const std::string &Key,
                               const std::string &Input);
  Expected<Success> scene(const std::string &Key, const Json &Of);
  Expected<Success> state(const std::string &Key, const Json &Of);

  const std::string &Where;
  GivenWorkload &To;
  std::set<std::string> Names; ///< of the parts
};

std::vector<std::string>
WorkloadReader::Entry::words(const std::set<std::string> &Left) const {
  std::vector<std::string> All;
  for (const auto &[Of, Each] : Words)
    if (!Left.contains(Of))
      std::ranges::copy(Each, std::back_inserter(All));
  return All;
}

Expected<std::vector<std::string>>
WorkloadReader::wordsFor(const CLI::Option &O, const std::string &Key,
                         const Json &Value) {
  const bool IsFlag = O.get_items_expected_max() == 0;
  const OptionValue Takes = valueOf(O);
  std::vector<std::string> Words;
  for (const Json &One : Value.is_array() ? Value : Json::array({Value})) {
    if (IsFlag != One.is_boolean() ||
        !(IsFlag || One.is_string() || One.is_number()))
      return expected(Key, IsFlag ? "true or false"
                                  : "a text, a number or a list of these");
    if (IsFlag) {
      if (One.get<bool>())
        Words.push_back("--" + O.get_lnames().front());
      continue;
    }
    std::string Text = One.is_string() ? One.get<std::string>() : jsonText(One);
    // Files lie beside the workload, whatever folder the user is in.
    if (Takes.What == OptionValue::Type::File && !Text.empty() &&
        std::ranges::find(Takes.Names, Text) == Takes.Names.end())
      Text = (std::filesystem::path(Where).parent_path() / Text).string();
    Words.push_back(O.get_positional()
                        ? Text
                        : fmt::format("--{}={}", O.get_lnames().front(), Text));
  }
  return Words;
}

Expected<std::string> WorkloadReader::nameOf(const Json &Of,
                                             const std::string &Key,
                                             const std::string &Input) {
  std::string Name;
  if (Of.contains("name")) {
    if (!Of["name"].is_string() || !isPlainName(Of["name"].get<std::string>()))
      return expected(Key + ".name", PlainName);
    Name = Of["name"].get<std::string>();
  } else {
    std::filesystem::path Path(Input);
    if (!Path.has_filename())
      Path = Path.parent_path();
    Name = Path.filename().string();
    Name.resize(std::min(Name.find('.'), Name.size()));
    if (!isPlainName(Name))
      return expected(Key, fmt::format("\"name\" with it, {}", PlainName));
  }
  if (!Names.insert(Name).second)
    return expected(Key, fmt::format("\"name\" with it, as another part is "
                                     "called {}, too",
                                     Name));
  return Name;
}

Expected<WorkloadReader::Entry>
WorkloadReader::entryOf(CLI::App &App, const std::string &Input,
                        const std::string &Key, const Json &Of) {
  if (!Of.is_object() || !Of.contains(Input) || !Of[Input].is_string())
    return expected(Key, fmt::format("an object with \"{}\", a file or a "
                                     "folder",
                                     Input));
  std::vector<std::string> Known{"name", "weight"};
  for (const CLI::Option *O : App.get_options())
    if (O->get_positional())
      Known.push_back(O->get_name());
    else
      Known.insert(Known.end(), O->get_lnames().begin(), O->get_lnames().end());
  Entry E;
  E.Key = Key;
  auto Name = nameOf(Of, Key, Of[Input].get<std::string>());
  if (!Name)
    return Name.error();
  E.Head.Name = std::move(*Name);
  for (const auto &[Option, Value] : Of.items()) {
    const std::string In = fmt::format("{}.{}", Key, Option);
    if (Option == "name")
      continue;
    if (Option == "weight") {
      E.Head.Weight = Value.is_number() ? Value.get<double>() : 0;
      if (!(std::isfinite(E.Head.Weight) && E.Head.Weight > 0))
        return expected(In, "a number above 0");
      continue;
    }
    if (std::ranges::find(Known, Option) == Known.end())
      return Error{Where, fmt::format("key {}: not known, expected one of "
                                      "{}{}",
                                      In, fmt::join(Known, ", "),
                                      didYouMean(Option, Known))};
    const CLI::Option *O =
        App.get_option(Option == Input ? Option : "--" + Option);
    auto Words = wordsFor(*O, In, Value);
    if (!Words)
      return Words.error();
    E.Words.emplace_back(Option, std::move(*Words));
  }
  if (auto Parsed = parseOptions(App, E.words({})); !Parsed)
    return said(Key, Parsed.error());
  return E;
}

Expected<Success> WorkloadReader::scene(const std::string &Key,
                                        const Json &Of) {
  CLI::App App;
  App.set_help_flag();
  SceneArguments Scene;
  CameraArguments Cameras;
  addSceneAndViews(App, Scene, Cameras);
  const auto E = entryOf(App, "scene", Key, Of);
  if (!E)
    return E.error();
  auto Added = addScene(To, E->Head, Scene, Cameras, Where);
  return Added ? Added : said(E->Key, Added.error());
}

Expected<Success> WorkloadReader::state(const std::string &Key,
                                        const Json &Of) {
  CLI::App App;
  App.set_help_flag();
  TrainedArguments A;
  addTrainedOptions(App, A);
  auto E = entryOf(App, "capture", Key, Of);
  if (!E)
    return E.error();
  TrainRequest &R = A.Request;
  if (auto Completed = completeTrained(App, A); !Completed)
    return said(E->Key, Completed.error());
  if (auto Checked = checkTrained(R); !Checked)
    return said(E->Key, Checked.error());
  if (App.count("--iterations") == 0)
    R.Run.Settings.Iterations = TimedIterations;
  // Judging takes longer than what is timed.
  if (!R.Read.HoldOut) {
    R.Read.HoldOut = 0;
    E->Words.emplace_back("hold-out", std::vector<std::string>{"--hold-out=0"});
  }
  std::set<std::string> Files{"iterations", "downscale"};
  GivenState State{R, {"train"}, "", App.count("--sh-degree") != 0};
  std::ranges::copy(E->words(Files), std::back_inserter(State.Words));
  for (const CLI::Option *O : App.get_options())
    if (valueOf(*O).What == OptionValue::Type::File)
      Files.insert(O->get_positional() ? O->get_name() : O->get_lnames()[0]);
  State.Options = fmt::format("{}", fmt::join(E->words(Files), " "));
  auto Added = addState(To, E->Head, std::move(State));
  return Added ? Added : said(E->Key, Added.error());
}

Expected<Success> WorkloadReader::read(const Json &All) {
  constexpr const char *Wanted =
      "an object with \"scenes\", \"training\" or both, lists of one entry or "
      "more";
  if (!All.is_object() || All.empty())
    return Error{Where, fmt::format("expected {}", Wanted)};
  for (const auto &[Kind, Entries] : All.items()) {
    if ((Kind != "scenes" && Kind != "training") || !Entries.is_array() ||
        Entries.empty())
      return expected(Kind, Wanted);
    for (std::size_t I = 0; I < Entries.size(); ++I) {
      const std::string Key = fmt::format("{}[{}]", Kind, I);
      if (auto Added = Kind == "scenes" ? scene(Key, Entries[I])
                                        : state(Key, Entries[I]);
          !Added)
        return Added;
    }
  }
  return Success{};
}

} // namespace

void addWorkloadOptions(CLI::App &App, WorkloadArguments &A) {
  const std::size_t First = App.get_options().size();
  addSceneAndViews(App, A.Scene, A.Cameras);
  App.get_option("scene")->required(false);
  const std::vector<CLI::Option *> OfScene = optionsFrom(App, First);
  CLI::Option *File =
      takesFile(App.add_option("--workload", A.File,
                               "Workload of several scenes and training states "
                               "in place of one scene, JSON (docs/explore.md)"),
                {".json"});
  for (CLI::Option *O : OfScene)
    File->excludes(O);
  const HelpGroup Group(App, "Study");
  App.add_option("--small-width", A.SmallWidth,
                 "Width of small views in pixels (default 480)")
      ->check(isBetween(16, 16384))
      ->option_text("N");
}

Expected<GivenWorkload> workloadOf(const WorkloadArguments &A,
                                   const std::string &Folder) {
  GivenWorkload Given;
  Given.Folder = Folder;
  Given.SmallWidth = A.SmallWidth;
  if (A.File.empty()) {
    if (auto Added = addScene(Given, {}, A.Scene, A.Cameras, A.Cameras.File);
        !Added)
      return Added.error();
  } else {
    const auto All = readJson<Json>(A.File, "a workload");
    if (!All)
      return All.error();
    if (auto Read = WorkloadReader(A.File, Given).read(*All); !Read)
      return Read.error();
  }
  completeWorkload(Given);
  return Given;
}

} // namespace vorion::splat
