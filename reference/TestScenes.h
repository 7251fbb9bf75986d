/// Small inputs that the reference's unit tests share.
#pragma once

#include "Types.h"

#include <glm/vec3.hpp>
#include <random>

namespace vorion::reference {

/// A camera at the origin that looks along +z.
inline Camera<double> frontCamera(int Width, int Height, double Focal) {
  Camera<double> C;
  C.Width = Width;
  C.Height = Height;
  C.Rotation = glm::dmat3(1);
  C.Translation = C.Centre = glm::dvec3(0);
  C.Focal = {Focal, Focal};
  C.Principal = {0.5 * Width, 0.5 * Height};
  return C;
}

/// Appends a round Gaussian of a given colour.
inline void addRound(Gaussians<double> &G, glm::dvec3 Mean, double Scale,
                     double Opacity, glm::dvec3 Color) {
  G.Means.push_back(Mean);
  G.Scales.emplace_back(Scale);
  G.Quats.emplace_back(1, 0, 0, 0);
  G.Opacities.push_back(Opacity);
  G.Colors.push_back(Color);
}

/// \p Count Gaussians of all shapes in front of \c frontCamera, and a few
/// behind it.
inline Gaussians<double> randomGaussians(std::size_t Count, unsigned Seed) {
  std::mt19937 Engine(Seed);
  // Not std::uniform_real_distribution, whose values are up to the library.
  const auto Uniform = [&](double Low, double High) {
    return Low + (High - Low) * double(Engine()) / double(Engine.max());
  };
  Gaussians<double> G;
  for (std::size_t I = 0; I < Count; ++I) {
    G.Means.emplace_back(Uniform(-1.5, 1.5), Uniform(-1.5, 1.5),
                         Uniform(-0.2, 4));
    G.Scales.emplace_back(std::exp(Uniform(-6, -1)), std::exp(Uniform(-6, -1)),
                          std::exp(Uniform(-6, -1)));
    glm::dvec4 Q(Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1),
                 Uniform(-1, 1));
    G.Quats.push_back(Q /
                      std::sqrt(Q.x * Q.x + Q.y * Q.y + Q.z * Q.z + Q.w * Q.w));
    G.Opacities.push_back(Uniform(0.01, 1));
    G.Colors.emplace_back(Uniform(0, 1), Uniform(0, 1), Uniform(0, 1));
  }
  return G;
}

} // namespace vorion::reference
