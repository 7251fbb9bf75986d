#include "demo/DemoScene.h"

#include "demo/ShFit.h"
#include "demo/Surfaces.h"
#include "demo/World.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

namespace vorion::splat::demo {

namespace {

using glm::vec3;
constexpr float Pi = std::numbers::pi_v<float>;

/// Radius of the floor; it fades into the backdrop before its end.
constexpr float FloorRadius = 6.5F;
constexpr float BackdropRadius = 11;

/// One object of the still life and its share of the Gaussians.
struct Object {
  std::function<std::vector<SurfacePoint>(int)> Points;
  Material Surface;
  float Share;
};

/// A trefoil knot on a torus, leaning back.
Tube knot() {
  Tube T{{}, 0.135F};
  constexpr int Steps = 600;
  const float Lean = 1.12F;
  for (int I = 0; I < Steps; ++I) {
    const float A = 2 * Pi * static_cast<float>(I) / Steps;
    const float R = 0.60F + 0.25F * std::cos(3 * A);
    const vec3 Flat(R * std::cos(2 * A), 0.25F * std::sin(3 * A),
                    R * std::sin(2 * A));
    T.Axis.push_back(vec3(Flat.x,
                          Flat.y * std::cos(Lean) + Flat.z * std::sin(Lean),
                          -Flat.y * std::sin(Lean) + Flat.z * std::cos(Lean)) +
                     vec3(-0.05F, 1.0F, -0.25F));
  }
  // It stands on the floor.
  float Lowest = T.Axis.front().y;
  for (const vec3 &P : T.Axis)
    Lowest = std::min(Lowest, P.y);
  for (vec3 &P : T.Axis)
    P.y += T.Radius - Lowest;
  return T;
}

/// A ring that lies on the floor.
Tube ring() {
  Tube T{{}, 0.075F};
  constexpr int Steps = 200;
  for (int I = 0; I < Steps; ++I) {
    const float A = 2 * Pi * static_cast<float>(I) / Steps;
    T.Axis.push_back(vec3(0.98F, T.Radius, 1.02F) +
                     0.3F * vec3(std::cos(A), 0, std::sin(A)));
  }
  return T;
}

struct StillLife {
  std::vector<Object> Objects;
  std::vector<Ball> Occluders;

  void addBall(const vec3 &Where, float Radius, const Material &M,
               float Share) {
    const vec3 Center(Where.x, Where.y + Radius, Where.z);
    Objects.push_back(
        {[=](int Count) { return spherePoints(Center, Radius, Count); }, M,
         Share});
    Occluders.push_back({Center, Radius, M.Albedo});
  }

  void addTube(const Tube &T, const Material &M, float Share) {
    Objects.push_back(
        {[=](int Count) { return tubePoints(T, Count); }, M, Share});
    // Balls close enough together to leave no gap in a shadow.
    constexpr std::size_t Every = 4;
    for (std::size_t I = 0; I < T.Axis.size(); I += Every)
      Occluders.push_back({T.Axis[I], T.Radius, M.Albedo});
  }
};

StillLife stillLife() {
  StillLife L;
  L.addTube(knot(), {{0.03F, 0.26F, 0.30F}, 0.16F, false}, 0.30F);
  L.addTube(ring(), {{0.80F, 0.56F, 0.25F}, 0.5F, true}, 0.05F);
  L.addBall({-1.12F, 0, 0.42F}, 0.36F, {{0.55F, 0.06F, 0.05F}, 0.14F, false},
            0.075F);
  L.addBall({1.36F, 0, -0.02F}, 0.40F, {{0.86F, 0.84F, 0.82F}, 0.6F, true},
            0.085F);
  L.addBall({-0.48F, 0, 1.16F}, 0.21F, {{0.75F, 0.40F, 0.03F}, 0.12F, false},
            0.035F);
  L.addBall({0.36F, 0, 1.30F}, 0.13F, {{0.16F, 0.10F, 0.42F}, 0.14F, false},
            0.018F);
  L.addBall({0.98F, 0, 1.02F}, 0.15F, {{0.75F, 0.72F, 0.66F}, 0.06F, false},
            0.018F);
  return L;
}

/// Appends Gaussians to a scene.
class Builder {
public:
  Builder() { Built.ShDegree = 3; }

