/// Scenes that tests draw: of any shape, from a seed.
#pragma once

#include "raster/Command.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace vorion::raster {

struct Scene {
  std::vector<Gaussian> Gaussians;
  unsigned X, Y, Width, Height;
  float Cutoff;
  bool StopAtEqual;
};

/// Gaussians of all sizes around a tile of any shape; some saturate it.
inline Scene randomScene(uint32_t Seed) {
  std::mt19937 Engine(Seed);
  const auto Uniform = [&](double Low, double High) {
    return static_cast<float>(Low + (High - Low) * Engine() / 0x1p32);
  };
  const auto Size = [&] { return 1 + Engine() % VR_MAX_TILE; };
  Scene S;
  S.Width = Size();
  S.Height = Size();
  S.X = Engine() % 2000;
  S.Y = Engine() % 2000;
  S.Cutoff = Seed % 4 == 0 ? 0.0F : Uniform(1e-5, 0.05);
  S.StopAtEqual = Seed % 2;
  for (unsigned I = 0, N = Engine() % 400; I != N; ++I) {
    // Sigma 1 = R diag(s0^2, s1^2) R^T; the conic is its inverse.
    const double S0 = std::exp(Uniform(-1, 3));
    const double S1 = std::exp(Uniform(-1, 3));
    const double Angle = Uniform(0, 3.15);
    const double Cos = std::cos(Angle);
    const double Sin = std::sin(Angle);
    const double A = Cos * Cos / (S0 * S0) + Sin * Sin / (S1 * S1);
    const double B = Cos * Sin * (1 / (S0 * S0) - 1 / (S1 * S1));
    const double C = Sin * Sin / (S0 * S0) + Cos * Cos / (S1 * S1);
    const double Det = A * C - B * B;
    S.Gaussians.push_back(
        {{static_cast<float>(S.X) + Uniform(-20, 84),
          static_cast<float>(S.Y) + Uniform(-20, 84)},
         {static_cast<float>(A), static_cast<float>(B), static_cast<float>(C)},
         Uniform(0, 1.1),
         {Uniform(0, 1), Uniform(0, 1), Uniform(0, 1)},
         {static_cast<float>(3 * std::sqrt(C / Det)),
          static_cast<float>(3 * std::sqrt(A / Det))},
         I});
  }
  return S;
}

} // namespace vorion::raster
