/// What the page of `splat view` asks for.
#pragma once

#include "accuracy/Setting.h"
#include "io/Cameras.h"
#include "picture/HeatMap.h"
#include "picture/Options.h"
#include "vorion/support/Expected.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace vorion::splat {

/// Largest side of a picture of the page, pixels: more takes the simulated
/// machine minutes.
inline constexpr int MostViewed = 2048;

/// Of the text of a request, bytes.
inline constexpr std::size_t LargestViewRequest = 1 << 16;

/// What is shown of a picture.
enum class Layer {
  Picture,
  Depth,
  Error, ///< against the fp64 reference
  List,
  Blends,
  Cycles,
  Saturation
};
inline constexpr std::array Layers{
    Layer::Picture, Layer::Depth,  Layer::Error,     Layer::List,
    Layer::Blends,  Layer::Cycles, Layer::Saturation};
std::string_view name(Layer L);
/// The heat map that it shows, if it is one.
std::optional<Heat> heatOf(Layer L);

struct ViewRequest {
  Camera View;
  Setting Chosen;
  Layer Shown = Layer::Picture;
  bool Clock = false;   ///< with the cycles of the machine
  bool Compare = false; ///< with the error against the fp64 reference
  /// \name Of a pixel that is asked for
  /// @{
  int X = 0, Y = 0;
  /// @}
};

/// Reads JSON; errors say what is wrong with which key.
Expected<ViewRequest> parseViewRequest(std::string_view Text);

/// That a newer request took the place of one: no fault, ask again.
Error superseded();
/// Whether \p E is that.
bool isSuperseded(const Error &E);

/// The options by which \p R is drawn of a scene whose file says \p D.
RenderOptions optionsOf(const ViewRequest &R, const Drawing &D);

} // namespace vorion::splat
