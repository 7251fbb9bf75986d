/// Camera options of the subcommands that render.
#pragma once

#include "io/Cameras.h"
#include "io/Vector.h"
#include "picture/Options.h"
#include "scene/SceneFile.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

struct CameraArguments {
  std::string File;               ///< or a folder; empty: automatic view
  std::vector<std::string> Views; ///< empty: the first, or all views of a
                                  ///< motion
  int Orbit = 0, Frames = 0;      ///< number of views of a motion, 0 for none
  std::string Size;       ///< WIDTH[xHEIGHT]; empty: that of the cameras,
                          ///< or DefaultSize
  bool Distorted = false; ///< with the lens distortion of the
                          ///< photographs
  std::string Up;         ///< an axis such as -y; empty: estimated from
                          ///< cameras or scene

  /// Whether one picture is requested; "all" may also be one picture.
  bool isOne() const {
    return Orbit == 0 && Frames == 0 &&
           (Views.empty() || (Views.size() == 1 && Views.front() != "all"));
  }
};

inline constexpr const char *DefaultSize = "640x360";

/// Declares --cameras and --up, and if \p Several also --size, --orbit and
/// --frames. The caller declares --view. \p A must outlive the parsing.
void addCameraOptions(CLI::App &App, CameraArguments &A, bool Several);

/// Declares --size.
void addSizeOption(CLI::App &App, CameraArguments &A);

/// The cameras of \p A that --view selects. Without --cameras, an automatic
/// view of \p S.
Expected<std::vector<Camera>> chooseCameras(const CameraArguments &A,
                                            const SceneFile &S);

/// All cameras of the file or of the motion, or the automatic view. --view
/// selects the start of a motion, or the views along it.
Expected<std::vector<Camera>> allCameras(const CameraArguments &A,
                                         const SceneFile &S);

/// chooseCameras() for pictures of \p S, which is measured from an origin near
/// it if needed (\c recentre()). \p Near, if empty, follows the unit of a scene
/// that all cameras of the file see from less than 1 (SceneUnit.h).
Expected<std::vector<Camera>> camerasToDraw(const CameraArguments &A,
                                            SceneFile &S, Rules Convention,
                                            std::optional<float> &Near);

/// The up direction of \p S, a unit vector: that of --up; otherwise that of \p
/// Cameras if they are from a file; otherwise that of focusOf().
Vector upOf(const CameraArguments &A, const std::vector<Camera> &Cameras,
            const SceneFile &S);

} // namespace vorion::splat
