#include "Gradients.h"

#include "Convert.h"
#include "io/Metrics.h"
#include "reference/AlongRays.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace vorion::test {
namespace {

using splat::NpyArray;

/// Quaternions' gradients vanish for round Gaussians: they are judged against
/// at least this share of the logarithmic scales'.
constexpr double ShareOfScales = 1e-3;

template <typename T>
std::vector<double> flat(const std::vector<T> &V, int Count) {
  std::vector<double> Out;
  Out.reserve(V.size() * static_cast<std::size_t>(Count));
  for (const T &E : V)
    for (int K = 0; K < Count; ++K)
      Out.push_back(E[K]);
  return Out;
}

/// Of the quaternions \p Stored, of any length.
std::vector<double> storedQuats(const std::vector<double> &Stored,
                                const reference::Gradients &D) {
  std::vector<double> Out;
  Out.reserve(Stored.size());
  for (std::size_t I = 0; I < D.Quats.size(); ++I) {
    const glm::dvec4 Q(Stored[4 * I], Stored[4 * I + 1], Stored[4 * I + 2],
                       Stored[4 * I + 3]);
    for (int K = 0; K < 4; ++K)
      Out.push_back(D.Quats[I][K] / std::max(glm::length(Q), 1e-12));
  }
  return Out;
}

double logScaleNorm(const reference::Gaussians<double> &G,
                    const reference::Gradients &D) {
  std::vector<double> V;
  for (std::size_t I = 0; I < D.Scales.size(); ++I)
    for (int K = 0; K < 3; ++K)
      V.push_back(D.Scales[I][K] * G.Scales[I][K]);
  return norm(V);
}

void addSums(splat::Npz &Arrays, const std::vector<reference::SplatSums> &All) {
  const std::vector<std::size_t> Shape{All.size()};
  std::vector<double> Colors;
  std::array<std::vector<double>, 6> Moments;
  for (const auto &S : All) {
    for (int K = 0; K < 3; ++K)
      Colors.push_back(S.Color[K]);
    const double Values[] = {S.S, S.Sd.x, S.Sd.y, S.Sdd[0], S.Sdd[1], S.Sdd[2]};
    for (std::size_t M = 0; M < Moments.size(); ++M)
      Moments[M].push_back(Values[M]);
  }
  Arrays["f64_h_dc"] = NpyArray::of({All.size(), 3}, Colors);
  constexpr const char *Names[] = {"f64_h_s",    "f64_h_sdx",  "f64_h_sdy",
                                   "f64_h_sdxx", "f64_h_sdxy", "f64_h_sdyy"};
  for (std::size_t M = 0; M < Moments.size(); ++M)
    Arrays[Names[M]] = NpyArray::of(Shape, Moments[M]);
}

/// The gradient that is judged as sum \p Name is where a fixture has no sums:
/// what follows from it alone.
std::string gradientLike(const std::string &Name) {
  if (Name == "h_dc")
    return "g_colors";
  if (Name == "h_s")
    return "g_opacities";
  if (Name == "h_sdx" || Name == "h_sdy")
    return "g_means2d";
  return Name.starts_with("h_") ? "g_conics" : Name;
}

/// Relative to the fp64 array, the error of the fp32 one; 0 without them.
double ownError(const Fixture &F, const std::string &Name, double Scale) {
  const auto Exact = F.doubles("f64_" + Name),
             Single = F.doubles("f32_" + Name);
  return Exact.size() == Single.size() ? splat::relativeL2(Single, Exact, Scale)
                                       : 0;
}

void leaveOut(reference::Upstream &U, const std::vector<uint8_t> &Doubts) {
  for (std::size_t I = 0; I < Doubts.size(); ++I)
    if (Doubts[I]) {
      U.Render[I] = glm::dvec3(0);
      U.Alpha[I] = 0;
    }
}

splat::Npz arraysOf(const reference::Upstream &U,
                    const reference::Camera<double> &C) {
  const auto H = static_cast<std::size_t>(C.Height);
  const auto W = static_cast<std::size_t>(C.Width);
  return {{"in_v_render", NpyArray::of({H, W, 3}, flat(U.Render, 3))},
          {"in_v_alpha", NpyArray::of({H, W}, U.Alpha)}};
}

/// Without what only footprints have.
splat::Npz arraysOf(const reference::Gradients &D,
                    const reference::Gaussians<double> &G,
                    const std::vector<double> &Stored) {
  const std::size_t N = G.size();
  splat::Npz E{{"f64_g_means2d", NpyArray::of({N, 2}, flat(D.Means2d, 2))},
               {"f64_g_means", NpyArray::of({N, 3}, flat(D.Means, 3))},
               {"f64_g_scales", NpyArray::of({N, 3}, flat(D.Scales, 3))},
               {"f64_g_quats", NpyArray::of({N, 4}, storedQuats(Stored, D))},
               {"f64_g_opacities", NpyArray::of({N}, D.Opacities)}};
  // Direct colours are a scene's constant harmonic: h_dc is their gradient.
  if (G.Colors.empty())
    E["f64_g_colors"] = NpyArray::of({N, D.Sh.size() / N, 3}, flat(D.Sh, 3));
  return E;
}

/// Adds `norm_NAME` and `limit_NAME`. \p OwnError: of an array, by its name and
/// what it is relative to.
template <typename Function>
void judge(splat::Npz &E, double LogScaleNorm, Function OwnError) {
  splat::Npz Judged;
  for (const auto &[Name, Array] : E) {
    const double Scale =
        Name == "f64_g_quats" ? ShareOfScales * LogScaleNorm : 0;
    Judged["norm_" + Name] = NpyArray::of(
        {}, std::vector<double>{std::max(norm(Array.toDoubles()), Scale)});
    Judged["limit_" + Name] =
        NpyArray::of({}, std::vector<double>{2 * OwnError(Name, Scale)});
  }
  E.merge(Judged);
}

} // namespace

