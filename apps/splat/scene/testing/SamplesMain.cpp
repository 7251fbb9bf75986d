// splat-scene-samples: writes small scenes of every format and damaged copies.
#include "io/testing/WriteSample.h"
#include "scene/testing/Damage.h"
#include "vorion/support/Diagnostics.h"

#include <filesystem>

namespace {

using namespace vorion;
using namespace vorion::splat::testing;
namespace fs = std::filesystem;

Expected<Success> write(const fs::path &Where, const Folder &Files) {
  for (const auto &[Name, Content] : Files)
    if (auto Written = writeSample(Where / Name, Content); !Written)
      return Written;
  return Success{};
}

/// A folder as SogFolderFuzzer.cpp reads it.
std::string bundled(const Folder &Files) {
  std::string Out;
  for (const auto &[Name, Content] : Files) {
    Out += static_cast<char>(Name.size());
    for (const int Shift : {0, 8, 16})
      Out += static_cast<char>(Content.size() >> Shift & 0xFF);
    Out += Name + Content;
  }
  return Out;
}

Expected<Success> run(const fs::path &Root) {
  for (const SampleFile &F : sampleFiles())
    if (auto Written = writeSample(Root / "whole" / F.Name, F.Content);
        !Written)
      return Written;
  for (const DamagedFile &F : damagedFiles())
    if (auto Written = writeSample(Root / "damaged" / F.Name, F.Content);
        !Written)
      return Written;
  for (const DamagedFolder &F : damagedFolders()) {
    if (auto Written = write(Root / "damaged" / (F.Name + ".sog.d"), F.Files);
        !Written)
      return Written;
    // A picture of 16 million pixels teaches a fuzzer nothing.
    if (F.Name != "plane-bomb")
      if (auto Written =
              writeSample(Root / "bundles" / F.Name, bundled(F.Files));
          !Written)
        return Written;
  }
  const Folder Streamed = streamedSogOf(
      randomScene(9, 1, 2), randomScene(4, 1, 3), randomScene(3, 1, 4));
  if (auto Written = write(Root / "whole" / "streamed.sog.d", Streamed);
      !Written)
    return Written;
  return writeSample(Root / "bundles" / "streamed", bundled(Streamed));
}

} // namespace

int main(int Count, char **Values) {
  if (Count != 2)
    return reportUsageError("splat-scene-samples", "one argument, FOLDER");
  if (const auto Done = run(Values[1]); !Done)
    return reportError("splat-scene-samples", Done.error());
  return 0;
}