  /// A disk of standard deviation \p Sigma across \p P's normal.
  void add(const SurfacePoint &P, float Sigma, float Opacity,
           const ShColor &Color) {
    const vec3 Helper =
        std::abs(P.Normal.y) < 0.9F ? vec3(0, 1, 0) : vec3(1, 0, 0);
    const vec3 T = glm::normalize(glm::cross(Helper, P.Normal));
    const glm::quat Q =
        glm::quat_cast(glm::mat3(T, glm::cross(P.Normal, T), P.Normal));
    const float Thin = 0.12F * Sigma;
    Built.Means.insert(Built.Means.end(),
                       {P.Position.x, P.Position.y, P.Position.z});
    Built.LogScales.insert(Built.LogScales.end(),
                           {std::log(Sigma), std::log(Sigma), std::log(Thin)});
    Built.Quats.insert(Built.Quats.end(), {Q.w, Q.x, Q.y, Q.z});
    Built.OpacityLogits.push_back(std::log(Opacity / (1 - Opacity)));
    for (const vec3 &C : Color)
      Built.Sh.insert(Built.Sh.end(), {C.x, C.y, C.z});
  }

  Scene take() { return std::move(Built); }

private:
  Scene Built;
};

float smoothStep(float Low, float High, float V) {
  const float T = std::clamp((V - Low) / (High - Low), 0.0F, 1.0F);
  return T * T * (3 - 2 * T);
}

void addFloor(Builder &B, const World &W, int Count) {
  for (const SurfacePoint &P : floorPoints(FloorRadius, Count)) {
    const float Away = std::hypot(P.Position.x, P.Position.z);
    const Material M{World::floorAlbedo(P.Position.x, P.Position.z), 0.05F,
                     false};
    const World::Shading S = W.prepare(P.Position, P.Normal, M);
    // Far away it takes the backdrop's colour, so that no edge shows.
    const float Haze = smoothStep(2.0F, 5.2F, Away);
    const float Opacity = 0.97F * (1 - smoothStep(4.8F, FloorRadius, Away));
    if (Opacity < 0.01F)
      continue;
    B.add(P, 0.57F * P.Spacing, Opacity,
          fitColor(P.Normal, [&](const vec3 &View) {
            return glm::mix(W.shade(S, View), World::backdrop(vec3(1, 0, 0)),
                            Haze);
          }));
  }
}

void addBackdrop(Builder &B, int Count) {
  for (SurfacePoint P : spherePoints(vec3(0), BackdropRadius, Count)) {
    const vec3 Outward = P.Normal;
    P.Normal = -P.Normal;
    B.add(P, 0.75F * P.Spacing, 0.98F, constantColor(World::backdrop(Outward)));
  }
}

/// Camera at \p Eye looking at \p Target, up towards +y.
Camera lookAt(int Id, const std::string &Name, const glm::dvec3 &Eye,
              const glm::dvec3 &Target) {
  constexpr int Width = 960, Height = 544;
  // 60 degrees across.
  Camera C = Camera::ahead(Width, Height,
                           0.5 * Width / std::tan(std::numbers::pi / 6));
  C.Id = Id;
  C.Name = Name;
  const glm::dvec3 Forward = glm::normalize(Target - Eye);
  const glm::dvec3 Right =
      glm::normalize(glm::cross(Forward, glm::dvec3(0, 1, 0)));
  const glm::dvec3 Down = glm::cross(Forward, Right);
  for (int I = 0; I < 3; ++I) {
    const auto Row = static_cast<std::size_t>(I);
    C.Position[Row] = Eye[I];
    C.Rotation[Row] = {Right[I], Down[I], Forward[I]};
  }
  return C;
}

} // namespace

Scene makeScene(int Gaussians) {
  const StillLife Life = stillLife();
  const World W(Life.Occluders);
  const auto CountOf = [&](float Share) {
    return std::max(8, static_cast<int>(Share * static_cast<float>(Gaussians)));
  };
  Builder B;
  addBackdrop(B, CountOf(0.04F));
  addFloor(B, W, CountOf(0.4F));
  for (const Object &T : Life.Objects)
    for (const SurfacePoint &P : T.Points(CountOf(T.Share))) {
      const World::Shading S = W.prepare(P.Position, P.Normal, T.Surface);
      B.add(P, 0.58F * P.Spacing, 0.97F,
            fitColor(P.Normal,
                     [&](const vec3 &View) { return W.shade(S, View); }));
    }
  return B.take();
}

std::vector<Camera> makeCameras() {
  return {lookAt(0, "front", {0.75, 1.55, 3.75}, {0.05, 0.62, 0.1}),
          lookAt(1, "close", {-1.5, 0.95, 2.3}, {-0.1, 0.62, 0.0}),
          lookAt(2, "above", {2.2, 3.6, 2.6}, {0, 0.4, 0.1})};
}

} // namespace vorion::splat::demo
