#include "SceneFile.h"

#include "Gzip.h"
#include "Zip.h"
#include "formats/Ply.h"
#include "formats/SogFolder.h"
#include "formats/Splat.h"
#include "formats/Spz.h"
#include "vorion/support/File.h"

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
  if (Read->Gaussians.size() == 0)
    return Error{Where, "no Gaussian, expected at least one"};
  if (Options.DropNonFinite) {
    Read->Dropped = dropNonFinite(Read->Gaussians);
    if (Read->Gaussians.size() == 0)
      return Error{Where,
                   fmt::format("none of {} Gaussians is without a NaN or "
                               "an infinity, expected at least one",
                               Read->Dropped)};
  } else if (auto Finite = checkFinite(Where, Read->Gaussians); !Finite) {
    return Finite.error();
  }
  Read->DrawnAs = overruled(std::move(Read->DrawnAs), Options.Drawn);
  return Read;
}

Expected<SceneFile> parse(const std::string &Where, Bytes File,
                          const ReadOptions &Options) {
  const std::string_view Text = asText(File);
  if (Text.starts_with("ply\n") || Text.starts_with("ply\r"))
    return parsePly(Where, File);
  if (isGzip(File) || Text.starts_with("NGSP"))
    return parseSpz(Where, File);
  if (isZip(File))
    return parseSogZip(Where, File, Options);
  return parseSplat(Where, File, Options);
}

} // namespace

std::string_view name(SceneFormat F) {
  switch (F) {
  case SceneFormat::Ply:
    return "ply";
  case SceneFormat::CompressedPly:
    return "compressed-ply";
  case SceneFormat::Splat:
    return "splat";
  case SceneFormat::Spz:
    return "spz";
  case SceneFormat::Sog:
    return "sog";
  case SceneFormat::StreamedSog:
    return "streamed-sog";
  }
  __builtin_unreachable();
}

std::string_view documentedAxes(SceneFormat F) {
  switch (F) {
  case SceneFormat::Ply:
  case SceneFormat::CompressedPly:
  case SceneFormat::Splat:
    return "rdf";
  case SceneFormat::Spz:
  case SceneFormat::Sog:
  case SceneFormat::StreamedSog:
    return "rub";
  }
  __builtin_unreachable();
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
  const std::string_view Text = asText(*File);
  const std::size_t Start = Text.find_first_not_of(" \t\r\n");
  if (Start != std::string_view::npos && Text[Start] == '{')
    return checked(Path, readSogJson(Path, *File, Options), Options);
  return parseScene(Path, *File, Options);
}

} // namespace vorion::splat