double norm(const std::vector<double> &V) {
  double Sum = 0;
  for (const double E : V)
    if (!std::isnan(E))
      Sum += E * E;
  return std::sqrt(Sum);
}

reference::Upstream upstreamOf(const Fixture &F) {
  reference::Upstream U;
  const auto V = F.doubles("in_v_render");
  for (std::size_t I = 0; I + 2 < V.size(); I += 3)
    U.Render.emplace_back(V[I], V[I + 1], V[I + 2]);
  U.Alpha = F.doubles("in_v_alpha");
  return U;
}

GradientFiles gradientsOf(const Fixture &F,
                          const std::vector<uint8_t> &Doubts) {
  reference::Upstream U = upstreamOf(F);
  leaveOut(U, Doubts);
  const auto D = reference::renderBackward(F.Gaussians, F.Camera, U, F.Options);
  GradientFiles Files{arraysOf(U, F.Camera),
                      arraysOf(D, F.Gaussians, F.doubles("in_quats"))};
  splat::Npz &E = Files.Expected;
  E["f64_g_conics"] = NpyArray::of({F.Gaussians.size(), 3}, flat(D.Conics, 3));
  addSums(E, D.Sums);
  judge(E, logScaleNorm(F.Gaussians, D),
        [&](const std::string &Name, double Scale) {
          return ownError(F, gradientLike(Name.substr(4)), Scale);
        });
  return Files;
}

GradientFiles gradientsAlongRays(const splat::Scene &S,
                                 const reference::Camera<double> &C,
                                 const reference::Options &O,
                                 reference::Upstream U) {
  const auto G = splat::toReference<double>(S);
  leaveOut(U, reference::renderAlongRays(G, C, O).Doubts);
  const auto D = reference::alongRaysBackward(G, C, U, O);
  GradientFiles Files{arraysOf(U, C),
                      arraysOf(D, G, {S.Quats.begin(), S.Quats.end()})};
  judge(Files.Expected, logScaleNorm(G, D),
        [](const std::string &, double) { return 0.; });
  return Files;
}

} // namespace vorion::test
