/// The requests of the page of `splat view`.
#pragma once

#include "accuracy/Setting.h"
#include "io/Cameras.h"
#include "picture/HeatMap.h"
#include "picture/Options.h"
#include "view/ShownScene.h"
#include "vorion/support/Expected.h"

#include <array>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace vorion::splat {

/// Largest side of a picture, pixels: larger pictures take minutes to simulate.
inline constexpr int MostViewed = 2048;

/// Largest size of a request, bytes.
inline constexpr std::size_t LargestViewRequest = 1 << 16;

/// The displayed layer of a picture.
enum class Layer {
  Picture,
  Depth,
  Error, ///< compared with the fp64 reference
  List,
  Blends,
  Cycles,
  Saturation
};
inline constexpr std::array Layers{
    Layer::Picture, Layer::Depth,  Layer::Error,     Layer::List,
    Layer::Blends,  Layer::Cycles, Layer::Saturation};
std::string_view name(Layer L);
/// The heat map of the layer, if it is one.
std::optional<Heat> heatOf(Layer L);
/// Whether \p L can be shown of \p S: heat maps have no mesh, and depths no
/// transparent one.
bool isLayerOf(Layer L, const ShownScene &S);

struct ViewRequest {
  Camera View;
  Setting Chosen;
  Layer Shown = Layer::Picture;
  bool Clock = false;   ///< also compute the cycles of the machine
  bool Compare = false; ///< also compute the error against the fp64 reference
  /// \name Coordinates of a requested pixel
  /// @{
  int X = 0, Y = 0;
  /// @}
};

/// \p C as the page has it; the lens as in cameras.json, and whether the page
/// may leave it away.
nlohmann::ordered_json cameraJson(const Camera &C);

/// \p C with the position and rotation of \p Of, where it has them.
Expected<Camera> movedCamera(Camera C, const nlohmann::json &Of);

/// The camera of a request; errors name the key.
Expected<Camera> parsePageCamera(const nlohmann::json &Of);

/// Parses JSON; errors name the key.
Expected<ViewRequest> parseViewRequest(std::string_view Text);

/// The error of a request that a newer request has superseded.
Error superseded();
/// Whether \p E is such an error.
bool isSuperseded(const Error &E);

/// The options of \p R for the scene \p Of.
RenderOptions optionsOf(const ViewRequest &R, const ShownScene &Of);

/// Whether the mesh of \p Of, if it has one, can be shown as \p R has it.
Expected<Success> checkMesh(const ViewRequest &R, const ShownScene &Of);

} // namespace vorion::splat
