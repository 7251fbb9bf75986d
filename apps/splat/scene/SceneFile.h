/// Reading of scenes in any format, which is recognized by content, never by
/// name.
#pragma once

#include "io/Bytes.h"
#include "scene/Drawing.h"
#include "scene/Scene.h"
#include "vorion/support/Expected.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

enum class SceneFormat {
#define SCENE_FORMAT(ID, NAME, AXES, ENDING, TITLE) ID,
#define SCENE_FOLDER SCENE_FORMAT
#include "scene/formats/Formats.def"
};

struct SceneFormatRecord {
  SceneFormat Format;
  std::string_view Name; ///< as reports have it: "compressed-ply"
  /// The directions of +x, +y and +z that the format's own documentation
  /// states, as in Axes.h ("rub"), empty if it states none; readers never
  /// convert to or from them.
  std::string_view Axes;
  std::string_view Ending; ///< of files' names, ".spz"; empty for folders
  std::string_view Title;  ///< for people
};

/// Those of the formats whose documentation states none.
inline constexpr std::string_view CustomaryAxes = "rdf";

/// All formats, indexed by \c SceneFormat.
std::span<const SceneFormatRecord> sceneFormats();

inline const SceneFormatRecord &recordOf(SceneFormat F) {
  return sceneFormats()[static_cast<std::size_t>(F)];
}
inline std::string_view name(SceneFormat F) { return recordOf(F).Name; }

/// A scene and the metadata of its file.
struct SceneFile {
  Scene Gaussians;
  SceneFormat Format = SceneFormat::Ply;
  int Version = 0;       ///< of the format; 0 where files carry none
  Drawing DrawnAs;       ///< as the file says, unless ReadOptions say otherwise
  std::size_t Files = 1; ///< data sets that were joined: chunks of a folder
  /// Ignored properties of a PLY that are not known to affect the picture;
  /// those that do are errors (Unsupported.h).
  std::vector<std::string> Skipped;
  /// Primitives of a glTF file without Gaussians, which mesh/Mesh.h reads.
  std::size_t Meshes = 0;
  /// The file's SH degree if it exceeds \c MaxShDegree, to which the scene is
  /// then reduced; otherwise 0.
  int ReducedFrom = 0;
  /// Number of Gaussians dropped because of a NaN or an infinity.
  std::size_t Dropped = 0;
  /// The direction that is up in the scene's coordinates, or nearly so, if the
  /// format's documented axes or a comment of a PLY state one; a unit vector.
  std::optional<std::array<double, 3>> Up = std::nullopt;
};

/// Options of readers.
struct ReadOptions {
  int LevelOfDetail = 0; ///< of a streamed scene; 0 is the finest
  /// Drop Gaussians with a NaN or an infinity, otherwise an error.
  bool DropNonFinite = false;
  DrawingRequest Drawn;
};

/// Reads a file or, for SOG, a folder. All values of the result are finite; see
/// docs/scenes.md for the precision of each format and the rejected inputs.
/// Memory is bounded by the smaller of the file's size and the size in its
/// header.
Expected<SceneFile> readScene(const std::string &Path,
                              const ReadOptions &Options = {});

/// The same for the content of a self-contained file (no folder).
Expected<SceneFile> parseScene(const std::string &Where, Bytes File,
                               const ReadOptions &Options = {});

/// Reduces \p S, as a reader made it, to \c MaxShDegree, and then sets
/// \p ReducedFrom.
void limitShDegree(Scene &S, int &ReducedFrom);

} // namespace vorion::splat
