#include "Loss.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vorion::reference {
namespace {

/// The window's weights, rows first; they add up to 1.
std::vector<double> windowOf(const LossRule &Rule) {
  std::vector<double> Weights;
  double Sum = 0;
  for (int Y = -Rule.Reach; Y <= Rule.Reach; ++Y)
    for (int X = -Rule.Reach; X <= Rule.Reach; ++X)
      Sum += Weights.emplace_back(
          std::exp(-(X * X + Y * Y) / (2 * Rule.Sigma * Rule.Sigma)));
  for (double &W : Weights)
    W /= Sum;
  return Weights;
}

/// Calls \p Visit(pixel, weight) for what a window at (\p X, \p Y) covers.
template <typename Function>
void forWindow(int X, int Y, int Width, int Height, const LossRule &Rule,
               const std::vector<double> &Weights, Function Visit) {
  const int R = Rule.Reach;
  const std::size_t Side = 2 * static_cast<std::size_t>(R) + 1;
  for (int V = std::max(0, Y - R); V <= std::min(Height - 1, Y + R); ++V)
    for (int U = std::max(0, X - R); U <= std::min(Width - 1, X + R); ++U)
      Visit(static_cast<std::size_t>(V) * static_cast<std::size_t>(Width) +
                static_cast<std::size_t>(U),
            Weights[static_cast<std::size_t>(V - Y + R) * Side +
                    static_cast<std::size_t>(U - X + R)]);
}

} // namespace

Loss lossOf(const std::vector<glm::dvec3> &X, const std::vector<glm::dvec3> &Y,
            int Width, int Height, const LossRule &Rule) {
  const std::vector<double> Weights = windowOf(Rule);
  const double Samples = 3.0 * static_cast<double>(X.size());
  Loss L;
  L.Gradient.assign(X.size(), glm::dvec3(0));
  for (int Row = 0; Row < Height; ++Row)
    for (int Column = 0; Column < Width; ++Column) {
      const std::size_t I =
          static_cast<std::size_t>(Row) * static_cast<std::size_t>(Width) +
          static_cast<std::size_t>(Column);
      for (int C = 0; C < 3; ++C) {
        const double D = X[I][C] - Y[I][C];
        L.Absolute += std::abs(D) / Samples;
        L.Gradient[I][C] += (1 - Rule.DSsim) / Samples * ((D > 0) - (D < 0));

        double Mx = 0, My = 0, Xx = 0, Yy = 0, Xy = 0;
        forWindow(Column, Row, Width, Height, Rule, Weights,
                  [&](std::size_t P, double W) {
                    Mx += W * X[P][C];
                    My += W * Y[P][C];
                    Xx += W * X[P][C] * X[P][C];
                    Yy += W * Y[P][C] * Y[P][C];
                    Xy += W * X[P][C] * Y[P][C];
                  });
        const double A = 2 * Mx * My + Rule.C1;
        const double B = 2 * (Xy - Mx * My) + Rule.C2;
        const double P = Mx * Mx + My * My + Rule.C1;
        const double Q = (Xx - Mx * Mx) + (Yy - My * My) + Rule.C2;
        const double Ssim = A * B / (P * Q);
        L.Ssim += Ssim / Samples;
        // SSIM by Mx, Xx and Xy as three independent sums.
        const double ByA = B / (P * Q), ByB = A / (P * Q);
        const double ByP = -Ssim / P, ByQ = -Ssim / Q;
        const double ByMx =
            ByA * 2 * My - ByB * 2 * My + ByP * 2 * Mx - ByQ * 2 * Mx;
        forWindow(Column, Row, Width, Height, Rule, Weights,
                  [&](std::size_t N, double W) {
                    L.Gradient[N][C] -=
                        Rule.DSsim / Samples * W *
                        (ByMx + ByQ * 2 * X[N][C] + ByB * 2 * Y[N][C]);
                  });
      }
    }
  L.Value = (1 - Rule.DSsim) * L.Absolute + Rule.DSsim * (1 - L.Ssim);
  return L;
}

} // namespace vorion::reference
