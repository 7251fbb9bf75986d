// Where Gaussians stand to the camera, and where they land on the picture.
#include "Build.h"

#include <cmath>

namespace vorion::test {
namespace {

float next(float Value, int Ulps) {
  for (; Ulps > 0; --Ulps)
    Value = std::nextafter(Value, 1e38F);
  for (; Ulps < 0; ++Ulps)
    Value = std::nextafter(Value, -1e38F);
  return Value;
}

HardCase nearPlane() {
  HardCase C{"near-plane",
             "on the near plane 0.2 and one ulp either side, at the camera's "
             "plane, at the camera",
             {},
             frontView(64, 48, 50),
             {}};
  for (const float Z : {next(0.2F, -1), 0.2F, 0.0F, -0.0F, 1e-38F, -1e-38F})
    add(C.Scene, {.Mean = {0.01F, 0, Z}, .Scale = {0.02, 0.02, 0.02}});
  add(C.Scene, {.Mean = {0, 0, 0}, .Scale = {1, 1, 1}, .Color = {1, 1, 1}});
  // These two are in front of it.
  add(C.Scene, {.Mean = {-0.02F, 0, next(0.2F, 1)},
                .Scale = {0.02, 0.02, 0.02},
                .Opacity = 0.5});
  add(C.Scene, {.Mean = {0.05F, 0.02F, 0.25F}, .Scale = {0.03, 0.03, 0.03}});
  C.BeyondSingle = {1}; // 0.2 in fp32 is above 0.2
  C.ExpectedCulls[0] = 7;
  C.Cap = 1e-4;
  C.FoundIn = {"near-plane-at-0"};
  return C;
}

HardCase behind() {
  HardCase C{"behind-the-camera",
             "behind it, large enough to reach through, beside one in front",
             {},
             frontView(64, 48, 50),
             {}};
  Numbers R(21);
  for (int I = 0; I < 12; ++I)
    add(C.Scene, {.Mean = {static_cast<float>(R.uniform(-1, 1)),
                           static_cast<float>(R.uniform(-1, 1)),
                           static_cast<float>(R.uniform(-5, -0.1))},
                  .Scale = {3, 3, 3}});
  add(C.Scene, {});
  C.ExpectedCulls[0] = 12;
  C.FoundIn = {"behind-mirrored"};
  return C;
}

HardCase beyondView() {
  HardCase C{"beyond-the-field-of-view",
             "means up to 89 degrees aside that reach in: the Jacobian is held "
             "at 1.3 times the view",
             {},
             frontView(64, 48, 50),
             {}};
  Numbers R(22);
  for (int I = 0; I < 16; ++I) {
    const double Angle = 0.4 * I, Aside = 1.2 * std::pow(1.45, I);
    add(C.Scene, {.Mean = {static_cast<float>(Aside * std::cos(Angle)),
                           static_cast<float>(Aside * std::sin(Angle)), 1.5F},
                  .Scale = {0.5 * Aside, 0.4 * Aside, 0.3 * Aside},
                  .Quat = R.turn(),
                  .Opacity = 0.4,
                  .Color = R.color()});
  }
  C.Cap = 1e-4;
  C.FoundIn = {"jacobian-unclamped"};
  return C;
}

HardCase farFromOrigin() {
  HardCase C{"far-from-the-origin",
             "camera and scene 1e6 from the origin: R m + t cancels 5 digits",
             {},
             turnedView(frontView(64, 48, 50)),
             {}};
  C.View.Position = {1e6 + 0.02, -7e5, 3e5};
  Numbers R(23);
  for (int I = 0; I < 40; ++I)
    add(C.Scene, {.Mean = seenAt(C.View, R.uniform(-60, 60), R.uniform(-45, 45),
                                 R.uniform(60, 160)),
                  .Scale = {6, 4, 5},
                  .Quat = R.turn(),
                  .Opacity = 0.6,
                  .Color = R.color()});
  C.FoundIn = {"centre-of-one-float"};
  return C;
}

HardCase beyond16k() {
  HardCase C{"coordinates-beyond-16k",
             "means at +-25,000 to +-1e7 px and negative coordinates, boxes "
             "that reach back",
             {},
             frontView(64, 48, 50),
             {}};
  int I = 0;
  for (const double Aside : {1e3, 1e4, 4e5})
    for (const double Sign : {-1.0, 1.0}) {
      const double X = Sign * Aside, Y = I % 2 ? 0.3 * Aside : -0.2 * Aside;
      add(C.Scene, {.Mean = {static_cast<float>(X), static_cast<float>(Y), 2},
                    .Scale = {0.6 * Aside, 0.6 * Aside, 0.6 * Aside},
                    .Opacity = 0.7,
                    .Color = {0.15 * I, 0.5, 1 - 0.15 * I}});
      add(C.Scene, {.Mean = {static_cast<float>(X), 0, 2}}); // does not reach
      ++I;
    }
  C.ExpectedCulls[3] = 6;
  C.Cap = 1e-3;
  C.FoundIn = {"negative-tiles-wrap"};
  return C;
}

HardCase outside() {
  HardCase C{"outside-the-picture",
             "boxes that end one pixel beside the picture, and in the part of "
             "the last tiles that is no picture",
             {},
             frontView(70, 50, 50),
             {}};
  // Boxes of about 3 px around means 5 px outside each edge, and at a corner.
  const float Left = -40.0F / 25, Right = 40.0F / 25;
  const float Top = -30.0F / 25, Bottom = 30.0F / 25;
  for (const auto &[X, Y] :
       {std::pair(Left, 0.0F), std::pair(Right, 0.0F), std::pair(0.0F, Top),
        std::pair(0.0F, Bottom), std::pair(Right, Bottom)})
    add(C.Scene, {.Mean = {X, Y, 2}, .Scale = {0.03, 0.03, 0.03}});
  add(C.Scene, {});
  C.ExpectedCulls[3] = 5;
  C.FoundIn = {"boxes-beyond-the-picture"};
  return C;
}

HardCase radiusBeyondInt() {
  HardCase C{"radius-beyond-an-int",
             "INRIA's radius of up to 8e9 px, more than an int holds",
             {},
             frontView(64, 48, 50),
             {}};
  C.Options.Reach = splat::Support::Square3;
  int I = 0;
  for (const double Scale : {1e5, 3e7, 1e8})
    add(C.Scene, {.Mean = {0, 0, static_cast<float>(2 + I++)},
                  .Scale = {Scale, Scale, Scale},
                  .Opacity = 0.5,
                  .Color = {0.3 * I, 0.5, 1 - 0.3 * I}});
  C.FoundIn = {"radius-of-16-bits"};
  return C;
}

HardCase boxEdges() {
  HardCase C{"box-edges",
             "a box of 3 px exactly (focal 2, depth 2, scale 1, no dilation) "
             "whose sides lie on pixel centres and tile borders, +-1 ulp",
             {},
             frontView(160, 16, 2),
             {}};
  C.Options.Reach = splat::Support::Box3;
  C.Options.Dilation = 0;
  Numbers R(25);
  C.View.Cx = 0; // the mean is x, without rounding
  for (const float Column : {5.5F, 12.0F, 19.0F, 61.0F, 67.0F, 80.5F, 125.0F,
                             131.0F, 156.5F, 157.0F})
    for (const int Ulps : {-1, 0, 1})
      add(C.Scene,
          {.Mean = {next(Column, Ulps), static_cast<float>(Ulps) * 1.5F, 2},
           .Scale = {1, 1, 0}, // flat: the same aside as ahead
           .Opacity = 0.7,
           .Color = R.color()});
  C.MostDoubtful = 0.5;
  C.FoundIn = {"box-without-its-border"};
  return C;
}

HardCase wide() {
  HardCase C{"one-over-3840x2160",
             "one Gaussian over 8.3 M pixels: each alpha alone, and the sum of "
             "all, which in fp32 in sequence comes out wrong by per cents",
             {},
             frontView(3840, 2160, 2000),
             {}};
  add(C.Scene, {.Mean = {0.013F, -0.007F, 2},
                .Scale = {0.9, 0.5, 0.5},
                .Opacity = 0.97});
  C.FoundIn = {"opacity-of-9-bits"};
  C.MayExceedMemory = true; // 16 depth parts
  C.Long = true;
  return C;
}

} // namespace

void addViews(std::vector<HardCase> &Cases) {
  Cases.push_back(nearPlane());
  Cases.push_back(behind());
  Cases.push_back(beyondView());
  Cases.push_back(farFromOrigin());
  Cases.push_back(beyond16k());
  Cases.push_back(outside());
  Cases.push_back(radiusBeyondInt());
  Cases.push_back(boxEdges());
  Cases.push_back(wide());
}

} // namespace vorion::test
