#include "demo/BenchmarkWorld.h"

#include "demo/PortableMath.h"

#include <glm/geometric.hpp>
#include <string>

namespace vorion::splat::demo {

namespace {

using glm::dvec3;
constexpr double Pi = std::numbers::pi;

/// Parts with what they have in common.
class Builder {
public:
  std::vector<Part> Parts;
  Seen From = Seen::InViews;

  void patch(const dvec3 &Corner, const dvec3 &U, const dvec3 &V,
             const dvec3 &Albedo, Texture T = Texture::Plain) {
    Parts.push_back({Part::Form::Patch, Corner, U, V, Albedo, T, From});
  }
  void ellipsoid(const dvec3 &Center, const dvec3 &Radii, const dvec3 &Albedo,
                 Texture T = Texture::Plain) {
    Parts.push_back(
        {Part::Form::Ellipsoid, Center, Radii, dvec3(0), Albedo, T, From});
  }
  void tube(const dvec3 &Base, const dvec3 &Axis, double Radius,
            const dvec3 &Albedo, Texture T = Texture::Plain) {
    Parts.push_back(
        {Part::Form::Tube, Base, Axis, dvec3(Radius), Albedo, T, From});
  }
  void crown(const dvec3 &Center, const dvec3 &Radii, const dvec3 &Albedo) {
    Parts.push_back({Part::Form::Crown, Center, Radii, dvec3(0), Albedo,
                     Texture::Leaves, From});
  }
  /// The sides and the top of a box from \p Low to \p High.
  void box(const dvec3 &Low, const dvec3 &High, const dvec3 &Albedo,
           Texture T = Texture::Plain) {
    const dvec3 D = High - Low;
    const dvec3 X(D.x, 0, 0), Y(0, D.y, 0), Z(0, 0, D.z);
    patch(Low, Y, X, Albedo, T);
    patch(Low + Z, X, Y, Albedo, T);
    patch(Low, Z, Y, Albedo, T);
    patch(Low + X, Y, Z, Albedo, T);
    patch(Low + Y, Z, X, Albedo, T);
  }
  /// Walls, floor and ceiling from \p Low to \p High, seen from inside.
  void room(const dvec3 &Low, const dvec3 &High, const dvec3 &Albedo) {
    const dvec3 D = High - Low;
    const dvec3 X(D.x, 0, 0), Y(0, D.y, 0), Z(0, 0, D.z);
    patch(Low, X, Y, Albedo);
    patch(Low + Z, Y, X, Albedo);
    patch(Low, Y, Z, Albedo);
    patch(Low + X, Z, Y, Albedo);
    patch(Low, Z, X, {0.42, 0.28, 0.17}, Texture::Boards);
    patch(Low + Y, X, Z, {0.8, 0.8, 0.78});
  }
  void table(const dvec3 &Middle, double Width, double Depth, double Height) {
    const dvec3 Wood(0.36, 0.2, 0.1);
    box(Middle + dvec3(-Width / 2, Height - 0.05, -Depth / 2),
        Middle + dvec3(Width / 2, Height, Depth / 2), Wood, Texture::Boards);
    for (const double X : {-0.45, 0.45})
      for (const double Z : {-0.4, 0.4})
        tube(Middle + dvec3(X * Width, 0, Z * Depth), {0, Height - 0.05, 0},
             0.03, Wood);
  }
  void sofa(const dvec3 &Middle, const dvec3 &Cloth) {
    box(Middle + dvec3(-1.1, 0.1, -0.4), Middle + dvec3(1.1, 0.45, 0.45),
        Cloth);
    box(Middle + dvec3(-1.1, 0.4, -0.55), Middle + dvec3(1.1, 0.95, -0.3),
        Cloth);
    for (const double X : {-1.2, 1.0})
      box(Middle + dvec3(X, 0.1, -0.5), Middle + dvec3(X + 0.2, 0.65, 0.45),
          Cloth);
    ellipsoid(Middle + dvec3(-0.6, 0.6, -0.15), {0.28, 0.22, 0.12},
              {0.6, 0.12, 0.1});
    ellipsoid(Middle + dvec3(0.55, 0.6, -0.15), {0.28, 0.22, 0.12},
              {0.1, 0.35, 0.4});
  }
  void shelf(const dvec3 &Corner, double Width) {
    box(Corner, Corner + dvec3(Width, 2, 0.3), {0.3, 0.18, 0.1},
        Texture::Boards);
    for (int Row = 0; Row < 4; ++Row)
      patch(Corner + dvec3(0.05, 0.12 + 0.48 * Row, 0.31), {Width - 0.1, 0, 0},
            {0, 0.36, 0}, {0.4, 0.35, 0.3}, Texture::Colors);
  }
  void tree(const dvec3 &Foot, double Height) {
    tube(Foot, {0, 0.6 * Height, 0}, 0.04 * Height, {0.25, 0.17, 0.1},
         Texture::Boards);
    const dvec3 Green(0.13, 0.3, 0.07);
    crown(Foot + dvec3(0, 0.7 * Height, 0), dvec3(0.32, 0.3, 0.32) * Height,
          Green);
    crown(Foot + dvec3(0.16, 0.55, 0.1) * Height,
          dvec3(0.2, 0.17, 0.2) * Height, 1.2 * Green);
    crown(Foot + dvec3(-0.17, 0.58, 0.05) * Height,
          dvec3(0.2, 0.16, 0.2) * Height, 0.85 * Green);
  }
};

std::vector<Part> flat() {
  Builder B;
  const dvec3 Paint(0.72, 0.68, 0.6);
  // The living room, with an opening at the back.
  B.patch({-4, 0, -3}, {0, 0, 6}, {8, 0, 0}, {0.42, 0.28, 0.17},
          Texture::Boards);
  B.patch({-4, 2.8, -3}, {8, 0, 0}, {0, 0, 6}, {0.8, 0.8, 0.78});
  B.patch({-4, 0, -3}, {0, 2.8, 0}, {0, 0, 6}, Paint);
  B.patch({-4, 0, -3}, {4.2, 0, 0}, {0, 2.8, 0}, Paint);
  B.patch({1.6, 0, -3}, {2.4, 0, 0}, {0, 2.8, 0}, Paint);
  B.patch({0.2, 2.2, -3}, {1.4, 0, 0}, {0, 0.6, 0}, Paint);
  B.patch({4, 0, -3}, {0, 0, 6}, {0, 2.8, 0}, Paint);
  B.sofa({-1.6, 0, -1.9}, {0.66, 0.62, 0.56});
  B.table({-1.5, 0, -0.5}, 1.2, 0.7, 0.45);
  B.ellipsoid({-1.4, 0.55, -0.5}, {0.12, 0.1, 0.12}, {0.2, 0.4, 0.6});
  B.patch({-3, 0.01, -1.4}, {0, 0, 1.9}, {3, 0, 0}, {0.5, 0.2, 0.16},
          Texture::Tiles);
  B.shelf({2, 0, -2.95}, 1.6);
  for (const double X : {-3.2, -2.0, -0.8})
    B.patch({X, 1.3, -2.97}, {0.8, 0, 0}, {0, 0.9, 0}, {0.45, 0.4, 0.35},
            Texture::Colors);
  B.patch({-3.97, 1.2, -1.6}, {0, 1.1, 0}, {0, 0, 1.5}, {0.5, 0.4, 0.3},
          Texture::Colors);
  B.tube({-3.5, 0, -2.4}, {0, 1.5, 0}, 0.025, {0.15, 0.15, 0.15});
  B.ellipsoid({-3.5, 1.65, -2.4}, {0.25, 0.2, 0.25}, {0.95, 0.85, 0.6});
  B.tube({-3.4, 0, 0.9}, {0, 0.4, 0}, 0.2, {0.55, 0.3, 0.2});
  B.crown({-3.4, 0.95, 0.9}, {0.45, 0.55, 0.45}, {0.12, 0.3, 0.08});
  // The kitchen that shows through the opening.
  B.patch({-1.5, 0, -8}, {0, 0, 5}, {5, 0, 0}, {0.7, 0.68, 0.62},
          Texture::Tiles);
  B.patch({-1.5, 2.8, -8}, {5, 0, 0}, {0, 0, 5}, {0.8, 0.8, 0.78});
  B.patch({-1.5, 0, -8}, {5, 0, 0}, {0, 2.8, 0}, {0.5, 0.58, 0.6});
  B.patch({-1.5, 0, -8}, {0, 2.8, 0}, {0, 0, 5}, Paint);
  B.patch({3.5, 0, -8}, {0, 0, 5}, {0, 2.8, 0}, Paint);
  B.box({0.2, 0, -6.5}, {1.6, 0.9, -5.5}, {0.75, 0.74, 0.7});
  B.box({-1.4, 0, -7.9}, {3.4, 0.9, -7.3}, {0.2, 0.3, 0.34});
  B.patch({-1.3, 1.4, -7.9}, {4.6, 0, 0}, {0, 0.8, 0}, {0.5, 0.45, 0.4},
          Texture::Colors);
  for (const double X : {0.5, 1.3})
    B.ellipsoid({X, 1.9, -6}, {0.16, 0.16, 0.16}, {0.9, 0.7, 0.3});
  // Rooms behind the walls, and those that no view looks at.
  B.From = Seen::Behind;
  B.room({-9, 0, -3}, {-4.2, 2.8, 3}, {0.6, 0.62, 0.66});
  B.room({-9, 0, -9}, {-1.8, 2.8, -3.3}, {0.66, 0.6, 0.55});
  B.room({-6, 0, -14}, {6, 2.8, -8.4}, {0.6, 0.66, 0.6});
  B.shelf({-6, 0, -8.9}, 2);
  B.sofa({-6, 0, 0}, {0.3, 0.33, 0.45});
  B.sofa({-5, 0, -6}, {0.4, 0.3, 0.3});
  B.table({1, 0, -11}, 2, 1, 0.75);
  B.crown({-7.5, 1, -2}, {0.5, 0.9, 0.5}, {0.12, 0.3, 0.08});
  B.From = Seen::Nowhere;
  B.room({4.3, 0, -3}, {9, 2.8, 3}, Paint);
  B.room({-4, 0, 3.3}, {4, 2.8, 8}, Paint);
  return B.Parts;
}

std::vector<Part> garden() {
  Builder B;
  const dvec3 Grass(0.22, 0.3, 0.1), Hedge(0.1, 0.25, 0.07);
  B.patch({-14, 0, -14}, {0, 0, 28}, {28, 0, 0}, Grass, Texture::Ground);
  B.patch({-1.1, 0.02, -12}, {0, 0, 22}, {2.2, 0, 0}, {0.5, 0.46, 0.4},
          Texture::Tiles);
  // A cottage.
  B.box({2.6, 0, -9}, {8, 2.7, -4.5}, {0.7, 0.62, 0.5}, Texture::Tiles);
  B.patch({2.2, 2.5, -4.1}, {6.2, 0, 0}, {0, 2.2, -2.7}, {0.45, 0.16, 0.1},
          Texture::Boards);
  B.patch({8.4, 2.5, -9.4}, {-6.2, 0, 0}, {0, 2.2, 2.7}, {0.45, 0.16, 0.1},
          Texture::Boards);
  B.patch({4, 0, -4.48}, {0.9, 0, 0}, {0, 2, 0}, {0.15, 0.25, 0.35},
          Texture::Boards);
  for (const double X : {3.0, 5.6, 6.9})
    B.patch({X, 1, -4.47}, {0.8, 0, 0}, {0, 1, 0}, {0.3, 0.4, 0.5});
  // A cart on the lawn.
  const dvec3 Blue(0.12, 0.42, 0.5);
  B.box({-3.6, 0.5, -1.8}, {-1.5, 0.62, -0.7}, {0.35, 0.24, 0.15},
        Texture::Boards);
  B.box({-3.6, 0.6, -1.8}, {-3.5, 1.2, -0.7}, Blue, Texture::Boards);
  B.box({-3.6, 0.6, -1.8}, {-1.5, 1.0, -1.7}, Blue, Texture::Boards);
  B.box({-3.6, 0.6, -0.8}, {-1.5, 1.0, -0.7}, Blue, Texture::Boards);
  for (const double X : {-3.1, -2.0})
    for (const double Z : {-1.9, -0.6})
      B.ellipsoid({X, 0.35, Z}, {0.35, 0.35, 0.06}, {0.2, 0.12, 0.08});
  // Hedges, shrubs, trees.
  for (int I = 0; I < 7; ++I)
    B.crown({-4.6 - 0.15 * (I % 2), 0.45, 2.0 - 1.7 * I}, {0.6, 0.5, 0.95},
            Hedge * (0.9 + 0.06 * I));
  for (int I = 0; I < 5; ++I)
    B.crown({1.9 + 0.2 * (I % 2), 0.4, 1.5 - 1.5 * I}, {0.55, 0.5, 0.7},
            dvec3(0.16, 0.28, 0.06) * (1.2 - 0.08 * I));
  for (int I = 0; I < 6; ++I)
    B.crown({-2.6 + 0.9 * I, 0.2, 2.8 - 0.12 * I * I}, {0.25, 0.22, 0.25},
            I % 2 ? dvec3(0.6, 0.25, 0.3) : dvec3(0.7, 0.6, 0.2));
  B.tree({-5.5, 0, -4}, 6.5);
  B.tree({-3.2, 0, -8}, 7.5);
  B.tree({0.8, 0, -11}, 7);
  B.tree({9.5, 0, -8}, 8);
  B.tree({4.4, 0, 1.2}, 4.5);
  B.tube({1.25, 0, -1}, {0, 2.6, 0}, 0.05, {0.1, 0.1, 0.1});
  B.ellipsoid({1.25, 2.75, -1}, {0.18, 0.2, 0.18}, {0.95, 0.9, 0.7});
  // A wood and houses behind.
  B.From = Seen::Behind;
  for (int I = 0; I < 9; ++I)
    B.tree({-13.0 + 3.2 * I, 0, -14.0 - 1.5 * (I % 3)}, 7.5 + I % 4);
  for (int I = 0; I < 5; ++I)
    B.tree({-9.0 - 1.1 * (I % 2), 0, -10.0 + 3.2 * I}, 6.5 + I % 3);
  B.box({-16, 0, -24}, {-6, 9, -19}, {0.6, 0.55, 0.5}, Texture::Tiles);
  B.box({2, 0, -26}, {14, 11, -20}, {0.5, 0.52, 0.58}, Texture::Tiles);
  B.From = Seen::Nowhere;
  for (int I = 0; I < 6; ++I)
    B.tree({-12.0 + 5 * I, 0, 13.0 + 1.5 * (I % 2)}, 6);
  B.box({-6, 0, 14}, {8, 5, 19}, {0.6, 0.55, 0.5}, Texture::Tiles);
  return B.Parts;
}

std::vector<Part> figure() {
  Builder B;
  const dvec3 White(0.8, 0.8, 0.78), Orange(0.8, 0.35, 0.05),
      Dark(0.07, 0.08, 0.1), Metal(0.4, 0.42, 0.45);
  B.patch({-1, 0, -0.8}, {0, 0, 1.6}, {2, 0, 0}, {0.3, 0.27, 0.18},
          Texture::Ground);
  B.ellipsoid({0, 0.62, 0}, {0.26, 0.34, 0.2}, Orange);
  B.ellipsoid({0, 0.7, 0.05}, {0.2, 0.22, 0.19}, White);
  B.ellipsoid({0, 1.2, 0}, {0.34, 0.28, 0.28}, White);
  B.ellipsoid({0, 1.19, 0.08}, {0.28, 0.21, 0.23}, Dark);
  for (const double X : {-1.0, 1.0}) {
    B.ellipsoid({0.11 * X, 1.22, 0.29}, {0.05, 0.06, 0.03}, {0.1, 0.75, 0.85});
    B.ellipsoid({0.35 * X, 1.2, 0}, {0.06, 0.1, 0.1}, Orange);
    B.tube({0.24 * X, 0.82, 0}, {0.22 * X, -0.06, 0.06}, 0.05, Metal);
    B.tube({0.46 * X, 0.76, 0.06}, {0.1 * X, 0.2, 0.1}, 0.045, White);
    B.ellipsoid({0.58 * X, 1.0, 0.18}, {0.09, 0.1, 0.07}, Dark);
    for (int Finger = -1; Finger < 2; ++Finger)
      B.tube({0.58 * X + 0.05 * Finger, 1.07, 0.19},
             {0.015 * Finger, 0.09, 0.03}, 0.018, White);
    B.tube({0.13 * X, 0.06, 0.02}, {0, 0.3, 0}, 0.07, White);
    B.ellipsoid({0.13 * X, 0.05, 0.07}, {0.1, 0.06, 0.17}, Dark);
  }
  B.tube({0, 1.46, 0}, {0.02, 0.16, 0}, 0.012, Metal);
  B.ellipsoid({0.02, 1.64, 0}, {0.035, 0.035, 0.035}, Orange);
  for (int I = 0; I < 5; ++I)
    B.crown({-0.8 + 0.38 * I, 0.06, I % 2 ? -0.5 : 0.5}, {0.12, 0.09, 0.12},
            {0.15, 0.32, 0.1});
  // What a training leaves inside.
  B.From = Seen::Behind;
  B.crown({0, 0.64, 0}, {0.2, 0.27, 0.15}, Orange);
  B.crown({0, 1.2, 0}, {0.26, 0.2, 0.2}, White);
  return B.Parts;
}

/// Camera at \p Target + \p Away, looking at \p Target, up towards +y.
Camera lookAt(int Id, const char *Name, const dvec3 &Target,
              const dvec3 &Away) {
  constexpr int Width = 980, Height = 545;
  // 60 degrees across.
  Camera C = Camera::ahead(Width, Height, 0.5 * Width * std::numbers::sqrt3);
  C.Id = Id;
  C.Name = Name;
  const dvec3 Eye = Target + Away, Forward = glm::normalize(-Away),
              Right = glm::normalize(glm::cross(Forward, dvec3(0, 1, 0))),
              Down = glm::cross(Forward, Right);
  for (int I = 0; I < 3; ++I) {
    const auto Row = static_cast<std::size_t>(I);
    C.Position[Row] = Eye[I];
    C.Rotation[Row] = {Right[I], Down[I], Forward[I]};
  }
  return C;
}

dvec3 onSphere(double S, double T) {
  const double Y = 1 - 2 * T, R = std::sqrt(std::max(0.0, 1 - Y * Y));
  const auto [C, Si] = portableCosSin(S);
  return {R * C, Y, R * Si};
}

} // namespace

double Part::area() const {
  switch (Shape) {
  case Form::Patch:
    return glm::length(glm::cross(U, V));
  case Form::Ellipsoid:
  case Form::Crown:
    return 4 * Pi / 3 * (U.x * U.y + U.y * U.z + U.z * U.x);
  case Form::Tube:
    return 2 * Pi * V.x * glm::length(U);
  }
  __builtin_unreachable();
}

std::pair<double, double> Part::lengths() const {
  switch (Shape) {
  case Form::Patch:
    return {glm::length(U), glm::length(V)};
  case Form::Ellipsoid:
  case Form::Crown:
    return {Pi * (U.x + U.z), Pi * U.y};
  case Form::Tube:
    return {2 * Pi * V.x, glm::length(U)};
  }
  __builtin_unreachable();
}

Part::Point Part::at(double S, double T) const {
  switch (Shape) {
  case Form::Patch:
    return {Origin + S * U + T * V, glm::normalize(glm::cross(U, V))};
  case Form::Ellipsoid:
  case Form::Crown: {
    const dvec3 D = onSphere(S, T);
    return {Origin + U * D, glm::normalize(D / U)};
  }
  case Form::Tube: {
    const dvec3 Axis = glm::normalize(U);
    const dvec3 Helper =
        std::abs(Axis.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
    const dvec3 A = glm::normalize(glm::cross(Helper, Axis));
    const auto [C, Si] = portableCosSin(S);
    const dvec3 N = C * A + Si * glm::cross(Axis, A);
    return {Origin + T * U + V.x * N, N};
  }
  }
  __builtin_unreachable();
}

std::vector<Part> benchmarkParts(BenchmarkKind K) {
  switch (K) {
  case BenchmarkKind::Indoor:
    return flat();
  case BenchmarkKind::Outdoor:
    return garden();
  case BenchmarkKind::Object:
    return figure();
  }
  __builtin_unreachable();
}

Focus benchmarkFocus(BenchmarkKind K) {
  switch (K) {
  case BenchmarkKind::Indoor:
    return {{0, 0, 0}, 3};
  case BenchmarkKind::Outdoor:
    return {{-2.5, 0.6, -1.2}, 2};
  case BenchmarkKind::Object:
    return {{0, 0, 0}, 1.2};
  }
  __builtin_unreachable();
}

std::vector<Camera> benchmarkCameras(BenchmarkKind K,
                                     const std::array<double, 3> &Distances) {
  const auto At = [&](int Id, const char *Name, const dvec3 &Target,
                      const dvec3 &Away) {
    return lookAt(Id, Name, Target,
                  Distances[static_cast<std::size_t>(Id)] * Away);
  };
  switch (K) {
  case BenchmarkKind::Indoor:
    return {At(0, "room", {-1.6, 1.1, -1.8}, {4.6, 0.5, 4.1}),
            At(1, "wall", {-3.6, 1.4, -1.2}, {2.1, 0.1, 1.2}),
            At(2, "through", {0.9, 1.3, -3}, {-0.4, 0.2, 3.4})};
  case BenchmarkKind::Outdoor:
    return {At(0, "overview", {-1.2, 0.7, -2}, {2, 2.2, 6}),
            At(1, "path", {-1.2, 1, -2}, {1.6, 0.4, 4.6}),
            At(2, "close", {-2.5, 0.7, -1.2}, {1.4, 0.6, 2.1})};
  case BenchmarkKind::Object:
    return {At(0, "front", {0, 0.72, 0}, {0.5, 0.8, 2.3}),
            At(1, "close", {0, 0.95, 0}, {0.2, 0.15, 1.05}),
            At(2, "far", {0, 0.72, 0}, {2, 3, 8})};
  }
  __builtin_unreachable();
}

} // namespace vorion::splat::demo
