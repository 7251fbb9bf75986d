#include "demo/Surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>

namespace vorion::splat::demo {

namespace {
constexpr float Pi = std::numbers::pi_v<float>;
constexpr float GoldenAngle = 2.39996323F;
} // namespace

std::vector<SurfacePoint> spherePoints(const glm::vec3 &Center, float Radius,
                                       int Count) {
  std::vector<SurfacePoint> Points;
  const float Spacing = Radius * std::sqrt(4 * Pi / static_cast<float>(Count));
  for (int I = 0; I < Count; ++I) {
    const float Y =
        1 - (2 * static_cast<float>(I) + 1) / static_cast<float>(Count);
    const float R = std::sqrt(1 - Y * Y);
    const float Angle = GoldenAngle * static_cast<float>(I);
    const glm::vec3 N(R * std::cos(Angle), Y, R * std::sin(Angle));
    Points.push_back({Center + Radius * N, N, Spacing});
  }
  return Points;
}

std::vector<SurfacePoint> tubePoints(const Tube &T, int Count) {
  const std::size_t Steps = T.Axis.size();
  std::vector<float> Along{0}; // length up to each axis point
  for (std::size_t I = 0; I < Steps; ++I)
    Along.push_back(Along.back() +
                    glm::distance(T.Axis[I], T.Axis[(I + 1) % Steps]));
  const float Length = Along.back();
  const float Girth = 2 * Pi * T.Radius;
  const float Spacing = std::sqrt(Length * Girth / static_cast<float>(Count));
  const int Around =
      std::max(3, static_cast<int>(std::lround(Girth / Spacing)));
  const int Rings =
      std::max(3, static_cast<int>(std::lround(Length / Spacing)));

  std::vector<SurfacePoint> Points;
  std::size_t Step = 0;
  for (int Ring = 0; Ring < Rings; ++Ring) {
    const float Place =
        Length * static_cast<float>(Ring) / static_cast<float>(Rings);
    while (Along[Step + 1] <= Place)
      ++Step;
    const glm::vec3 A = T.Axis[Step], B = T.Axis[(Step + 1) % Steps];
    const glm::vec3 Center =
        A + (B - A) * ((Place - Along[Step]) / (Along[Step + 1] - Along[Step]));
    const glm::vec3 Tangent = glm::normalize(B - A);
    const glm::vec3 Helper =
        std::abs(Tangent.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 U = glm::normalize(glm::cross(Helper, Tangent));
    const glm::vec3 V = glm::cross(Tangent, U);
    for (int K = 0; K < Around; ++K) {
      // Every other ring is turned by half a step, as bricks are laid.
      const float Angle =
          2 * Pi * (static_cast<float>(K) + (Ring % 2 != 0 ? 0.5F : 0.0F)) /
          static_cast<float>(Around);
      const glm::vec3 N = std::cos(Angle) * U + std::sin(Angle) * V;
      Points.push_back({Center + T.Radius * N, N, Spacing});
    }
  }
  return Points;
}

std::vector<SurfacePoint> floorPoints(float Radius, int Count) {
  // A sunflower whose radius grows with a power above its even 1/2.
  constexpr float Power = 0.8F;
  std::vector<SurfacePoint> Points;
  for (int I = 0; I < Count; ++I) {
    const float Share =
        (static_cast<float>(I) + 0.5F) / static_cast<float>(Count);
    const float R = Radius * std::pow(Share, Power);
    const float Angle = GoldenAngle * static_cast<float>(I);
    // Points a unit of area at this radius: Count dShare / (2 pi R dR).
    const float Density =
        static_cast<float>(Count) * Share / (Power * 2 * Pi * R * R);
    Points.push_back({{R * std::cos(Angle), 0, R * std::sin(Angle)},
                      {0, 1, 0},
                      1 / std::sqrt(Density)});
  }
  return Points;
}

} // namespace vorion::splat::demo
