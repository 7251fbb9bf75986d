// Needles, pancakes, quaternions of any length, scales beyond fp32.
#include "Build.h"

#include <cmath>

namespace vorion::test {
namespace {

constexpr double Pi = 3.14159265358979323846;

/// \p Count of one scale in every direction.
splat::Scene scattered(uint32_t Seed, int Count, std::array<double, 3> Scale) {
  Numbers R(Seed);
  splat::Scene S;
  for (int I = 0; I < Count; ++I) {
    Blob B;
    B.Mean = {static_cast<float>(R.uniform(-1.5, 1.5)),
              static_cast<float>(R.uniform(-1, 1)),
              static_cast<float>(R.uniform(2, 6))};
    B.Scale = Scale;
    B.Quat = R.turn();
    B.Opacity = R.uniform(0.2, 0.95);
    B.Color = R.color();
    add(S, B);
  }
  return S;
}

HardCase needles() {
  HardCase C{"needles",
             "20 : 1e-4, so that S_xx S_yy - S_xy^2 cancels in fp32",
             scattered(1, 12, {20, 1e-4, 1e-4}),
             frontView(64, 48, 50),
             {}};
  C.Cap = 2e-3; // a relative 1e-5 of a power of up to 5.5, many times over
  // Without dilation the terms of the power are 1e8 times their sum.
  C.ExactDigits = 8;
  C.FoundIn = {"determinant-by-difference"};
  return C;
}

HardCase pancakes() {
  HardCase C{"pancakes",
             "20 : 20 : 1e-4 seen from all sides, and exactly edge-on",
             scattered(2, 8, {20, 20, 1e-4}),
             frontView(64, 48, 50),
             {}};
  for (int I = 0; I < 6; ++I) {
    // The normal, turned down into the picture's plane, then within it.
    const float Cos = static_cast<float>(std::cos(0.25 * I + 0.4));
    const float Sin = static_cast<float>(std::sin(0.25 * I + 0.4));
    add(C.Scene, {.Mean = {0, 0, static_cast<float>(3 + 0.2 * I)},
                  .Scale = {20, 20, 1e-4},
                  .Quat = {Cos, Cos, Sin, Sin},
                  .Opacity = 0.5,
                  .Color = {0.15 * I, 0.5, 1 - 0.15 * I}});
  }
  C.Cap = 2e-4;
  C.FoundIn = {"determinant-by-difference"};
  return C;
}

HardCase negativeDeterminant() {
  HardCase C{"negative-determinant",
             "a diagonal needle of 2500 px whose determinant is 1e-7 of its "
             "terms: their difference is rounding, of either sign",
             {},
             frontView(64, 48, 50),
             {}};
  for (int I = 0; I < 6; ++I) {
    Blob B;
    B.Mean = {static_cast<float>(0.3 * I - 0.8), 0, 2};
    B.Scale = {100, 1e-3, 1e-3};
    const double Half = (45 + 0.01 * I) * Pi / 360;
    B.Quat = {static_cast<float>(std::cos(Half)), 0, 0,
              static_cast<float>(std::sin(Half))};
    B.Color = {0.1 * I, 0.5, 1 - 0.1 * I};
    add(C.Scene, B);
  }
  C.Cap = 1e-3;
  C.FoundIn = {"determinant-by-difference"};
  return C;
}

HardCase noDilation() {
  HardCase C{"no-dilation",
             "eps2d = 0: the short axis of 0.3 to 1 px is all there is across",
             scattered(3, 24, {1, 0.03, 0.02}),
             frontView(64, 48, 50),
             {}};
  C.Options.Dilation = 0;
  C.Cap = 2e-3;
  C.FoundIn = {"dilation-fixed"};
  return C;
}

HardCase edgeOn() {
  HardCase C{"edge-on-without-area",
             "a disc seen exactly from its edge has no area without dilation: "
             "determinant 0",
             {},
             frontView(64, 48, 50),
             {}};
  C.Options.Dilation = 0;
  add(C.Scene, {.Scale = {0, 0.3, 0.3}});
  add(C.Scene, {.Mean = {0.2F, 0.1F, 2.5F}});
  C.ExpectedCulls[1] = 1;
  C.FoundIn = {"determinant-unchecked"};
  return C;
}

HardCase subpixel() {
  HardCase C{"subpixel",
             "1e-19 to 1e-4: squares are subnormal or 0, the dilation alone "
             "remains",
             {},
             frontView(64, 48, 50),
             {}};
  int I = 0;
  for (const double Scale : {0.0, 1e-30, 1e-19, 1e-15, 1e-10, 1e-6, 1e-4, 1e-3})
    add(C.Scene, {.Mean = {static_cast<float>(0.25 * I++ - 0.9), 0.31F, 2},
                  .Scale = {Scale, Scale, Scale}});
  C.FoundIn = {"dilation-lost"};
  return C;
}

HardCase scalesUp() {
  HardCase C{"huge-scales",
             "1e2 to 1e38: from 1e9 on the determinant is beyond fp32",
             {},
             frontView(64, 48, 50),
             {}};
  uint32_t I = 0;
  for (const double Scale : {1e2, 1e4, 1e6, 1e8, 1e9, 1e12, 1e19, 1e30, 1e38}) {
    if (Scale > 5e8)
      C.BeyondSingle.push_back(I);
    add(C.Scene, {.Mean = {0, 0, static_cast<float>(2 + I)},
                  .Scale = {Scale, Scale, Scale},
                  .Opacity = 0.3,
                  .Color = {0.1 * I, 0.5, 1 - 0.1 * I}});
    ++I;
  }
  C.ExpectedCulls[4] = 5;
  C.FoundIn = {"non-finite-unchecked"};
  return C;
}

HardCase logarithms() {
  HardCase C{"logs-and-logits-of-any-size",
             "finite logarithms and logits up to 3e38 either way: exp must "
             "saturate, not wrap",
             {},
             frontView(64, 48, 50),
             {}};
  int I = 0;
  for (const float Value : {3e38F, 1e4F, 151.0F, 89.0F, 30.0F, -30.0F, -89.0F,
                            -151.0F, -1e4F, -3e38F}) {
    add(C.Scene, {.Mean = {static_cast<float>(0.2 * I - 1), 0, 2}});
    C.Scene.OpacityLogits.back() = Value;
    add(C.Scene, {.Mean = {static_cast<float>(0.2 * I - 1), 0.4F, 2}});
    for (std::size_t K = 1; K <= 3; ++K)
      *(C.Scene.LogScales.end() - static_cast<std::ptrdiff_t>(K)) = Value;
    if (Value > 20)
      C.BeyondSingle.push_back(static_cast<uint32_t>(2 * I + 1));
    ++I;
  }
  C.ExpectedCulls[2] = 5;
  C.ExpectedCulls[4] = 5;
  C.FoundIn = {"exponent-wraps"};
  return C;
}

/// The same turned needles with quaternions times \p Factor.
HardCase quaternions(const std::string &Name, const std::string &Why,
                     float Factor, const std::string &Broken) {
  HardCase C{
      Name, Why, scattered(4, 10, {0.6, 0.05, 0.1}), frontView(64, 48, 50), {}};
  for (float &Q : C.Scene.Quats)
    Q *= Factor;
  C.Cap = 1e-4;
  C.FoundIn = {Broken};
  return C;
}

/// The same needles with quaternions of every length down to subnormal ones,
/// of which two have but one bit.
HardCase shrinkingQuaternions() {
  HardCase C = quaternions("shrinking-quaternions",
                           "lengths 1e-8, 1e-12, 1e-16, 1e-20, 1e-30, 1e-38 "
                           "and subnormal: others divide by at least 1e-12",
                           1, "quaternion-range");
  constexpr float Lengths[] = {1e-8F,  1e-12F, 1e-15F, 1e-16F, 1e-20F,
                               1e-30F, 1e-37F, 1e-38F, 1e-40F, 3e-45F};
  for (std::size_t I = 0; I < C.Scene.Quats.size(); ++I)
    C.Scene.Quats[I] *= Lengths[I / 4];
  C.FoundIn.push_back("quaternion-over-1e-12");
  return C;
}

} // namespace

void addShapes(std::vector<HardCase> &Cases) {
  Cases.push_back(needles());
  Cases.push_back(pancakes());
  Cases.push_back(negativeDeterminant());
  Cases.push_back(noDilation());
  Cases.push_back(edgeOn());
  Cases.push_back(subpixel());
  Cases.push_back(scalesUp());
  Cases.push_back(logarithms());
  Cases.push_back(quaternions("zero-quaternions",
                              "no rotation, by both conventions", 0,
                              "zero-quaternion-unchecked"));
  Cases.push_back(quaternions("tiny-quaternions",
                              "length 1e-38: squares are 0 in fp32", 1e-38F,
                              "quaternion-range"));
  Cases.push_back(shrinkingQuaternions());
  Cases.push_back(quaternions("huge-quaternions",
                              "length 1e38: squares are infinite in fp32",
                              1e38F, "quaternion-range"));
  Cases.push_back(quaternions("unnormalised-quaternions",
                              "length 7: the norm must be divided out", 7,
                              "quaternion-not-normalised"));
}

} // namespace vorion::test
