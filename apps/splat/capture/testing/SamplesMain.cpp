// splat-capture-samples: writes a small capture of every format, and the same
// as seeds of the fuzzers.
#include "CaptureWriters.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"

#include <filesystem>
#include <fmt/format.h>

namespace {

using namespace vorion;
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

/// A model as ColmapFuzzer.cpp reads it.
std::string bundled(Folder F, bool Text) {
  std::string Out(1, Text ? '\1' : '\0');
  for (const char *Name : {"cameras", "images", "points3D"}) {
    const std::string &Content =
        F[fmt::format("sparse/0/{}.{}", Name, Text ? "txt" : "bin")];
    for (const int Shift : {0, 8})
      Out += static_cast<char>(Content.size() >> Shift & 0xFF);
    Out += Content;
  }
  return Out;
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
  const std::pair<const char *, std::string> Seeds[] = {
      {"colmap/text", bundled(colmapTextOf(C), true)},
      {"colmap/binary", bundled(colmapBinaryOf(C), false)},
      {"transforms/own", transformsOf(C)["transforms.json"]},
      {"transforms/nerf", nerfSyntheticOf(C)["transforms_train.json"]},
      {"photo/png", pngOf(2, 2, std::string(16, '\x33'))},
      {"photo/webp", webpOf(2, 2, std::string(16, '\x33'))}};
  for (const auto &[Name, Content] : Seeds)
    if (auto Written = write(Root / "seeds" / Name, Content); !Written)
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
