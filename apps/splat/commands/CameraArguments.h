/// What subcommands that draw take about cameras.
#pragma once

#include "cameras/Vector.h"
#include "io/Cameras.h"
#include "scene/Scene.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

struct CameraArguments {
  std::string File;               ///< or a folder; empty: a view is found
  std::vector<std::string> Views; ///< empty: the first, or all of a motion
  int Orbit = 0, Frames = 0;      ///< views of a motion, 0 for none
  std::string Size;               ///< WIDTHxHEIGHT; empty: the cameras', or
                                  ///< DefaultSize
  bool Distorted = false;         ///< through the photographs' lenses
  std::string Up;                 ///< an axis, as -y; empty: by the cameras, or
                                  ///< by the scene

  /// Whether one picture is asked for; "all" may be one too.
  bool isOne() const {
    return Orbit == 0 && Frames == 0 &&
           (Views.empty() || (Views.size() == 1 && Views.front() != "all"));
  }
};

inline constexpr const char *DefaultSize = "640x360";

/// Declares --cameras and --up, and of several pictures --size, --orbit and
/// --frames; \p A must outlive the parsing. --view is the caller's.
void addCameraOptions(CLI::App &App, CameraArguments &A, bool Several);

/// The cameras of \p A, of which only those that --view names. Without
/// --cameras one is found that sees \p S well.
Expected<std::vector<Camera>> chooseCameras(const CameraArguments &A,
                                            const Scene &S);

/// All cameras of the file, or those of the motion, or the one that is found;
/// --view says where a motion starts, or which views it goes through.
Expected<std::vector<Camera>> allCameras(const CameraArguments &A,
                                         const Scene &S);

/// What is up in \p S, a unit vector: as --up says, else as \p Cameras have it
/// if they are of a file, else by the scene's flat Gaussians.
Vector upOf(const CameraArguments &A, const std::vector<Camera> &Cameras,
            const Scene &S);

} // namespace vorion::splat
