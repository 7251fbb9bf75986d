#include "cameras/CameraFile.h"

#include "cameras/CameraPath.h"
#include "vorion/support/File.h"
#include "vorion/support/Hash.h"
#include "vorion/support/Json.h"

#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>

namespace vorion::splat {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char *Wanted =
    "INRIA's cameras.json, transforms.json, nerfstudio's camera path, or a "
    "folder with COLMAP's cameras.bin or .txt";

/// The list that \p Path holds, whose content is \p Document.
Expected<CameraFile> listOf(const std::string &Path,
                            const Expected<Json> &Document) {
  if (!Document)
    return Document.error();
  auto Cameras = parseCameras(Path, *Document);
  if (!Cameras)
    return Cameras.error();
  return CameraFile{std::move(*Cameras), {Path}};
}

/// The list in the folder \p Path, as INRIA's trainer leaves it; none in a
/// capture.
std::optional<std::string> listIn(const fs::path &Path) {
  std::error_code Ignored;
  const fs::path List = Path / "cameras.json";
  if (isCapture(Path.string()) || !fs::exists(List, Ignored))
    return std::nullopt;
  return List.string();
}

Expected<CameraFile> captureOf(const std::string &Path, LensOf Of) {
  auto Capture = readCaptureCameras(Path, Of);
  if (!Capture)
    return Capture.error();
  return CameraFile{std::move(Capture->Cameras), std::move(Capture->Files)};
}

Expected<CameraFile> jsonOf(const std::string &Path, LensOf Of) {
  const auto Document = readJson<Json>(Path, Wanted);
  if (!Document)
    return Document.error();
  if (Document->is_array())
    return listOf(Path, Document);
  if (isCameraPath(*Document)) {
    auto Cameras = parseCameraPath(Path, *Document);
    if (!Cameras)
      return Cameras.error();
    return CameraFile{std::move(*Cameras), {Path}};
  }
  if (Document->is_object() && Document->contains("frames"))
    return captureOf(Path, Of);
  return Error{Path, fmt::format("no cameras, expected {}", Wanted)};
}

} // namespace

Expected<CameraFile> readCameraFile(const std::string &Path, LensOf Of) {
  std::error_code Ignored;
  if (fs::is_directory(Path, Ignored)) {
    if (const auto List = listIn(Path))
      return listOf(*List, readRegularJson<Json>(*List, "an array of cameras"));
    return captureOf(Path, Of);
  }
  const fs::path Ending = fs::path(Path).extension();
  if (Ending == ".bin" || Ending == ".txt")
    return captureOf(Path, Of);
  return jsonOf(Path, Of);
}

std::vector<std::string> cameraFiles(const std::string &Path) {
  if (const auto List = listIn(Path))
    return {*List};
  return captureFiles(Path);
}

Expected<std::string> hashCameraFile(const std::string &Path) {
  const auto Read = readCameraFile(Path);
  if (!Read)
    return Read.error();
  if (Read->Files.size() == 1)
    return fnv1a64OfFile(Read->Files.front());
  std::string Hashes;
  for (const std::string &File : Read->Files) {
    const auto Hash = fnv1a64OfFile(File);
    if (!Hash)
      return Hash.error();
    Hashes += fmt::format("{} {}\n", *Hash, fs::path(File).filename().string());
  }
  return fnv1a64(Hashes);
}

} // namespace vorion::splat
