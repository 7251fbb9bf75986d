#include "demo/World.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

namespace vorion::splat::demo {

namespace {

using glm::vec3;

const vec3 LampDirection = glm::normalize(vec3(-0.55F, 0.85F, 0.45F));
const vec3 LampColor{2.6F, 2.25F, 1.8F};
const vec3 ZenithColor{0.30F, 0.42F, 0.62F};
const vec3 HorizonColor{0.80F, 0.62F, 0.52F};
/// Beside the lamp, a window that shows in glossy things.
const vec3 WindowDirection = glm::normalize(vec3(0.8F, 0.45F, 0.35F));
const vec3 WindowColor{0.9F, 1.15F, 1.5F};
/// Rays start this far off their surface.
constexpr float Offset = 2e-3F;

/// Linear light of the sky, with lamp and window as soft spots: spherical
/// harmonics of degree 3 can show no sharper ones.
vec3 skyLight(const vec3 &D) {
  const float Height = std::clamp(D.y, 0.0F, 1.0F);
  vec3 Sky = glm::mix(HorizonColor, ZenithColor, std::pow(Height, 0.6F));
  Sky +=
      LampColor * 7.0F * std::exp(20.0F * (glm::dot(D, LampDirection) - 1.0F));
  Sky += WindowColor * 3.0F *
         std::exp(22.0F * (glm::dot(D, WindowDirection) - 1.0F));
  return Sky;
}

/// An orthonormal pair across \p N.
std::pair<vec3, vec3> tangents(const vec3 &N) {
  const vec3 Helper = std::abs(N.y) < 0.9F ? vec3(0, 1, 0) : vec3(1, 0, 0);
  const vec3 T = glm::normalize(glm::cross(Helper, N));
  return {T, glm::cross(N, T)};
}

/// Point \p I of \p Count of a sunflower on the unit disk.
std::pair<float, float> diskPoint(int I, int Count) {
  const float R =
      std::sqrt((static_cast<float>(I) + 0.5F) / static_cast<float>(Count));
  const float Angle = static_cast<float>(I) * 2.39996323F;
  return {R * std::cos(Angle), R * std::sin(Angle)};
}

float smoothStep(float Low, float High, float V) {
  const float T = std::clamp((V - Low) / (High - Low), 0.0F, 1.0F);
  return T * T * (3 - 2 * T);
}

} // namespace

World::World(std::vector<Ball> Occluders) : Balls(std::move(Occluders)) {}

bool World::blocked(const vec3 &From, const vec3 &Direction,
                    float Reach) const {
  return std::ranges::any_of(Balls, [&](const Ball &B) {
    const vec3 ToCenter = B.Center - From;
    const float Along = glm::dot(ToCenter, Direction);
    if (Along < 0 || Along > Reach)
      return false;
    return glm::dot(ToCenter, ToCenter) - Along * Along < B.Radius * B.Radius;
  });
}

vec3 World::incoming(const vec3 &From, const vec3 &Direction) const {
  float Nearest = std::numeric_limits<float>::max();
  vec3 Light = skyLight(Direction);
  for (const Ball &B : Balls) {
    const vec3 ToCenter = B.Center - From;
    const float Along = glm::dot(ToCenter, Direction);
    const float Squared =
        B.Radius * B.Radius - (glm::dot(ToCenter, ToCenter) - Along * Along);
    if (Squared < 0)
      continue;
    const float Distance = Along - std::sqrt(Squared);
    if (Distance < Offset || Distance > Nearest)
      continue;
    Nearest = Distance;
    const vec3 N = glm::normalize(From + Direction * Distance - B.Center);
    const float Lit = std::max(0.0F, glm::dot(N, LampDirection));
    Light =
        B.Albedo * (LampColor * 0.7F * Lit + ZenithColor * (0.6F + 0.4F * N.y));
  }
  if (Direction.y < 0) {
    const float Distance = -From.y / Direction.y;
    if (Distance < Nearest) {
      const vec3 Hit = From + Direction * Distance;
      const float Away = std::hypot(Hit.x, Hit.z);
      Light = glm::mix(floorAlbedo(Hit.x, Hit.z) *
                           (LampColor * 0.65F * LampDirection.y + ZenithColor),
                       HorizonColor, smoothStep(2.0F, 4.5F, Away));
    }
  }
  return Light;
}

World::Shading World::prepare(const vec3 &Point, const vec3 &Normal,
                              const Material &Surface) const {
  const vec3 From = Point + Normal * Offset;
  // The lamp is a disk: its visible share makes the soft edge of shadows.
  constexpr int LampRays = 32;
  constexpr float LampRadius = 0.11F;
  const auto [T, S] = tangents(LampDirection);
  int Seen = 0;
  for (int I = 0; I < LampRays; ++I) {
    const auto [U, V] = diskPoint(I, LampRays);
    const vec3 D = glm::normalize(LampDirection + LampRadius * (U * T + V * S));
    Seen += blocked(From, D, 20.0F) ? 0 : 1;
  }
  const float Lit = std::max(0.0F, glm::dot(Normal, LampDirection)) *
                    static_cast<float>(Seen) / LampRays;

  // The sky over the hemisphere, cosine weighted.
  constexpr int SkyRays = 48;
  const auto [A, B] = tangents(Normal);
  vec3 Sky(0);
  int Open = 0;
  for (int I = 0; I < SkyRays; ++I) {
    const auto [U, V] = diskPoint(I, SkyRays);
    const vec3 D =
        U * A + V * B + Normal * std::sqrt(std::max(0.0F, 1 - U * U - V * V));
    if (blocked(From, D, 1.6F))
      continue;
    ++Open;
    const float Up = std::clamp(0.5F + 0.5F * D.y, 0.0F, 1.0F);
    Sky += glm::mix(vec3(0.34F, 0.27F, 0.22F), ZenithColor * 1.35F, Up);
  }
  Sky /= static_cast<float>(SkyRays);

  const vec3 Diffuse = Surface.Albedo * (LampColor * Lit + Sky);
  return {Surface.Metal ? Diffuse * 0.25F : Diffuse, Point, Normal, Surface,
          static_cast<float>(Open) / SkyRays};
}

vec3 World::shade(const Shading &S, const vec3 &View) const {
  const float Facing = std::max(0.02F, -glm::dot(View, S.Normal));
  const vec3 Mirrored =
      glm::normalize(View - 2 * glm::dot(View, S.Normal) * S.Normal +
                     // Grazing rays below the surface are turned up again.
                     S.Normal * 0.02F);
  const vec3 F0 = S.Surface.Metal ? S.Surface.Albedo : vec3(S.Surface.Mirror);
  // Schlick's approximation of Fresnel reflectance.
  const vec3 Fresnel = F0 + (vec3(1) - F0) * std::pow(1 - Facing, 5.0F) * 0.7F;
  const vec3 Reflected = incoming(S.Point + S.Normal * Offset, Mirrored) *
                         (0.25F + 0.75F * S.Occlusion);
  return toDisplay(S.Diffuse * (vec3(1) - Fresnel) + Fresnel * Reflected);
}

vec3 World::backdrop(const vec3 &Direction) {
  const float Height = std::clamp(Direction.y, 0.0F, 1.0F);
  const vec3 Linear =
      glm::mix(vec3(0.52F, 0.36F, 0.29F), vec3(0.09F, 0.13F, 0.24F),
               smoothStep(0.0F, 0.55F, Height));
  return toDisplay(Linear);
}

vec3 World::floorAlbedo(float X, float Z) {
  // Tiles at 45 degrees in two soft colours, each with a tone of its own.
  constexpr float Side = 0.52F;
  const float U = (X + Z) * std::numbers::sqrt2_v<float> / (2 * Side);
  const float V = (X - Z) * std::numbers::sqrt2_v<float> / (2 * Side);
  const auto Cell = static_cast<int64_t>(std::floor(U) + std::floor(V)) & 1;
  const vec3 Albedo =
      Cell != 0 ? vec3(0.60F, 0.51F, 0.40F) : vec3(0.10F, 0.19F, 0.22F);
  return Albedo *
         (0.88F + 0.24F * (0.5F + 0.5F * std::sin(7.3F * std::floor(U) +
                                                  4.1F * std::floor(V))));
}

vec3 toDisplay(const vec3 &Linear) {
  const vec3 Positive = glm::max(Linear, vec3(0));
  return glm::pow(vec3(1) - glm::exp(-1.15F * Positive), vec3(1 / 2.2F));
}

} // namespace vorion::splat::demo
