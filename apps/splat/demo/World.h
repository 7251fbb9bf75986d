/// The still life as a ray sees it: balls over a floor, lit by a lamp and a
/// sky. Units: the floor is y = 0, up is +y, objects are about 1 high.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace vorion::splat::demo {

/// How a surface answers light.
struct Material {
  glm::vec3 Albedo{0.5F}; ///< linear
  float Mirror = 0.04F;   ///< reflectance at normal incidence
  bool Metal = false;     ///< reflections take the albedo's hue
};

/// Everything that casts shadows and shows in reflections. Tubes are strings
/// of balls.
struct Ball {
  glm::vec3 Center;
  float Radius;
  glm::vec3 Albedo;
};

class World {
public:
  explicit World(std::vector<Ball> Occluders);

  /// Light that leaves \p Point of a surface towards a camera that looks along
  /// \p View; display values (what a PNG shows), 0 to 1. Only the part that
  /// \c prepare cannot know is computed here.
  struct Shading {
    glm::vec3 Diffuse; ///< linear, towards everywhere
    glm::vec3 Point, Normal;
    Material Surface;
    float Occlusion; ///< 0 dark to 1 open
  };
  Shading prepare(const glm::vec3 &Point, const glm::vec3 &Normal,
                  const Material &Surface) const;
  glm::vec3 shade(const Shading &S, const glm::vec3 &View) const;

  /// The sky's display colour along \p Direction, for the backdrop.
  static glm::vec3 backdrop(const glm::vec3 &Direction);
  /// The floor's linear albedo.
  static glm::vec3 floorAlbedo(float X, float Z);

private:
  bool blocked(const glm::vec3 &From, const glm::vec3 &Direction,
               float Reach) const;
  /// Linear light that arrives at \p From along -Direction.
  glm::vec3 incoming(const glm::vec3 &From, const glm::vec3 &Direction) const;

  std::vector<Ball> Balls;
};

/// Linear light to display value: a soft shoulder, then gamma 2.2.
glm::vec3 toDisplay(const glm::vec3 &Linear);

} // namespace vorion::splat::demo
