/// Selections of the page of `splat view`.
#pragma once

#include "io/Cameras.h"
#include "scene/Selection.h"
#include "vorion/support/Expected.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace vorion::splat {

/// A stroke over a picture: circles of \c Radius around \c Points, in pixels.
struct Stroke {
  Camera View;
  double Radius = 0;
  std::vector<std::array<double, 2>> Points;
};

struct Fainter {
  double Opacity;
};
struct Larger {
  double Deviation;
};

/// Gaussians that are added to a selection, or removed from it.
struct PickedPart {
  bool IsAdded = true;
  /// A box, a sphere (scene/Selection.h), or one of the others.
  std::variant<std::array<double, 6>, std::array<double, 4>, Fainter, Larger,
               Stroke>
      Of;
};

/// What is to happen with a selection.
enum class EditKind { Delete, Crop, Undo };

struct PickedRequest {
  std::vector<PickedPart> Parts; ///< in this order
  /// \name Of /edit
  /// @{
  std::optional<EditKind> Do;
  uint64_t Scene = 0; ///< number of the scene that it is about
  /// @}
  std::optional<Camera> View; ///< of /selection
};

/// Parses JSON; errors name the key.
Expected<PickedRequest> parsePicked(std::string_view Text);

/// The Gaussians of \p S that \p Parts select.
Selection selected(const Scene &S, const std::vector<PickedPart> &Parts);

/// The positions of the centres of the selected Gaussians in the picture of \p
/// View, relative to its size: at most \p Most, taken evenly from all that the
/// picture shows.
std::vector<std::array<float, 2>> placesOf(const Scene &S, const Selection &Of,
                                           const Camera &View,
                                           std::size_t Most);

} // namespace vorion::splat
