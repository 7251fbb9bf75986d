#include "Fixture.h"

#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

namespace vorion::test {
namespace {

using glm::dvec3;

/// Calls \p Take with each row of three of \p Array.
std::vector<dvec3> rows3(const std::vector<double> &V) {
  std::vector<dvec3> Rows;
  for (std::size_t I = 0; I + 2 < V.size(); I += 3)
    Rows.emplace_back(V[I], V[I + 1], V[I + 2]);
  return Rows;
}

/// Unit quaternions; what is shorter than 1e-12 counts as zero, as in the
/// training frameworks' normalisation.
std::vector<glm::dvec4> unitRows4(const std::vector<double> &V) {
  std::vector<glm::dvec4> Rows;
  for (std::size_t I = 0; I + 3 < V.size(); I += 4) {
    const glm::dvec4 Q(V[I], V[I + 1], V[I + 2], V[I + 3]);
    Rows.push_back(Q / std::max(glm::length(Q), 1e-12));
  }
  return Rows;
}

bool isTrue(const nlohmann::json &J) {
  return J.is_boolean() ? J.get<bool>()
                        : J.is_string() && J.get<std::string>() == "True";
}

/// Numbers may be written as strings; nothing for what is neither.
std::optional<double> asNumber(const nlohmann::json &J) {
  if (J.is_number())
    return J.get<double>();
  const auto Text = J.is_string() ? J.get<std::string>() : std::string();
  double Value = 0;
  const auto [End, Problem] =
      std::from_chars(Text.data(), Text.data() + Text.size(), Value);
  if (Problem != std::errc() || End != Text.data() + Text.size())
    return std::nullopt;
  return Value;
}

Expected<Success> setOptions(const std::string &Path, Fixture &F,
                             const nlohmann::json &Meta) {
  const bool Inria = F.Name.starts_with("inria_");
  const auto Options = JsonShape::object({});
  const auto Shape = Inria ? JsonShape::object({{"rules", Options}}) : Options;
  if (auto Ok = Shape.check(Meta, Path); !Ok)
    return Ok;
  F.Options.Rule = Inria ? reference::Rules::Inria : reference::Rules::Gsplat;
  F.Options.Reach =
      Inria ? reference::Support::Square3 : reference::Support::Exact;
  const nlohmann::json &Where = Inria ? Meta["rules"] : Meta;
  F.Options.Antialiased =
      isTrue(Where.value(Inria ? "antialiased" : "aa", nlohmann::json(false)));
  if (Where.contains("eps2d")) {
    const auto Dilation = asNumber(Where["eps2d"]);
    if (!Dilation)
      return Error{Path, "eps2d is wrong, expected a number"};
    F.Options.Dilation = *Dilation;
  }
  const auto B = F.doubles("in_background");
  if (B.size() != 3)
    return Error{Path, "array in_background is wrong, expected three numbers"};
  F.Options.Background = {B[0], B[1], B[2]};
  return Success{};
}

} // namespace

std::vector<double> Fixture::doubles(const std::string &Array) const {
  const auto It = Arrays.find(Array);
  return It == Arrays.end() ? std::vector<double>() : It->second.toDoubles();
}

Expected<Fixture> readFixture(const std::string &Path) {
  auto Arrays = splat::readNpz(Path);
  if (!Arrays)
    return Arrays.error();
  Fixture F;
  F.Name = std::filesystem::path(Path).stem();
  F.Arrays = std::move(*Arrays);
  for (const char *Name :
       {"in_means", "in_quats", "in_scales", "in_opacities", "in_colors",
        "in_viewmat", "in_K", "in_width", "in_height", "in_background", "meta"})
    if (!F.has(Name))
      return Error{Path, fmt::format("no array {}, expected a fixture", Name)};

  auto &G = F.Gaussians;
  G.Means = rows3(F.doubles("in_means"));
  G.Scales = rows3(F.doubles("in_scales"));
  G.Quats = unitRows4(F.doubles("in_quats"));
  G.Opacities = F.doubles("in_opacities");
  const auto &Colors = F.Arrays["in_colors"];
  if (Colors.Shape.size() == 3) {
    G.Sh = rows3(Colors.toDoubles());
    G.ShDegree = static_cast<int>(std::lround(std::sqrt(Colors.Shape[1]))) - 1;
  } else {
    G.Colors = rows3(Colors.toDoubles());
  }
  const auto V = F.doubles("in_viewmat"), K = F.doubles("in_K");
  const auto Width = F.doubles("in_width"), Height = F.doubles("in_height");
  const std::size_t N = G.size();
  if (N == 0 || G.Means.size() != N || G.Scales.size() != N ||
      G.Quats.size() != N || Colors.Shape.empty() || Colors.Shape[0] != N ||
      V.size() != 16 || K.size() != 9 || Width.size() != 1 ||
      Height.size() != 1)
    return Error{Path, "arrays of sizes that do not belong together"};
  auto &C = F.Camera;
  C.Width = static_cast<int>(Width[0]);
  C.Height = static_cast<int>(Height[0]);
  for (int I = 0; I < 3; ++I) {
    for (int J = 0; J < 3; ++J)
      C.Rotation[J][I] = V[std::size_t(4) * I + J];
    C.Translation[I] = V[std::size_t(4) * I + 3];
  }
  // As both makers of fixtures have it, for which R is a rotation exactly.
  C.Centre = -(glm::transpose(C.Rotation) * C.Translation);
  C.Focal = {K[0], K[4]};
  C.Principal = {K[2], K[5]};
  const auto Meta = parseJson<nlohmann::json>(
      F.Arrays["meta"].toText(), Path + ": array meta", "a fixture's options");
  if (!Meta)
    return Meta.error();
  if (auto Ok = setOptions(Path + ": array meta", F, *Meta); !Ok)
    return Ok.error();
  return F;
}

} // namespace vorion::test
