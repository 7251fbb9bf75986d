/// Evenly spread points on the surfaces of the still life.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace vorion::splat::demo {

/// A point of a surface and how far its neighbours are.
struct SurfacePoint {
  glm::vec3 Position, Normal;
  float Spacing;
};

/// \p Count points on a sphere.
std::vector<SurfacePoint> spherePoints(const glm::vec3 &Center, float Radius,
                                       int Count);

/// A closed tube around a curve given by points (the last joins the first).
struct Tube {
  std::vector<glm::vec3> Axis;
  float Radius;
};
std::vector<SurfacePoint> tubePoints(const Tube &T, int Count);

/// About \p Count points of the floor up to \p Radius around the origin, denser
/// in the middle.
std::vector<SurfacePoint> floorPoints(float Radius, int Count);

} // namespace vorion::splat::demo
