// splat-capture-samples: writes a small capture of every format, and the same
// as seeds of the fuzzers.
#include "capture/fuzz/Targets.h"
#include "capture/testing/CaptureWriters.h"
#include "io/testing/WriteSample.h"
#include "vorion/support/Diagnostics.h"

#include <filesystem>

namespace {

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;
namespace fs = std::filesystem;

Expected<Success> run(const fs::path &Root) {
  const SampleCapture C = sampleCapture();
  const std::pair<const char *, Folder> Captures[] = {
      {"colmap-text", colmapTextOf(C)},
      {"colmap-binary", colmapBinaryOf(C)},
      {"transforms", transformsOf(C)},
      {"nerf-synthetic", nerfSyntheticOf(C)}};
  for (const auto &[Name, Files] : Captures)
    for (const auto &[File, Content] : Files)
      if (auto Written = writeSample(Root / "captures" / Name / File, Content);
          !Written)
        return Written;
  const std::pair<const char *, fuzz::Seeds> Kinds[] = {
      {"colmap", fuzz::colmapSeeds()},
      {"transforms", fuzz::transformsSeeds()},
      {"photo", fuzz::photoSeeds()},
      {"exr", fuzz::exrSeeds()}};
  for (const auto &[Kind, Seeds] : Kinds)
    for (const auto &[Name, Content] : Seeds)
      if (auto Written = writeSample(Root / "seeds" / Kind / Name, Content);
          !Written)
        return Written;
  return Success{};
}

} // namespace

int main(int Count, char **Values) {
  if (Count != 2)
    return reportUsageError("splat-capture-samples", "one argument, FOLDER");
  if (const auto Done = run(Values[1]); !Done)
    return reportError("splat-capture-samples", Done.error());
  return 0;
}
