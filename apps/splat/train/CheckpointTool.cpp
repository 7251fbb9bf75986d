// splat-checkpoint: a checkpoint of training from a scene, for the scripts of
// bench/, which time iterations of scenes that nobody has to train. Not
// installed.

#include "render/Planes.h"
#include "scene/SceneFile.h"
#include "train/run/Checkpoint.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Tool.h"

#include <charconv>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>

namespace {

using namespace vorion;
using namespace vorion::splat;

/// The state after \p Iterations that led to \p S, as if Adam's moments were 0.
Checkpoint checkpointOf(const Scene &S, unsigned Iterations) {
  Checkpoint C;
  C.Run = "{}";
  C.Iteration = Iterations;
  C.ShDegree = S.ShDegree;
  C.Geometry = geometryPlanes(S);
  C.Sh = shPlanes(S, S.ShDegree);
  for (auto *Moment : {&C.FirstGeometry, &C.SecondGeometry})
    Moment->resize(C.Geometry.size());
  for (auto *Moment : {&C.FirstSh, &C.SecondSh})
    Moment->resize(C.Sh.size());
  C.Identities.resize(S.size());
  std::iota(C.Identities.begin(), C.Identities.end(), 0U);
  C.Notes.GradientSums.resize(S.size());
  C.Notes.Views.resize(S.size());
  C.Notes.Radii.resize(S.size());
  C.Losses.resize(Iterations);
  return C;
}

Expected<Success> run(const std::string &From, unsigned Iterations,
                      const std::string &To, const std::string &Report) {
  const auto File = readScene(From);
  if (!File)
    return File.error();
  if (auto Written =
          writeCheckpoint(To, checkpointOf(File->Gaussians, Iterations));
      !Written)
    return Written;
  return writeFileAtomically(
      Report,
      jsonText(nlohmann::json{{"gaussians", File->Gaussians.size()}}) + "\n");
}

} // namespace

int main(int Count, char **Words) {
  return runTool("splat-checkpoint", [&] {
    unsigned Iterations = 0;
    const std::string Number = Count == 5 ? Words[2] : "";
    const char *const End = Number.data() + Number.size();
    const auto [Read, Failed] = std::from_chars(Number.data(), End, Iterations);
    const Expected<Success> Done =
        Failed != std::errc() || Read != End
            ? Error{"", "expected SCENE ITERATIONS CHECKPOINT REPORT",
                    ExitCode::Usage}
            : run(Words[1], Iterations, Words[3], Words[4]);
    return Done ? EXIT_SUCCESS : reportError("splat-checkpoint", Done.error());
  });
}
