#include "commands/Compare.h"

#include "commands/Commands.h"

#include <memory>

namespace vorion::splat {

Runner addCompare(CLI::App &App) {
  auto A = std::make_shared<CompareArguments>();
  App.add_option("a", A->Reference, "What to expect: .npz or .pfm")->required();
  App.add_option("b", A->Picture, "What there is: .npz or .pfm")->required();
  CLI::Option *Pairs = App.add_flag(
      "--pairs", A->Pairs,
      "Compare tile, depth_bits and index instead; they must be equal");
  const auto AddOfPictures = [&](const char *Flag, auto &Value,
                                 const char *Help) {
    // Pairs that differ anywhere fail, whatever the bounds on pictures.
    App.add_option(Flag, Value, Help)->excludes(Pairs);
  };
  AddOfPictures("--mask", A->Mask,
                "Doubtful pixels: .npz whose arrays mask* are not 0 there");
  AddOfPictures("--json", A->Json, "Write the figures");
  AddOfPictures("--min-db", A->MinDb,
                "Exit with 1 if it is less outside doubtful pixels");
  AddOfPictures("--min-db-all", A->MinDbAll,
                "Exit with 1 if it is less over all pixels");
  AddOfPictures("--max-doubtful", A->MaxDoubtful,
                "Exit with 1 if more pixels are doubtful, per cent");
  return [A](const DeviceOptions &) {
    return A->Pairs ? comparePairs(*A) : comparePictures(*A);
  };
}

} // namespace vorion::splat
