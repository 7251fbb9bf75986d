// Where a capture's files are, whatever its format.
#pragma once

#include "capture/Capture.h"

#include <filesystem>
#include <optional>

namespace vorion::splat {

bool fileExists(const std::filesystem::path &P);

/// What is at a path, and where its files are.
struct Location {
  CaptureFormat Format = CaptureFormat::ColmapBinary;
  /// Folder of COLMAP's files, or the file of transforms.
  std::filesystem::path Model;
  /// Folder that pictures' names start from.
  std::filesystem::path Pictures;

  bool isColmap() const {
    return Format == CaptureFormat::ColmapText ||
           Format == CaptureFormat::ColmapBinary;
  }
};

/// The capture at \p Path, a folder or a file of transforms; none if there is
/// none.
std::optional<Location> findCapture(const std::filesystem::path &Path);

/// The same where \p Path may be one of COLMAP's files.
std::optional<Location> findCameras(const std::filesystem::path &Path);

/// The picture called \p Name, whose ending may be missing.
std::filesystem::path pictureOf(const std::filesystem::path &Folder,
                                const std::string &Name);

/// The mask of the picture \p Name, in the folder \p Masks; empty for none.
std::string maskOf(const std::filesystem::path &Masks,
                   const std::filesystem::path &Name);

/// That \p Name, which \p File gives, leaves the folder it starts from; \p
/// Remedy: what would help.
Error isOutside(const std::string &File, const std::string &Name,
                std::string_view Remedy);

/// That it does not, unless \p Options allow it.
Expected<Success> checkInside(const std::string &File, const std::string &Name,
                              const CaptureOptions &Options);

/// Takes those without a picture out of \p Views, and counts them in \p C.
template <typename View>
void leaveOutMissing(std::vector<View> &Views, Capture &C) {
  C.WithoutPicture += std::erase_if(
      Views, [](const View &V) { return !fileExists(V.Picture); });
}

/// The same, where some picture must be there.
template <typename View>
Expected<Success> leaveOutSome(std::vector<View> &Views, Capture &C) {
  const std::string First = Views.front().Picture;
  leaveOutMissing(Views, C);
  if (Views.empty())
    return Error{First, "no such picture, nor any other of the capture, "
                        "expected photographs there"};
  return Success{};
}

/// That a pinhole's picture can be made of that of \p V, if one is wanted. \p
/// Kind: what \p File calls a view.
Expected<Success> checkPinhole(const std::string &File, std::string_view Kind,
                               const CaptureView &V,
                               const CaptureOptions &Options);

/// Adds the camera of \p V, which \p File has.
Expected<Success> addCamera(const std::string &File, CaptureView V, LensOf Of,
                            CaptureCameras &To);

} // namespace vorion::splat
