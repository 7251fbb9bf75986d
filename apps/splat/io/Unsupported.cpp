#include "io/Unsupported.h"

#include "vorion/support/Printable.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <span>

namespace vorion::splat {

namespace {

/// A name, or with a `*` at its end all that begin so.
struct Meaning {
  std::string_view Name, Effect;
};

std::optional<std::string_view> find(std::span<const Meaning> Known,
                                     std::string_view Name) {
  for (const Meaning &M : Known) {
    const bool Prefix = M.Name.ends_with('*');
    const std::string_view Word = M.Name.substr(0, M.Name.size() - Prefix);
    if (Prefix ? Name.starts_with(Word) : Name == Word)
      return M.Effect;
  }
  return std::nullopt;
}

constexpr std::string_view Motion = "motion over time";
constexpr std::string_view Shading = "shading by lights";
constexpr std::string_view Falloff = "another falloff than the Gaussian's";
constexpr std::string_view Lobes = "colour by spherical Gaussians";

constexpr std::array Properties{
    Meaning{"filter_3D", "Mip-Splatting's 3D filter"},
    Meaning{"filter_3d", "Mip-Splatting's 3D filter"},
    Meaning{"t", Motion},
    Meaning{"time", Motion},
    Meaning{"scale_t", Motion},
    Meaning{"trbf_*", Motion},
    Meaning{"motion_*", Motion},
    Meaning{"omega_*", Motion},
    Meaning{"rot_r_*", Motion},
    Meaning{"beta", Falloff},
    Meaning{"betas", Falloff},
    Meaning{"shape", Falloff},
    Meaning{"sg_*", Lobes},
    Meaning{"f_sg_*", Lobes},
    Meaning{"f_asg_*", Lobes},
    Meaning{"albedo*", Shading},
    Meaning{"metallic", Shading},
    Meaning{"roughness", Shading},
    Meaning{"specular*", Shading},
};

constexpr std::string_view Distortion = "lens distortion";
constexpr std::string_view Projection = "a projection without camera_model";

constexpr std::array CameraKeys{
    Meaning{"distortion*", Distortion},
    Meaning{"fisheye*", Projection},
    Meaning{"ortho*", Projection},
    Meaning{"latlong", Projection},
    Meaning{"equirectangular", Projection},
    Meaning{"ftheta_*", "an f-theta lens"},
    Meaning{"skew", "skewed pixels"},
    Meaning{"rolling_shutter_*", "a rolling shutter by velocities"},
};

/// Whether \p J says nothing: zero, false, empty, or made of such.
bool isEmpty(const nlohmann::json &J) {
  if (J.is_array() || J.is_object())
    return std::all_of(J.begin(), J.end(), isEmpty);
  return J.is_null() || (J.is_number() && J.get<double>() == 0) ||
         (J.is_boolean() && !J.get<bool>()) ||
         (J.is_string() && J.get_ref<const std::string &>().empty());
}

} // namespace

std::optional<std::string_view> unsupportedProperty(std::string_view Name) {
  return find(Properties, Name);
}

std::optional<std::string> unsupportedIn(const nlohmann::json &Record) {
  for (const auto &[Key, Value] : Record.items())
    if (const auto Meaning = find(CameraKeys, Key); Meaning && !isEmpty(Value))
      return fmt::format("key {} requires {}, which is not supported, expected "
                         "the features in docs/cameras.md",
                         printable(Key), *Meaning);
  return std::nullopt;
}

} // namespace vorion::splat
