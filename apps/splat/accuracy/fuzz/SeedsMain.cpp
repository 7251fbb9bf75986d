/// Writes the fuzzers' first inputs: splat-kept-seeds FOLDER makes
/// FOLDER/checkpoint, FOLDER/sweep and FOLDER/trainsweep.

#include "accuracy/fuzz/Targets.h"
#include "io/testing/WriteSample.h"
#include "vorion/support/Diagnostics.h"

using namespace vorion;
using namespace vorion::splat;

int main(int Count, char **Values) {
  constexpr std::string_view Tool = "splat-kept-seeds";
  if (Count != 2)
    return reportUsageError(Tool, "one argument, FOLDER");
  const std::pair<const char *, fuzz::Seeds> Kinds[] = {
      {"checkpoint", fuzz::checkpointSeeds()},
      {"sweep", fuzz::sweepSeeds()},
      {"trainsweep", fuzz::trainSweepSeeds()}};
  for (const auto &[Kind, Seeds] : Kinds)
    for (const auto &[Name, Content] : Seeds)
      if (auto Written = testing::writeSample(
              std::filesystem::path(Values[1]) / Kind / Name, Content);
          !Written)
        return reportError(Tool, Written.error());
  return 0;
}
