// splat-capture-samples: writes a small capture of every format, and the same
// as seeds of the fuzzers.
#include "CaptureWriters.h"
#include "fuzz/Targets.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"

#include <filesystem>
#include <fmt/format.h>

namespace {

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;
namespace fs = std::filesystem;

Expected<Success> write(const fs::path &File, const std::string &Content) {
  std::error_code Failed;
  fs::create_directories(File.parent_path(), Failed);
  if (Failed)
    return Error{File.parent_path().string(),
                 fmt::format("cannot make the folder: {}, expected a folder "
                             "that can be written",
                             Failed.message())};
  return writeFileAtomically(File.string(), Content);
}

Expected<Success> run(const fs::path &Root) {
  const SampleCapture C = sampleCapture();
  const std::pair<const char *, Folder> Captures[] = {
      {"colmap-text", colmapTextOf(C)},
      {"colmap-binary", colmapBinaryOf(C)},
      {"transforms", transformsOf(C)},
      {"nerf-synthetic", nerfSyntheticOf(C)}};
  for (const auto &[Name, Files] : Captures)
    for (const auto &[File, Content] : Files)
      if (auto Written = write(Root / "captures" / Name / File, Content);
          !Written)
        return Written;
  const std::pair<const char *, fuzz::Seeds> Kinds[] = {
      {"colmap", fuzz::colmapSeeds()},
      {"transforms", fuzz::transformsSeeds()},
      {"photo", fuzz::photoSeeds()}};
  for (const auto &[Kind, Seeds] : Kinds)
    for (const auto &[Name, Content] : Seeds)
      if (auto Written = write(Root / "seeds" / Kind / Name, Content); !Written)
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
