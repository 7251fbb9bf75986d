/// How a scene was trained to be drawn, as far as its file says: another way
/// gives another picture.
#pragma once

#include "vorion/support/Expected.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace vorion::splat {

struct Drawing {
  /// With opacity compensated for the dilation.
  bool Antialiased = false;
  /// The dilation, px^2, where it is another than both conventions' 0.3.
  std::optional<double> Dilation;
  /// What says so, for people, as "comment SplatRenderMode: mip"; empty where
  /// the file says nothing, which means the classic way.
  std::string Source;

  /// Whether both give the same picture.
  bool drawsAs(const Drawing &Other) const {
    return Antialiased == Other.Antialiased && Dilation == Other.Dilation;
  }
};

/// Whether \p Variance, px^2, can be a dilation: kernels have floats.
bool isDilation(double Variance);
inline constexpr std::string_view ExpectedDilation =
    "a variance of 0 to 3.4e38 px^2";

/// What a user says against the file.
struct DrawingRequest {
  std::optional<bool> Antialiased;
  std::optional<double> Dilation;
};
Drawing withRequest(Drawing D, const DrawingRequest &R);

/// What the comments of a PLY say, each without its keyword; of several the
/// last counts. Read are, in any case of letters:
/// - `SplatRenderMode: default|mip` (Brush, splat-transform). A file that also
///   says `Exported from Brush` has Brush's dilation for it, 0.1;
/// - `antialiased 0|1` (Postshot);
/// - `Dilation: PX2`, which drawingComments() writes.
/// An Error names what calls for something else: 2D Gaussians, modes that are
/// not known.
Expected<Drawing> drawingOfComments(const std::string &Where,
                                    std::span<const std::string> Comments);

/// What the key "model" of a SOG's description says: default, antialiased, or
/// an Error as above.
Expected<Drawing> drawingOfModel(const std::string &Where,
                                 std::string_view Model);

/// That the properties of a PLY, which has no scale_2, are those of 2D
/// Gaussians.
Error flatGaussians(const std::string &Where, std::string_view Said);

/// The header lines of a PLY that say \p D; empty for the classic way.
std::string drawingComments(const Drawing &D);

} // namespace vorion::splat
