#include "scene/ForeignFile.h"

#include "scene/SceneFile.h"
#include "vorion/support/FileKind.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {
namespace {

/// What messages call \p File of kind \p K here.
std::string nameHere(FileKind K, Bytes File) {
  if (K == FileKind::Zip)
    return "a zip archive without the meta.json of SOG";
  if (K == FileKind::Json)
    return "JSON that does not describe a scene";
  return describe(K, File);
}

/// How the owner of \p File of kind \p K may come to a scene.
std::string_view sceneAdvice(FileKind K, Bytes File) {
  if (K == FileKind::WebP)
    return "use the SOG's meta.json if this is one of its pictures";
  if (K == FileKind::Json)
    return "SOG has a meta.json or lod-meta.json, glTF has the key asset";
  switch (useOf(K, File)) {
  case FileUse::Weights:
    return "export it as .ply with the program that trained it (nerfstudio: "
           "ns-export gaussian-splat)";
  case FileUse::MovingScene:
    return "export one moment of it as .ply";
  case FileUse::Model:
    return "if Gaussians are in it, export them as .ply with the program that "
           "wrote it";
  case FileUse::Picture:
  case FileUse::OtherPicture:
  case FileUse::Film:
  case FileUse::Points:
    return "`splat train` makes a scene from photographs whose cameras are "
           "known";
  case FileUse::Archive:
  case FileUse::Packed:
    return "unpack it, and use the scene in it";
  case FileUse::Cameras:
    return "pass it as --cameras, together with a scene";
  default:
    return adviceFor(useOf(K, File));
  }
}

Error foreign(const std::string &Where, FileKind K, Bytes File) {
  const std::string_view Advice = sceneAdvice(K, File);
  return {Where,
          fmt::format("{}, expected a scene of Gaussians{}{}",
                      nameHere(K, File), Advice.empty() ? "" : "; ", Advice)};
}

} // namespace

std::optional<Error> foreignFile(const std::string &Where, Bytes File) {
  const FileKind K = fileKindOf(File);
  if (K == FileKind::Unknown)
    return std::nullopt;
  return K == FileKind::PlainText ? unknownFile(Where)
                                  : foreign(Where, K, File);
}

Error foreignArchive(const std::string &Where,
                     const std::vector<std::string> &Names) {
  return foreign(Where, archiveKindOf(Names), {});
}

Error foreignJson(const std::string &Where, const nlohmann::json &Root) {
  return foreign(Where, objectKindOf([&Root](std::string_view Key) {
                   return Root.contains(Key);
                 }),
                 {});
}

Error unknownFile(const std::string &Where) {
  std::string Endings;
  for (const SceneFormatRecord &F : sceneFormats())
    if (F.Format != SceneFormat::Splat && !F.Ending.empty())
      Endings += std::string(F.Ending) + ", ";
  return {Where, fmt::format("not a scene in a known format, expected {}or "
                             ".splat of 32 bytes per Gaussian",
                             Endings)};
}

} // namespace vorion::splat
