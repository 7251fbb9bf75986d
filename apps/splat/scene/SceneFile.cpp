#include "scene/SceneFile.h"

#include "scene/Activation.h"
#include "scene/Edit.h"
#include "scene/ForeignFile.h"
#include "scene/UpDirection.h"
#include "scene/formats/Formats.h"
#include "scene/formats/Gltf.h"
#include "scene/formats/Ply.h"
#include "scene/formats/SogFolder.h"
#include "vorion/support/File.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/HostMemory.h"
#include "vorion/support/Letters.h"

#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace vorion::splat {
namespace {

/// What every scene must fulfil, whatever it came from.
Expected<SceneFile> checked(const std::string &Where, Expected<SceneFile> Read,
                            const ReadOptions &Options) {
  if (!Read)
    return Read;
  if (Options.LevelOfDetail != 0 && Read->Format != SceneFormat::StreamedSog)
    return Error{Where,
                 "has one level of detail, expected streamed SOG with "
                 "--lod",
                 ExitCode::Usage};
  if (Read->Gaussians.size() == 0)
    return Error{Where, "no Gaussians, expected at least one"};
  limitShDegree(Read->Gaussians, Read->ReducedFrom);
  resolveInfinities(Read->Gaussians);
  if (!Read->Up)
    Read->Up = upOfAxes(recordOf(Read->Format).Axes);
  if (Options.DropNonFinite) {
    Read->Dropped = dropNonFinite(Read->Gaussians);
    if (Read->Gaussians.size() == 0)
      return Error{Where,
                   fmt::format("all {} Gaussians have a NaN or an infinity, "
                               "expected at least one finite Gaussian",
                               Read->Dropped)};
  } else if (auto Finite = checkFinite(Where, Read->Gaussians); !Finite) {
    return Error{Where, Finite.error().What +
                            ", or --drop-nonfinite to drop such Gaussians"};
  }
  Read->DrawnAs = withRequest(std::move(Read->DrawnAs), Options.Drawn);
  return Read;
}

Expected<SceneFile> parse(const std::string &Where, Bytes File,
                          const ReadOptions &Options) {
#define SCENE_FORMAT(ID, NAME, AXES, ENDING, TITLE)                            \
  if (is##ID(File))                                                            \
    return parse##ID(Where, File, Options);
#include "scene/formats/Formats.def"
  if (auto Known = foreignFile(Where, File))
    return *Known;
  return parseSplat(Where, File, Options);
}

} // namespace

std::span<const SceneFormatRecord> sceneFormats() {
  static constexpr SceneFormatRecord All[] = {
#define SCENE_FORMAT(ID, NAME, AXES, ENDING, TITLE)                            \
  {SceneFormat::ID, NAME, AXES, ENDING, TITLE},
#define SCENE_FOLDER SCENE_FORMAT
#include "scene/formats/Formats.def"
  };
  return All;
}

void limitShDegree(Scene &S, int &ReducedFrom) {
  if (S.ShDegree <= MaxShDegree)
    return;
  ReducedFrom = S.ShDegree;
  setShDegree(S, MaxShDegree);
}

Expected<SceneFile> parseScene(const std::string &Where, Bytes File,
                               const ReadOptions &Options) {
  return checked(Where, parse(Where, File, Options), Options);
}

Expected<SceneFile> readScene(const std::string &Path,
                              const ReadOptions &Options) {
  std::error_code Ignored;
  if (std::filesystem::is_directory(Path, Ignored))
    return checked(Path, readSogFolder(Path, Options), Options);
  const auto File = readFile(Path);
  if (!File)
    return File.error();
  if (File->empty())
    return Error{Path, "an empty file, expected a scene"};
  if (isGltf(*File))
    return checked(Path, readGltf(Path, *File, Options), Options);
  // A .splat may begin with any byte.
  if (isText(*File) && trimmed(asText(*File), " \t\r\n").starts_with('{'))
    return checked(Path, readSogJson(Path, *File, Options), Options);
  // The only format whose files are as large as their scenes.
  if (isPly(*File))
    return checked(Path, parsePly(Path, *File, Options, releasePages), Options);
  return parseScene(Path, *File, Options);
}

} // namespace vorion::splat
