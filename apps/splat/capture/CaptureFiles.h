// Locations of a capture's files in all formats.
#pragma once

#include "capture/Capture.h"

#include <filesystem>
#include <optional>

namespace vorion::splat {

bool fileExists(const std::filesystem::path &P);

/// Whether the extension of \p Path is that of a picture which splat reads.
bool isPictureName(const std::filesystem::path &Path);

/// The format of a capture, and the locations of its files.
struct Location {
  CaptureFormat Format = CaptureFormat::ColmapBinary;
  /// Folder of COLMAP's files, or transforms.json.
  std::filesystem::path Model;
  /// The capture's folder.
  std::filesystem::path Root;
  /// What is said of the model if there is a choice; or empty.
  std::string Note;

  bool isColmap() const {
    return Format == CaptureFormat::ColmapText ||
           Format == CaptureFormat::ColmapBinary;
  }
};

/// The capture at \p Path, a folder or transforms.json; empty if there is none.
/// Of several models of COLMAP in one place, it is that of the most images. If
/// it has no pictures in their places, and \p NeedsPictures, a model that has
/// some precedes it.
std::optional<Location> findCapture(const std::filesystem::path &Path,
                                    bool NeedsPictures = true);

/// The same for poses, which need no pictures; \p Path may also be one of
/// COLMAP's files.
std::optional<Location> findCameras(const std::filesystem::path &Path);

/// The picture \p Name, with or without extension.
std::filesystem::path pictureOf(const std::filesystem::path &Folder,
                                const std::string &Name);

/// The folders in which the pictures of the model at \p F may be, the most
/// likely first; \p Given is the user's choice, or empty.
std::vector<std::filesystem::path> pictureFolders(const Location &F,
                                                  const std::string &Given);

/// Where the capture's pictures \p Names are: in the first folder that has any
/// of them, else missing in the first. Adds to \p Notes.
struct PicturePlaces {
  std::filesystem::path Folder;
  std::vector<std::filesystem::path> Files; ///< one for each name
};
PicturePlaces findPictures(const std::vector<std::filesystem::path> &Folders,
                           const std::vector<std::string> &Names,
                           std::vector<std::string> &Notes);

/// The mask of the picture \p Name, in the folder \p Masks; empty for none.
std::string maskOf(const std::filesystem::path &Masks,
                   const std::filesystem::path &Name);

/// The error that \p Name in \p File is outside its folder; \p Remedy is the
/// suggested fix.
Error isOutside(const std::string &File, const std::string &Name,
                std::string_view Remedy);

/// Checks that \p Name in \p File is inside its folder, unless \p Options allow
/// otherwise.
Expected<Success> checkInside(const std::string &File, const std::string &Name,
                              const CaptureOptions &Options);

/// Removes views without a picture from \p Views, and counts them in \p C.
template <typename View>
void leaveOutMissing(std::vector<View> &Views, Capture &C) {
  C.WithoutPicture += std::erase_if(
      Views, [](const View &V) { return !fileExists(V.Picture); });
}

/// The same; an error if no picture exists.
template <typename View>
Expected<Success> leaveOutSome(std::vector<View> &Views, Capture &C) {
  const std::string First = Views.front().Picture;
  leaveOutMissing(Views, C);
  if (Views.empty())
    return Error{First, "no such picture, nor any other of the capture, "
                        "expected photographs there"};
  return Success{};
}

/// Checks that the picture of \p V can be undistorted, if \p Options request
/// it. \p Kind is the term for a view in \p File.
Expected<Success> checkPinhole(const std::string &File, std::string_view Kind,
                               const CaptureView &V,
                               const CaptureOptions &Options);

/// Adds the camera of \p V from \p File.
Expected<Success> addCamera(const std::string &File, CaptureView V, LensOf Of,
                            CaptureCameras &To);

} // namespace vorion::splat
