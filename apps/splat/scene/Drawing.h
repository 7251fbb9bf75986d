/// The rendering mode for which a scene was trained, as far as its file records
/// it.
#pragma once

#include "vorion/support/Expected.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace vorion::splat {

/// How a Gaussian is evaluated: as a footprint on the picture; or where it is
/// densest on each pixel's ray, in the order of the means' depths, of flat ones
/// with the low pass of 2D Gaussians; or, traced through a tree, in the order
/// along the ray.
enum class RendererKind { Splat, Ray, Surfel, Trace };

constexpr std::string_view name(RendererKind K) {
  constexpr std::array<std::string_view, 4> Names{"splat", "ray", "surfel",
                                                  "trace"};
  return Names[static_cast<std::size_t>(K)];
}

/// Whether the records of the lists are of rays.
constexpr bool hasRayRecords(RendererKind K) {
  return K == RendererKind::Ray || K == RendererKind::Surfel;
}

/// Whether densities along rays have a degree to choose.
constexpr bool hasFalloffDegree(RendererKind K) {
  return K == RendererKind::Ray || K == RendererKind::Trace;
}

/// Those for which scenes are trained, and which files record.
inline constexpr std::array<RendererKind, 3> TrainedRenderers{
    RendererKind::Splat, RendererKind::Ray, RendererKind::Surfel};

/// The one of these with the name \p Name.
std::optional<RendererKind> trainedRenderer(std::string_view Name);

struct Drawing {
  /// With opacity compensated for the dilation.
  bool Antialiased = false;
  /// The dilation, px^2, if it differs from 0.3 of both conventions.
  std::optional<double> Dilation;
  /// What says so, for people, as "comment SplatRenderMode: mip"; empty if the
  /// file records nothing, which means the classic mode.
  std::string Source;
  /// Splat, Ray or Surfel; the other members are of Splat.
  RendererKind Renderer = RendererKind::Splat;
  /// Of rays: with q the square of the distance in standard deviations, 2 is a
  /// density of exp(-q / 2), 4 of exp(-q^2 / 18) (3DGRT).
  unsigned FalloffDegree = 2;

  /// Whether both give the same picture.
  bool drawsAs(const Drawing &Other) const {
    return Antialiased == Other.Antialiased && Dilation == Other.Dilation &&
           Renderer == Other.Renderer && FalloffDegree == Other.FalloffDegree;
  }
};

/// Whether \p Variance, px^2, is a valid dilation in single precision.
bool isDilation(double Variance);
inline constexpr std::string_view ExpectedDilation =
    "a variance of 0 to 3.4e38 px^2";

/// The user's overrides of the file.
struct DrawingRequest {
  std::optional<bool> Antialiased;
  std::optional<double> Dilation;
  // May be left out: NOLINTNEXTLINE(readability-redundant-member-init)
  std::optional<RendererKind> Renderer{};
  // NOLINTNEXTLINE(readability-redundant-member-init)
  std::optional<unsigned> FalloffDegree{};
};
Drawing withRequest(Drawing D, const DrawingRequest &R);

/// Parses the comments of a PLY, given without the keyword; the last of several
/// is used. Recognized, case-insensitively:
/// - `SplatRenderMode: default|mip|2dgs` (Brush, splat-transform). A file that
///   also says `Exported from Brush` has Brush's dilation for it, 0.1;
/// - `antialiased 0|1` (Postshot);
/// - `Dilation: PX2`, `SplatRenderer: splat|ray|surfel` and
///   `SplatFalloffDegree: 2|4`, as drawingComments() writes them.
/// Errors: unknown modes, renderers and degrees.
Expected<Drawing> drawingOfComments(const std::string &Where,
                                    std::span<const std::string> Comments);

/// Parses the key "model" of a SOG's description: default, antialiased, 2dgs,
/// or an error as above.
Expected<Drawing> drawingOfModel(const std::string &Where,
                                 std::string_view Model);

/// The header lines of a PLY that record \p D; empty for the classic mode.
std::string drawingComments(const Drawing &D);

} // namespace vorion::splat
