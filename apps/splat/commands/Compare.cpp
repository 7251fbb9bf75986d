#include "commands/Compare.h"

#include "commands/Commands.h"
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
                           "What to expect: a picture of any kind that render "
                           "writes, or .json"),
            Kinds)
      ->required();
  takesFile(App.add_option("b", A->Picture, "What there is"), Kinds)
      ->required();
  CLI::Option *Pairs = App.add_flag(
      "--pairs", A->Pairs,
      "Compare tile, depth_bits and index instead; they must be equal");
  CLI::Option *Times = App.add_flag(
      "--times", A->Times,
      "Compare times instead: what `splat render --time --json` or `vorion-sim "
      "--time --stats` wrote");
  Times->excludes(Pairs);
  App.add_option("--at-most", A->AtMost,
                 "Exit with 1 if b takes longer than a by more than this, per "
                 "cent")
      ->needs(Times)
      ->check(isBetween(0.0, 1e6));
  App.add_flag("--across", A->Across,
               "Times of different machines, or of different work, too")
      ->needs(Times);
  writesFile(
      App.add_option("--html", A->Html,
                     "Write a page that shows both frames, of one view each"),
      {".html"})
      ->needs(Times);
  writesFile(App.add_option("--json", A->Json, "Write the figures"), {".json"});
  const auto AddOfPictures = [&](const char *Flag, auto &Value,
                                 const char *Help) {
    // Pairs that differ anywhere fail, whatever the bounds on pictures.
    App.add_option(Flag, Value, Help)->excludes(Pairs)->excludes(Times);
  };
  AddOfPictures("--mask", A->Mask,
                "Doubtful pixels: .npz whose arrays mask* are not 0 there");
  takesFile(App.get_option("--mask"), {".npz"});
  AddOfPictures("--min-db", A->MinDb,
                "Exit with 1 if it is less outside doubtful pixels");
  AddOfPictures("--min-db-all", A->MinDbAll,
                "Exit with 1 if it is less over all pixels");
  AddOfPictures("--max-doubtful", A->MaxDoubtful,
                "Exit with 1 if more pixels are doubtful, per cent");
  // Without a mask no pixel is doubtful, and the bound would always hold.
  App.get_option("--max-doubtful")
      ->needs("--mask")
      ->check(isBetween(0.0, 100.0));
  return [A](const DeviceOptions &) {
    if (A->Times)
      return compareTimes(*A);
    return A->Pairs ? comparePairs(*A) : comparePictures(*A);
  };
}

} // namespace vorion::splat
