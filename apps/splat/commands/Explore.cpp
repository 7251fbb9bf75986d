#include "commands/Commands.h"
#include "commands/EnergyArguments.h"
#include "commands/ExploreSpace.h"
#include "commands/ExploreWorkload.h"
#include "commands/OutputFile.h"
#include "commands/StudyArguments.h"
#include "commands/Usage.h"
#include "explore/Page.h"
#include "explore/Trials.h"
#include "io/ReportHead.h"
#include "study/Study.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

struct ExploreArguments {
  WorkloadArguments Tried;
  StudyOptions Study;
  std::string SpaceFile;
  EnergyArguments Energy;
  std::size_t Machines = 200, Finalists = 50, Checks = 50;
  uint64_t Seed = 1;
  bool PrintSpace = false;
};

/// One that is given is checked, but not for each trial of a sweep. Of the
/// default what nothing in the workload takes is left out.
Expected<Space> spaceOf(const ExploreArguments &A, const Workload &Does,
                        const DeviceOptions &Machine) {
  if (!A.SpaceFile.empty()) {
    auto S = readSpace(A.SpaceFile);
    if (S && A.Study.Only.empty())
      if (auto Checked = checkSpace(*S, Does, Machine, A.SpaceFile); !Checked)
        return Checked.error();
    return S;
  }
  auto S = parseSpace(defaultSpace(), "the space of splat explore");
  if (S && !Does.has(Work::Frames))
    std::erase_if(
        *S, [Known = computingOptions(Work::Iterations)](const Parameter &P) {
          const auto &Words = P.Others.front().Arguments;
          return !Words.empty() && !Known.contains(Words.front());
        });
  return S;
}

Expected<ExplorePlan> planOf(const ExploreArguments &A, Workload Does,
                             const DeviceOptions &Machine) {
  auto S = spaceOf(A, Does, Machine);
  if (!S)
    return S.error();
  ExplorePlan P;
  P.Does = std::move(Does);
  P.Folder = A.Study.Folder;
  P.Setup = {Machine, A.Energy.Technology, A.Energy.Volts};
  P.Parameters = std::move(*S);
  for (const Work W : AllWork)
    P.Options[static_cast<std::size_t>(W)] = computingOptions(W);
  auto From = commonProvenance(Machine);
  if (!From)
    return From.error();
  P.From = std::move(*From);
  if (const auto Known = requestedEnergy(A.Energy, std::nullopt); !Known)
    return Known.error();
  if (!A.Energy.Technology.empty()) {
    auto Hash = fnv1a64OfFile(A.Energy.Technology);
    if (!Hash)
      return Hash.error();
    P.From["technology"] = std::move(*Hash);
  }
  if (A.Energy.Volts)
    P.From["voltage"] = fmt::format("{}", *A.Energy.Volts);
  return P;
}

Expected<std::vector<Measured>> allOf(const ExplorePlan &P, PointStore &Kept,
                                      const std::vector<Task> &Of,
                                      const std::vector<Choices> &Machines) {
  std::vector<Measured> All;
  for (const Choices &C : Machines) {
    auto One = measured(P, Kept, Of, C);
    if (!One)
      return One.error();
    All.push_back(std::move(*One));
  }
  return All;
}

/// Machines in two rounds: all of them on small views, then some on whole ones.
class Exploration {
public:
  Exploration(const ExploreArguments &A, const ExplorePlan &P)
      : A(A), P(P), Kept(storeOf(P, logStudy)),
        Machines(machinesOf(P.Parameters, A.Machines, A.Seed, Singles)) {}

