/// What the catalogue's scenes are put together from.
#pragma once

#include "HardCase.h"

#include <random>

namespace vorion::test {

/// One Gaussian as a case writes it down.
struct Blob {
  std::array<float, 3> Mean{0, 0, 2};
  std::array<double, 3> Scale{0.1, 0.1, 0.1}; ///< 0 is stored as e^-100
  std::array<float, 4> Quat{1, 0, 0, 0};
  double Opacity = 0.8; ///< 0 and 1 become logits of -30 and 30
  std::array<double, 3> Color{0.9, 0.5, 0.2};
};

/// Appends \p B, with the constant colour band alone, to a scene of degree 0.
void add(splat::Scene &S, const Blob &B);

/// A camera at the origin that looks along +z.
splat::Camera frontView(int Width, int Height, double Focal);

/// \p C turned about its own position by a fixed awkward rotation, or moved.
splat::Camera turnedView(splat::Camera C);

/// A point that camera \p C sees at (\p X, \p Y, \p Z) of its own axes.
std::array<float, 3> seenAt(const splat::Camera &C, double X, double Y,
                            double Z);

/// Numbers that are the same with every library.
class Numbers {
public:
  explicit Numbers(uint32_t Seed) : Engine(Seed) {}
  double uniform(double Low, double High) {
    return Low + (High - Low) * double(Engine()) / 0x1p32;
  }
  uint32_t below(uint32_t End) { return Engine() % End; }
  std::array<float, 4> turn();
  std::array<double, 3> color();

private:
  std::mt19937 Engine;
};

} // namespace vorion::test
