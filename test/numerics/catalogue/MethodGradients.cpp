// Gradients that methods of training ask for beside those of a picture's loss:
// absolute sums, known depths, poses.
#include "TrainingCase.h"

#include "Build.h"
#include "Convert.h"
#include "Judge.h"
#include "device/Values.h"
#include "picture/Layout.h"
#include "reference/Backward.h"
#include "reference/Render.h"
#include "train/optimize/DeviceRenderer.h"
#include "train/optimize/Pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace vorion::test {
namespace {

/// The rules that all here have.
reference::Options rulesOf(splat::Path P) {
  splat::RenderOptions O;
  O.Blending = P;
  return referenceOptions(O);
}

constexpr double AbsoluteBound = 1e-5;

/// Gaussians in the middle of an even picture whose pixels all have one
/// gradient: to its left and its right they pull alike, and plain sums are 0.
Expected<Finding> absoluteSums(splat::Launcher &L, const Way &W) {
  const splat::Camera View = frontView(20, 10, 20);
  splat::Scene S;
  for (const double Depth : {2., 3., 4.})
    add(S, {.Mean = {0, 0, static_cast<float>(Depth)},
            .Scale = {0.1 * Depth, 0.1 * Depth, 0.1 * Depth},
            .Opacity = 0.5,
            .Color = {0.9, 0.3, 0.25 * Depth}});
  const std::size_t Pixels = 200;
  const auto G = splat::toReference<double>(S);
  const auto Pose = splat::toReference<double>(View);
  const reference::Options Rules = rulesOf(W.Blending);
  const auto Doubts = reference::blend(reference::project(G, Pose, Rules),
                                       View.Width, View.Height, Rules)
                          .Doubts;
  std::vector<double> Want(2 * S.size(), 0), Plain = Want;
  std::vector<float> ByRender;
  for (std::size_t Pixel = 0; Pixel < Pixels; ++Pixel) {
    const float Slope = Doubts[Pixel] == 0 ? 0.5F : 0;
    ByRender.insert(ByRender.end(), 3, Slope);
    // One pixel alone: the way back is linear in the pixels' gradients.
    reference::Upstream U;
    U.Render.assign(Pixels, glm::dvec3(0));
    U.Render[Pixel] = glm::dvec3(double(Slope));
    U.Alpha.assign(Pixels, 0);
    const auto B = reference::renderBackward(G, Pose, U, Rules);
    for (std::size_t I = 0; I < S.size(); ++I)
      for (int K = 0; K < 2; ++K) {
        const std::size_t At = S.size() * std::size_t(K) + I;
        Plain[At] += B.Means2d[I][K];
        Want[At] += std::abs(B.Means2d[I][K]);
      }
  }
  splat::BackwardOptions Options;
  Options.Pixels = W.Sums;
  Options.AbsoluteSums = true;
  L.beginStage(splat::Stage::Blend);
  splat::DeviceRenderer R(L, splat::Rules::Inria, W.Blending, Options, {});
  const auto D = splat::DeviceScene::upload(L, S);
  R.forward(D, View, 0);
  const auto Seen = R.backward(upload(L, ByRender),
                               upload(L, std::vector<float>(Pixels, 0)), {})
                        .Seen;
  std::vector<float> Planes((Seen.MeanPlane + 2) * S.size());
  L.read("sums", Planes.data(), Seen.Gradients, 4 * Planes.size());
  Worst Found(AbsoluteBound);
  for (std::size_t I = 0; I < Want.size(); ++I) {
    Found.demand(std::abs(Plain[I]) < 1e-9 * Want[I],
                 "the signed sum is not 0, expected it to cancel");
    Found.take("an absolute sum", double(Planes[Seen.MeanPlane * S.size() + I]),
               Want[I], Want[I]);
  }
  return Found.finding(L);
}

constexpr double DepthBound = 1e-5;

/// The expected depth of one Gaussian is its own, whatever its alpha is, so
/// that what is known of it pulls along the axis alone.
Expected<Finding> depthsOfOne(splat::Launcher &L, const Way &W) {
  constexpr std::size_t Pixels = 16 * 12;
  constexpr float Weight = 0.5F;
  const splat::Camera View = frontView(16, 12, 20);
  splat::BackwardOptions Options;
  Options.Pixels = W.Sums;
  Options.Depths = true;
  L.beginStage(splat::Stage::Blend);
  const cl::Buffer None = upload(L, std::vector<float>(3 * Pixels, 0));
  splat::DeviceRenderer R(L, splat::Rules::Inria, W.Blending, Options, {});
  Worst Found(DepthBound);
  for (const double Depth : {0.21, 2., 1e6}) {
    splat::Scene S;
    add(S, {.Mean = {0, 0, static_cast<float>(Depth)},
            .Scale = {0.1 * Depth, 0.1 * Depth, 0.001 * Depth},
            .Opacity = 0.6});
    // As near and as far as numbers get, two of each in one pixel; and one in a
    // pixel that shows nothing.
    const uint32_t Middle = 16 * 6 + 8;
    const std::vector<splat::DepthPoint> Known{{0, 0.5F},
                                               {Middle - 1, 1e-38F},
                                               {Middle, 1e-38F},
                                               {Middle, 1e-30F},
                                               {Middle + 1, 1e38F},
                                               {Middle + 16, 1e38F},
                                               {Middle + 16, 1e38F},
                                               {Middle + 16, 1e38F}};
    // Three are farther than it is, four are nearer.
    const double By = double(Weight) * (3 - 4);
    auto D = splat::DeviceScene::upload(L, S);
    R.forward(D, View, 0);
    D.Parameters = R.backward(None, None, {&Known, Weight}).Gradients;
    const splat::Scene Got = D.download(L);
    if (L.failure())
      return *L.failure();
    const double Z = double(static_cast<float>(Depth));
    const double Unit = double(Weight) / (Z * Z);
    Found.take("the gradient by depth", double(Got.Means[2]), -By / (Z * Z),
               Unit);
    for (std::size_t K = 0; K < 2; ++K)
      Found.take("that across", double(Got.Means[K]), 0, 20 * Unit);
    // As it is stored: times the opacity and the rest.
    Found.take("that by opacity", double(Got.OpacityLogits[0]), 0, Unit * Z);
    for (const float V : Got.LogScales)
      Found.take("that by scale", double(V), 0, Unit * Z);
  }
  return Found.finding(L);
}

constexpr double PoseBound = 1e-5;

/// A camera a million from the origin, at a place that no float has. As it
/// moves, round Gaussians move the other way; as it turns, around it.
Expected<Finding> poseFarAway(splat::Launcher &L, const Way &W) {
  splat::Camera View = frontView(48, 36, 40);
  View.Position = {1e6 + 0.02, -3e5 + 0.01, 7e5 - 0.03};
  splat::Scene S;
  Numbers R(59);
  for (int I = 0; I < 20; ++I) {
    const double Size = R.uniform(0.3, 0.6);
    add(S, {.Mean = seenAt(View, R.uniform(-2, 2), R.uniform(-1.5, 1.5),
                           R.uniform(6, 9)),
            .Scale = {Size, Size, Size},
            .Opacity = R.uniform(0.3, 0.8),
            .Color = R.color()});
  }
  const auto G = splat::toReference<double>(S);
  const auto Pose = splat::toReference<double>(View);
  const reference::Options Rules = rulesOf(W.Blending);
  const auto Doubts = reference::blend(reference::project(G, Pose, Rules),
                                       View.Width, View.Height, Rules)
                          .Doubts;
  reference::Upstream U;
  std::vector<float> ByRender;
  for (const uint8_t Doubt : Doubts) {
    for (int K = 0; K < 3; ++K)
      ByRender.push_back(Doubt == 0 ? static_cast<float>(R.uniform(-1, 1)) : 0);
    const float *const V = &*ByRender.end() - 3;
    U.Render.emplace_back(V[0], V[1], V[2]);
    U.Alpha.push_back(0);
  }
  const auto B = reference::renderBackward(G, Pose, U, Rules);
  glm::dvec3 Force(0), Torque(0);
  double Forces = 0, Torques = 0;
  for (std::size_t I = 0; I < S.size(); ++I) {
    const glm::dvec3 Arm =
        G.Means[I] -
        glm::dvec3(View.Position[0], View.Position[1], View.Position[2]);
    Force -= B.Means[I];
    Torque -= glm::cross(Arm, B.Means[I]);
    Forces += glm::length(B.Means[I]);
    Torques += glm::length(Arm) * glm::length(B.Means[I]);
  }
  splat::TrainSettings T;
  T.PoseRate = 1e-3;
  splat::BackwardOptions Options;
  Options.Pixels = W.Sums;
  Options.Poses = true;
  L.beginStage(splat::Stage::Blend);
  L.build(splat::poseProgram());
  splat::Poses Given(L, T, {View}, 3);
  splat::DeviceRenderer Renderer(L, splat::Rules::Inria, W.Blending, Options,
                                 {});
  const auto D = splat::DeviceScene::upload(L, S);
  Renderer.forward(D, View, 0);
  const auto Back = Renderer.backward(
      upload(L, ByRender), upload(L, std::vector<float>(Doubts.size(), 0)), {});
  const splat::PoseSlope Got = Given.slope(0, D.Parameters, Back, D.Count);
  Worst Found(PoseBound);
  for (std::size_t K = 0; K < 3; ++K) {
    Found.take("the gradient by place", Got[K], Force[static_cast<int>(K)],
               Forces);
    Found.take("that by turn", Got[3 + K], Torque[static_cast<int>(K)],
               Torques);
  }
  return Found.finding(L);
}

} // namespace