  /// Does it all, or what the command line asks for alone.
  Expected<Success> run(const std::vector<ViewFile> &ViewFiles);
  /// The machines that are always tried.
  std::size_t singles() const { return Singles; }

private:
  /// The trials of the round that is not done yet, or of the last.
  Expected<std::vector<StudyPoint>> round();
  Expected<std::vector<StudyPoint>> named(const std::vector<std::string> &);
  Expected<Findings> findings();
  Expected<Success> finish();
  bool hasSmall() const { return !P.Does.Small.empty(); }
  std::vector<StudyPoint> trials(const std::vector<Task> &Of,
                                 const std::vector<Choices> &Which) const {
    return studyPoints(P, trialsOf(P, Of, Which));
  }
  /// All machines on small views, which are measured; none if there are none.
  Expected<std::vector<Measured>> small() {
    return hasSmall() ? allOf(P, Kept, P.Does.Small, Machines)
                      : std::vector<Measured>();
  }
  /// Machines for whole views.
  struct Chosen {
    std::vector<Choices> Machines;
    std::size_t Singles = 0; ///< how many are the base and changes alone
    std::size_t Checks = 0;  ///< how many behind these were drawn first
  };
  /// The base, the single changes, the machines drawn first, and the best, of
  /// those of \p Small that can be; all machines where that is empty.
  Chosen chosenBy(const std::vector<Measured> &Small) const;

  const ExploreArguments &A;
  const ExplorePlan &P;
  PointStore Kept;
  std::size_t Singles = 0;
  const std::vector<Choices> Machines;
};

Exploration::Chosen
Exploration::chosenBy(const std::vector<Measured> &Small) const {
  if (Small.empty())
    return {Machines, Singles, std::min(A.Checks, Machines.size() - Singles)};
  Chosen C;
  std::vector<Figures> Can;
  std::vector<Choices> Places;
  for (std::size_t I = 0; I < Small.size(); ++I)
    if (Small[I].Refused.empty()) {
      Can.push_back(Small[I].Is);
      Places.push_back(Small[I].Machine);
      C.Singles += I < Singles ? 1 : 0;
    }
  C.Checks = std::min(A.Checks, Places.size() - C.Singles);
  const std::size_t First = C.Singles + C.Checks;
  C.Machines.assign(Places.begin(),
                    Places.begin() + static_cast<std::ptrdiff_t>(First));
  for (const std::size_t I : bestFronts(Can, A.Finalists))
    if (I >= First)
      C.Machines.push_back(Places[I]);
  return C;
}

Expected<std::vector<StudyPoint>> Exploration::round() {
  if (hasSmall())
    if (auto OfSmall = trials(P.Does.Small, Machines);
        !missing(Kept, OfSmall).empty())
      return OfSmall;
  const auto Small = small();
  if (!Small)
    return Small.error();
  return trials(P.Does.Whole, chosenBy(*Small).Machines);
}

Expected<std::vector<StudyPoint>>
Exploration::named(const std::vector<std::string> &Names) {
  std::vector<StudyPoint> All = trials(P.Does.Small, Machines);
  std::ranges::move(trials(P.Does.Whole, Machines), std::back_inserter(All));
  return pointsNamed(All, Names, "trial", "MACHINE@TASK as printed by --list");
}

Expected<Findings> Exploration::findings() {
  Findings F;
  auto Small = small();
  if (!Small)
    return Small.error();
  F.Small = std::move(*Small);
  const Chosen C = chosenBy(F.Small);
  auto Whole = allOf(P, Kept, P.Does.Whole, C.Machines);
  if (!Whole)
    return Whole.error();
  F.Whole = std::move(*Whole);
  std::size_t Next = 1; // behind the base
  for (std::size_t I = 1; I < Singles; ++I)
    F.Alone.push_back(hasSmall() && !F.Small[I].Refused.empty()
                          ? F.Small[I]
                          : F.Whole[Next++]);
  for (std::size_t I = 0; I < C.Checks; ++I)
    F.Checked.push_back(C.Singles + I);
  const auto &All = hasSmall() ? F.Small : F.Whole;
  for (const Work W : AllWork) {
    if (!P.Does.has(W))
      continue;
    std::vector<Choices> Drawn;
    std::vector<double> Rates;
    for (std::size_t I = Singles; I < All.size(); ++I)
      if (All[I].Refused.empty()) {
        Drawn.push_back(All[I].Machine);
        Rates.push_back(All[I].Is.of(W)->Rate);
      }
    F.Pairs[static_cast<std::size_t>(W)] =
        interactions(P.Parameters, Drawn, Rates);
  }
  return F;
}

