#include "commands/Compare.h"

#include "commands/Commands.h"
#include "commands/OutputFile.h"
#include "commands/Usage.h"
#include "io/Image.h"
#include "vorion/support/CommandLine.h"

#include <memory>
#include <string>
#include <vector>

namespace vorion::splat {

Runner addCompare(CLI::App &App) {
  auto A = std::make_shared<CompareArguments>();
  std::vector<std::string> Kinds(pictureEndings().begin(),
                                 pictureEndings().end());
  Kinds.emplace_back(".json");
  takesFile(App.add_option("a", A->Reference,
                           "Expected result: a picture in any format that "
                           "render writes, or .json"),
            Kinds)
      ->required();
  takesFile(App.add_option("b", A->Picture, "Actual result"), Kinds)
      ->required();
  CLI::Option *Pairs = App.add_flag(
      "--pairs", A->Pairs,
      "Compare the arrays tile, depth_bits and index, which must be equal");
  CLI::Option *Times =
      App.add_flag("--times", A->Times,
                   "Compare timing reports of `splat render --time --json` or "
                   "`vorion-sim --time --stats`");
  Times->excludes(Pairs);
  CLI::Option *Trainings = App.add_flag(
      "--trainings", A->Trainings, "Compare reports of `splat train --json`");
  Trainings->excludes(Pairs)->excludes(Times);
  App.add_option(
         "--at-most", A->AtMost,
         "Exit with 1 if b is slower than a by more than this, in percent")
      ->needs(Times)
      ->check(isBetween(0.0, 1e6));
  App.add_flag("--across", A->Across,
               "Allow different machines or different work")
      ->needs(Times);
  for (CLI::Option *O : addPageOptions(
           App, A->Page,
           "Write a page that compares two frames, of one view each, "
           "or the curves of two trainings"))
    O->excludes(Pairs);
  writesFile(App.add_option("--json", A->Json, "Write the scores as JSON"),
             {".json"})
      ->excludes(Trainings);
  const auto AddOfPictures = [&](const char *Flag, auto &Value,
                                 const char *Help) {
    // Pairs that differ anywhere fail, whatever the bounds on pictures.
    App.add_option(Flag, Value, Help)
        ->excludes(Pairs)
        ->excludes(Times)
        ->excludes(Trainings);
  };
  AddOfPictures(
      "--mask", A->Mask,
      "Doubtful pixels: those where an array mask* of this .npz is not 0");
  takesFile(App.get_option("--mask"), {".npz"});
  AddOfPictures("--min-db", A->MinDb,
                "Exit with 1 if the PSNR outside doubtful pixels is lower");
  AddOfPictures("--min-db-all", A->MinDbAll,
                "Exit with 1 if the PSNR over all pixels is lower");
  AddOfPictures("--max-doubtful", A->MaxDoubtful,
                "Exit with 1 if more pixels are doubtful, in percent");
  // Without a mask no pixel is doubtful, and the bound would always hold.
  App.get_option("--max-doubtful")
      ->needs("--mask")
      ->check(isBetween(0.0, 100.0));
  return [A](const DeviceOptions &) {
    if (A->Trainings)
      return compareTrainings(*A);
    if (A->Times)
      return compareTimes(*A);
    if (A->Page.any())
      return Expected<Success>(
          usage("--html and --figures: expected --times or --trainings"));
    return A->Pairs ? comparePairs(*A) : comparePictures(*A);
  };
}

} // namespace vorion::splat