void addMethodGradients(std::vector<TrainingCase> &Cases) {
  Cases.push_back(
      {"absolute-sums-that-cancel",
       "gradients to the left and the right of a mean are equal: "
       "their sum is 0, that of their sizes is not",
       fmt::format("{:.0e} of fp64's, pixel by pixel", AbsoluteBound),
       absoluteSums,
       {"absolute-sums-signed"},
       /*Blends=*/true,
       splat::Path::Simt,
       /*GoesBack=*/true});
  Cases.push_back(
      {"depths-of-one",
       "known depths of 1e-38 and 1e38 of one Gaussian at 0.21, 2 "
       "and 1e6: they pull along the axis, and alpha cancels",
       fmt::format("{:.0e} of the weights over depth^2, others 0", DepthBound),
       depthsOfOne,
       {"points-of-a-pixel-lost"},
       /*Blends=*/true,
       {},
       /*GoesBack=*/true});
  Cases.push_back(
      {"pose-far-away",
       "a camera 1e6 from the origin, at a place that no float "
       "has: what turns it hangs on differences",
       fmt::format("{:.0e} of fp64's sums over the Gaussians", PoseBound),
       poseFarAway,
       {"pose-of-one-float"},
       /*Blends=*/true,
       {},
       /*GoesBack=*/true});
}

} // namespace vorion::test
