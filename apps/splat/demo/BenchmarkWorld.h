/// The places of the benchmark set: a flat, a garden and a figure, made of
/// simple parts. Units are metres, the floor is y = 0, up is +y.
#pragma once

#include "io/Cameras.h"

#include <array>
#include <glm/vec3.hpp>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion::splat::demo {

enum class BenchmarkKind { Indoor, Outdoor, Object };

inline constexpr std::array BenchmarkKinds = {
    BenchmarkKind::Indoor, BenchmarkKind::Outdoor, BenchmarkKind::Object};

constexpr std::string_view name(BenchmarkKind K) {
  switch (K) {
  case BenchmarkKind::Indoor:
    return "indoor";
  case BenchmarkKind::Outdoor:
    return "outdoor";
  case BenchmarkKind::Object:
    return "object";
  }
  __builtin_unreachable();
}

/// What a part is made of.
enum class Texture { Plain, Tiles, Boards, Ground, Leaves, Colors };

/// From where a part is seen.
enum class Seen {
  InViews, ///< in some view
  Behind,  ///< only through or behind others
  Nowhere  ///< as what a capture has behind its cameras
};

/// A surface, or a crown of leaves.
struct Part {
  enum class Form { Patch, Ellipsoid, Tube, Crown };
  Form Shape;
  glm::dvec3 Origin; ///< a corner, a centre, the middle of an end
  glm::dvec3 U, V;   ///< sides; of an ellipsoid and a crown U is its radii; a
                     ///< tube has the axis U and the radius V.x
  glm::dvec3 Albedo;
  Texture Surface = Texture::Plain;
  Seen From = Seen::InViews;

  /// Square metres, lengths of the sides (metres), and the point at (\p S, \p
  /// T), each 0 to 1.
  double area() const;
  std::pair<double, double> lengths() const;
  struct Point {
    glm::dvec3 Position, Normal;
  };
  Point at(double S, double T) const;
};

std::vector<Part> benchmarkParts(BenchmarkKind K);

/// What a capture's photographs look at: Gaussians get fewer from about
/// \c Radius away on.
struct Focus {
  glm::dvec3 Middle;
  double Radius;
};
Focus benchmarkFocus(BenchmarkKind K);

/// Three views, 980x545, the size of the data set Train. \p Distances: factors
/// of the cameras' distances to what they look at.
std::vector<Camera> benchmarkCameras(BenchmarkKind K,
                                     const std::array<double, 3> &Distances);

} // namespace vorion::splat::demo
