// splat-hard-cases: shows the catalogue of hard cases, and holds it against its
// contracts. `splat hard-cases` is this program.

#include "Check.h"
#include "Fuzz.h"
#include "Show.h"
#include "Table.h"
#include "Tool.h"
#include "TrainingCase.h"
#include "commands/OutputFile.h"
#include "commands/Progress.h"
#include "io/ReportHead.h"
#include "scene/formats/Ply.h"
#include "vorion/support/CommandLine.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace vorion::test {
namespace {

struct Arguments {
  CheckPlan Plan;
  FuzzPlan Fuzz;
  bool List = false, Verbose = false, Table = false, Check = false;
  std::string Write, Out = "hard-cases", Figures;

  /// Whether more or less than what is shown is to be checked.
  bool checksOnly() const {
    return Check || Plan.Alone || Plan.Random != 0 || Plan.Broken ||
           Plan.Oracle != 0 || Plan.OneIn != 1 || !Plan.RowFile.empty() ||
           !Plan.Scratch.empty() || Verbose;
  }
};

/// scene.ply and cameras.json of the cases, for `splat render`.
Expected<Success> write(const Arguments &A) {
  for (const HardCase &C : catalogue()) {
    if (!A.Plan.Cases.empty() &&
        std::ranges::find(A.Plan.Cases, C.Name) == A.Plan.Cases.end())
      continue;
    const std::string Folder = A.Write + "/" + C.Name;
    std::error_code Failed;
    std::filesystem::create_directories(Folder, Failed);
    if (auto W = splat::writePly(Folder + "/scene.ply", C.Scene); !W)
      return W;
    if (auto W = splat::writeCameras(Folder + "/cameras.json", {C.View}); !W)
      return W;
  }
  return Success{};
}

/// The plan, which tells a person how far it is.
CheckPlan withProgress(CheckPlan P) {
  P.Progress = splat::progress();
  return P;
}

Expected<Success> run(const Arguments &A) {
  if (A.List) {
    for (const HardCase &C : catalogue())
      fmt::print("{:<41}{}{}\n", C.Name, C.Why, C.Long ? " (--long)" : "");
    for (const TrainingCase &C : trainingCases())
      fmt::print("{:<41}{}\n", C.Name, C.Why);
    return Success{};
  }
  if (!A.Write.empty())
    return write(A);
  if (A.Table) {
    const auto R = Rows::open(A.Plan.RowFile);
    if (!R)
      return R.error();
    fmt::print("{}", tableOf(*R));
    return Success{};
  }
  if (A.Fuzz.Groups != 0 || A.Fuzz.Minutes > 0) {
    FuzzPlan P = A.Fuzz;
    P.Seed = A.Plan.Seed;
    P.RowFile = A.Plan.RowFile;
    return fuzz(P);
  }
  if (!A.checksOnly()) {
    auto Shown = show(withProgress(A.Plan), A.Out);
    return Shown && !A.Figures.empty()
               ? splat::writeFigures(A.Out + "/index.html", A.Figures)
               : Shown;
  }
  const auto Counts = check(A.Plan, A.Verbose);
  if (!Counts)
    return Counts.error();
  fmt::print("{} checks: {} kept, {} broken\n", Counts->Checked, Counts->Kept,
             Counts->Failed);
  if (Counts->Failed != 0)
    return Error{
        "",
        fmt::format("{} contracts are broken, expected none", Counts->Failed),
        ExitCode::GuestFailed};
  return Success{};
}

} // namespace
} // namespace vorion::test

int main(int Count, char **Values) {
  CLI::App App("Renders numerically hard scenes, each with and without the "
               "guards in the kernels that it exercises, and writes a table "
               "and a page; checks the contract of each scene on both paths.",
               "splat-hard-cases");
  vorion::test::Arguments A;
  App.add_option("cases", A.Plan.Cases, "Names of cases (default: all)");
  vorion::writesFolder(
      App.add_option("-o,--output", A.Out,
                     "Folder for pictures, index.html and hard-cases.json")
          ->capture_default_str());
  vorion::splat::addFiguresOption(App, A.Figures);
  App.add_option_function<std::string>(
         "--set",
         [&A](const std::string &Set) {
           A.Plan.Machine.set("VORION_SET", Set, "--set");
         },
         "Override configuration keys of the Vorion device (default: "
         "VORION_SET)")
      ->type_name("KEY=VALUE,...");
  App.add_flag_callback("--quiet", vorion::splat::hideProgress,
                        "Do not show progress");
  App.add_flag("--list", A.List,
               "Print the cases and why each is hard, and exit");
  App.add_option("--write", A.Write,
                 "Write scenes and views to this folder, and exit");
  App.add_flag("--long", A.Plan.Long, "Include the long cases");
  App.add_flag("--check", A.Check,
               "Only check each case under the default settings, without "
               "pictures; all options below imply this");
  App.add_flag("--alone", A.Plan.Alone, "Check under each knob alone");
  App.add_option("--random", A.Plan.Random,
                 "Check under this number of random combinations of knobs");
  App.add_option(
      "--fuzz", A.Fuzz.Groups,
      "Check this number of groups of ten random scenes in place of the cases");
  App.add_option("--fuzz-minutes", A.Fuzz.Minutes,
                 "Check random scenes for this time in place of the cases; "
                 "with --rows, continue where the last run stopped");
  App.add_option("--seed", A.Plan.Seed,
                 "Seed of the first combination or group")
      ->capture_default_str();
  App.add_flag("--broken", A.Plan.Broken,
               "Check that deliberately broken kernels are detected");
  App.add_option("--oracle", A.Plan.Oracle,
                 "Compare the fp64 reference with 256-bit arithmetic, at about "
                 "this number of (pixel, Gaussian) pairs per case");
  App.add_option("--one-in", A.Plan.OneIn,
                 "Check only one of N settings and broken kernels")
      ->check(CLI::Range(1U, 1000000U))
      ->capture_default_str();
  App.add_option("--rows", A.Plan.RowFile,
                 "Store results in this file, and skip those that it has");
  App.add_option("--scratch", A.Plan.Scratch,
                 "Write the sources of the broken kernels to this folder");
  App.add_flag("--table", A.Table,
               "Print the results of --rows as the table of "
               "docs/tables/hard-cases.md, and exit");
  App.add_flag("-v,--verbose", A.Verbose, "Print a line for each check");
  std::vector<std::string> Words(Values + 1, Values + Count);
  Words.insert(Words.begin(), "hard-cases");
  vorion::splat::setCommandLine(std::move(Words));
  return vorion::test::runTool(App, Count, Values,
                               [&A] { return vorion::test::run(A); });
}