/// What all was made from, for the foot of the page.
Provenance provenanceOfAll(const ExplorePlan &P) {
  Provenance All = P.From;
  for (const Part &Of : P.Does.Parts)
    for (const auto &[Name, Is] : Of.From)
      All[P.Does.isNamed() ? Of.Name + " " + Name : Name] = Is;
  return All;
}

Expected<Success> write(const ExplorePlan &P, const Json &Results,
                        const std::string &Made) {
  Json Report = reportHead("splat-explore", 2);
  Report["made"] = Made;
  Report.update(Results);
  return writeStudy(
      P.Folder, "explore.json", Report,
      explorePageOf(Results, {Made, hashLine(provenanceOfAll(P))}));
}

Expected<Success> Exploration::finish() {
  const auto F = findings();
  if (!F)
    return F.error();
  const Json Results = resultsOf(P, *F);
  if (auto Written = write(P, Results, madeBy()); !Written)
    return Written;
  printOut("{}{}/index.html\n", textOf(Results), P.Folder);
  return Success{};
}

Expected<Success> Exploration::run(const std::vector<ViewFile> &ViewFiles) {
  StudySteps Steps;
  Steps.Round = [this] { return round(); };
  Steps.Named = [this](const std::vector<std::string> &Names) {
    return named(Names);
  };
  Steps.Begin = [&ViewFiles]() -> Expected<Success> {
    for (const ViewFile &F : ViewFiles)
      if (auto Written = writeCameras(F.Path, F.Views); !Written)
        return Written;
    return Success{};
  };
  Steps.End = [this] { return finish(); };
  return runStudy(A.Study, Kept, Steps, logStudy);
}

Expected<Success> run(const ExploreArguments &A, const DeviceOptions &Machine) {
  if (A.PrintSpace) {
    printOut("{}", defaultSpace());
    return Success{};
  }
  if (A.Tried.input().empty())
    return usage("expected a scene, --workload or --print-space");
  auto Given = workloadOf(A.Tried, A.Study.Folder);
  if (!Given)
    return Given.error();
  const auto P = planOf(A, std::move(Given->Does), Machine);
  if (!P)
    return P.error();
  Exploration E(A, *P);
  if (A.Machines < E.singles())
    printNote(
        fmt::format("splat: --machines {}: the base and each single change "
                    "are always measured, {} machines\n",
                    A.Machines, E.singles()));
  return E.run(Given->ViewFiles);
}

} // namespace

Runner addExplore(CLI::App &App) {
  auto A = std::make_shared<ExploreArguments>();
  addStudyOptions(App, A->Study, "trial",
                  "the scene's or the workload's name and -explore");
  HelpGroup Group(App, "Study");
  App.add_flag("--print-space", A->PrintSpace,
               "Print the default design space and exit");
  takesFile(App.add_option("--space", A->SpaceFile,
                           "Design space, JSON (default: --print-space)"));
  Group.next("Time and energy");
  takesFile(
      App.add_option("--technology", A->Energy.Technology,
                     "Energies and areas of a process node (default: 16 nm)"),
      {".json"});
  App.add_option("--voltage", A->Energy.Volts,
                 "Supply voltage of all machines (default: what each machine's "
                 "clock frequency needs)")
      ->option_text("V");
  Group.next("Study");
  App.add_option("--machines", A->Machines,
                 "Number of machines: the base, each single change, and others "
                 "sampled at random (default 200)")
      ->check(isBetween(1U, 1000000U))
      ->option_text("N");
  App.add_option("--finalists", A->Finalists,
                 "Minimum number of machines that are best on small views and "
                 "then measured on full views (default 50)")
      ->option_text("N");
  App.add_option("--checks", A->Checks,
                 "Number of random machines that are measured on both small "
                 "and full views, to compare the rankings (default 50)")
      ->option_text("N");
  App.add_option("--seed", A->Seed, "Seed of the random machines (default 1)")
      ->check(isBetween<uint64_t>(0, MostSeed))
      ->option_text("N");
  addWorkloadOptions(App, A->Tried);
  return [A](const DeviceOptions &Machine) {
    nameOutput("-o", A->Study.Folder, A->Tried.input(), "-explore");
    auto Done = run(*A, Machine);
    return Done ? writeStudyFigures(A->Study) : Done;
  };
}

} // namespace vorion::splat
