#include "accuracy/GradientReference.h"

#include "analyze/ToReference.h"
#include "io/Cameras.h"
#include "io/Metrics.h"
#include "io/Npz.h"
#include "picture/SceneUnit.h"
#include "reference/Backward.h"
#include "reference/Loss.h"
#include "reference/Render.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace vorion::splat {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char *, 5> Names{"means", "quats", "scales",
                                            "opacities", "colors"};

/// Quaternions' gradients vanish for round Gaussians: they are judged against
/// at least this share of the logarithmic scales'.
constexpr double ShareOfScales = 1e-3;
constexpr const char *LeastOfQuats = "least_norm_quats";

template <typename Vector>
std::vector<double> flat(const std::vector<Vector> &Rows) {
  std::vector<double> Values;
  Values.reserve(Rows.size() * Vector::length());
  for (const Vector &Row : Rows)
    for (int I = 0; I < Vector::length(); ++I)
      Values.push_back(Row[I]);
  return Values;
}

/// Of quaternions as they are stored, of any length.
std::vector<double> storedQuats(const std::vector<glm::dvec4> &Gradients,
                                const Scene &S) {
  std::vector<double> Values;
  Values.reserve(4 * Gradients.size());
  for (std::size_t I = 0; I < Gradients.size(); ++I) {
    double Squares = 0;
    for (std::size_t K = 0; K < 4; ++K)
      Squares += double(S.Quats[4 * I + K]) * double(S.Quats[4 * I + K]);
    for (int K = 0; K < 4; ++K)
      Values.push_back(Squares > 0 ? Gradients[I][K] / std::sqrt(Squares) : 0);
  }
  return Values;
}

std::vector<glm::dvec3> colours(const Photo &P) {
  std::vector<glm::dvec3> Pixels;
  Pixels.reserve(P.pixels());
  for (std::size_t I = 0; I + 2 < P.Rgb.size(); I += 3)
    Pixels.emplace_back(P.Rgb[I] / 255.0, P.Rgb[I + 1] / 255.0,
                        P.Rgb[I + 2] / 255.0);
  return Pixels;
}

double logScaleNorm(const reference::Gaussians<double> &G,
                    const reference::Gradients &Back) {
  double Squares = 0;
  for (std::size_t I = 0; I < Back.Scales.size(); ++I)
    for (int K = 0; K < 3; ++K) {
      const double V = Back.Scales[I][K] * G.Scales[I][K];
      Squares += V * V;
    }
  return std::sqrt(Squares);
}

NpyArray rows(std::size_t Count, const std::vector<double> &Values) {
  return NpyArray::of({Count, Count ? Values.size() / Count : 0}, Values);
}

} // namespace

Expected<Success>
writeGradientReference(const GradientFiles &Files, Scene S, const TrainView &V,
                       const std::array<float, 3> &Background) {
  reference::Options O;
  O.Background = {Background[0], Background[1], Background[2]};
  std::optional<float> Near;
  prepareToDraw(S, {V.Pose}, Rules::Inria, Near);
  O.Near = double{Near.value_or(0)};
  const auto G = toReference<double>(S);
  const auto Pose = toReference<double>(relativeTo(V.Pose, S.Origin));
  const auto Picture = reference::render(G, Pose, O);
  const auto Loss = reference::lossOf(Picture.Render, colours(V.Picture),
                                      Picture.Width, Picture.Height);
  std::vector<float> ByRender;
  reference::Upstream U;
  for (std::size_t I = 0; I < Loss.Gradient.size(); ++I) {
    glm::dvec3 Rounded(0);
    for (int K = 0; K < 3; ++K) {
      const float Value = Picture.Doubts[I] != 0
                              ? 0.0F
                              : static_cast<float>(Loss.Gradient[I][K]);
      ByRender.push_back(Value);
      Rounded[K] = Value;
    }
    U.Render.push_back(Rounded);
    U.Alpha.push_back(0);
  }
  const auto Back = reference::renderBackward(G, Pose, U, O);

  const auto Height = static_cast<std::size_t>(Picture.Height);
  const auto Width = static_cast<std::size_t>(Picture.Width);
  Camera View = V.Pose;
  View.Name = GradientFiles::View;
  if (auto Written = writeCameras(Files.Cameras, {View}); !Written)
    return Written;
  if (auto Written =
          writeNpz(Files.Upstream,
                   {{"in_v_render", NpyArray::of({Height, Width, 3}, ByRender)},
                    {"in_v_alpha",
                     NpyArray::of({Height, Width},
                                  std::vector<float>(Height * Width, 0.0F))}});
      !Written)
    return Written;
  return writeNpz(
      Files.Gradients,
      {{"f64_g_means", rows(S.size(), flat(Back.Means))},
       {"f64_g_quats", rows(S.size(), storedQuats(Back.Quats, S))},
       {"f64_g_scales", rows(S.size(), flat(Back.Scales))},
       {"f64_g_opacities", rows(S.size(), Back.Opacities)},
       {"f64_g_colors", rows(S.size(), flat(Back.Sh))},
       {LeastOfQuats,
        NpyArray::of(
            {}, std::vector<double>{ShareOfScales * logScaleNorm(G, Back)})}});
}

Expected<Json> gradientErrors(const GradientFiles &Files,
                              const std::string &File) {
  const auto Want = readNpz(Files.Gradients);
  if (!Want)
    return Want.error();
  const auto Got = readNpz(File);
  if (!Got)
    return Got.error();
  Json Errors;
  double Largest = 0;
  for (const char *Name : Names) {
    const auto Right = Want->find(fmt::format("f64_g_{}", Name));
    const auto Ours = Got->find(fmt::format("f32_g_{}", Name));
    if (Right == Want->end() || Ours == Got->end() ||
        Right->second.elements() != Ours->second.elements())
      return Error{File, fmt::format("gradients of {} and {} differ in shape, "
                                     "expected gradients of the same scene",
                                     Name, Files.Gradients)};
    const auto Least = Want->find(fmt::format("least_norm_{}", Name));
    const double Floor =
        Least == Want->end() ? 0 : Least->second.toDoubles().front();
    const double Error =
        relativeL2(Ours->second.toDoubles(), Right->second.toDoubles(), Floor);
    if (!std::isfinite(Error))
      return vorion::Error{
          File,
          fmt::format("gradients of {} are not finite, expected finite values",
                      Name)};
    Errors[Name] = Error;
    Largest = std::max(Largest, Error);
  }
  Errors["largest"] = Largest;
  return Errors;
}

} // namespace vorion::splat
