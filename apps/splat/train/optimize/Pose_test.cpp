// Corrections of poses: gradients on the device, steps, and a capture whose
// poses are wrong.
#include "train/optimize/Pose.h"

#include "analyze/ToReference.h"
#include "device/OnDevice.h"
#include "reference/Render.h"
#include "train/optimize/DeviceRenderer.h"
#include "train/run/Trainer.h"
#include "train/testing/SmallScenes.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat {
namespace {

Camera cameraAt(double Angle) {
  return aroundOrigin(Camera::ahead(36, 28, 36), Angle, 0.1);
}

class PosesOnDevice
    : public OnDevice,
      public testing::WithParamInterface<std::tuple<Rules, Path>> {
protected:
  static TrainSettings settings(double Rate) {
    TrainSettings T;
    T.PoseRate = T.LastPoseRate = Rate;
    return T;
  }

  static void build(Launcher &L, const TrainSettings &T) {
    L.beginStage(Stage::Build);
    for (const ProgramSpec &P : Trainer::programs(T, {}))
      L.build(P);
  }
};

class PoseStepsOnDevice : public OnDevice {};
class DisturbedPosesOnDevice : public PosesOnDevice {};

/// Central differences in fp64 of a loss by the camera's place and turn in the
/// world, from a pose that is corrected already; with known depths among it.
/// All Gaussians are where INRIA's rules, too, differentiate the whole
/// Jacobian.
TEST_P(PosesOnDevice, GradientsAreThoseOfThePose) {
  const auto [Convention, Blending] = GetParam();
  reference::Options O;
  O.Rule = toReference(Convention);
  for (const bool Antialiased : {false, true}) {
    O.Antialiased = Antialiased;
    const Scene S = randomScene(Random, 30, 2);
    const auto G = toReference<double>(S);
    const TrainSettings T = settings(1e-3);
    Launcher L(*Dev, "", {});
    build(L, T);
    Poses P(L, T, {cameraAt(0.3)}, 3);
    std::vector<float> Saved{0.02F, -0.01F, 0.03F, 0.05F, -0.04F, 0.15F};
    Saved.resize(18, 0);
    P.restore(Saved);
    const Camera C = P.at(0);
    ASSERT_TRUE(isRotation(C.Rotation));
    const auto Blend = [&](const Camera &From, bool Depths) {
      auto Splats = reference::project(G, toReference<double>(From), O);
      if (Depths)
        for (auto &One : Splats)
          One.Color = {One.Depth, 1, 0};
      return reference::blend(Splats, From.Width, From.Height, O);
    };
    const auto Want = Blend(C, false), Deep = Blend(C, true);
    std::vector<float> ByRender, ByAlpha;
    std::normal_distribution<float> Normal;
    for (const uint8_t Doubt : Want.Doubts) {
      for (int K = 0; K < 3; ++K)
        ByRender.push_back(Doubt == 0 ? Normal(Random) : 0);
      ByAlpha.push_back(Doubt == 0 ? Normal(Random) : 0);
    }
    std::vector<DepthPoint> Known;
    for (uint32_t I = 0; I < Deep.Render.size(); I += 29)
      if (const glm::dvec3 &V = Deep.Render[I];
          Deep.Doubts[I] == 0 && V.y > 0.05)
        Known.push_back({I, static_cast<float>(1.3 * V.y / V.x)});
    ASSERT_GT(Known.size(), 5U);
    constexpr float Weight = 20;
    const auto Loss = [&](const Camera &From) {
      const auto Now = Blend(From, false), NowDeep = Blend(From, true);
      double Sum = 0;
      for (std::size_t I = 0; I < ByAlpha.size(); ++I) {
        for (int K = 0; K < 3; ++K)
          Sum +=
              ByRender[3 * I + static_cast<std::size_t>(K)] * Now.Render[I][K];
        Sum += ByAlpha[I] * (1 - Now.Transmittance[I]);
      }
      for (const DepthPoint &K : Known)
        Sum += Weight *
               std::abs(NowDeep.Render[K.Pixel].y / NowDeep.Render[K.Pixel].x -
                        double{K.Disparity});
      return Sum;
    };

    BackwardOptions Options;
    Options.Poses = Options.Depths = true;
    DeviceRenderer R(L, Convention, Blending, Options,
                     {.Antialiased = Antialiased});
    const DeviceScene D = DeviceScene::upload(L, S);
    R.forward(D, C, 2);
    const auto Back =
        R.backward(upload(L, ByRender), upload(L, ByAlpha), {&Known, Weight});
    const PoseSlope Got = P.slope(0, D.Parameters, Back, D.Count);
    ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();

    constexpr double Step = 1e-6;
    double Off = 0, Whole = 0;
    for (std::size_t K = 0; K < 6; ++K) {
      const auto At = [&](double By) {
        Camera Moved = C;
        if (K < 3) {
          Moved.Position[K] += By;
          return Loss(Moved);
        }
        // Turned about axis K - 3 of the world.
        const std::size_t A = (K + 1) % 3, B = (K + 2) % 3;
        for (std::size_t I = 0; I < 3; ++I) {
          const double X = C.Rotation[A][I], Y = C.Rotation[B][I];
          Moved.Rotation[A][I] = std::cos(By) * X - std::sin(By) * Y;
          Moved.Rotation[B][I] = std::sin(By) * X + std::cos(By) * Y;
        }
        return Loss(Moved);
      };
      const double Slope = (At(Step) - At(-Step)) / (2 * Step);
      Off += (Got[K] - Slope) * (Got[K] - Slope);
      Whole += Slope * Slope;
      EXPECT_NEAR(Got[K], Slope, 1e-4 * (1 + std::abs(Slope))) << K;
    }
    EXPECT_LE(std::sqrt(Off / Whole), 1e-5) << Antialiased;
  }
}

/// A step goes by the gradient of a loss that is known in closed form: how far
/// the corrected cameras are from where they should be. Whatever moves, turns
/// or scales all of them alike stays out.
TEST_F(PoseStepsOnDevice, FollowTheGradient) {
  TrainSettings T;
  T.PoseRate = T.LastPoseRate = 2e-3;
  Launcher L(*Dev, "", {});
  std::vector<Camera> Given;
  for (int I = 0; I < 9; ++I) {
    Given.push_back(cameraAt(0.7 * I));
    Given.back().Position[1] = 0.3 * (I % 3);
  }
  Poses Goal(L, T, Given, 3), P(L, T, Given, 3);
  // Goals without a common part, by steps from random slopes.
  std::normal_distribution<double> Normal;
  std::vector<Poses::Slope> Slopes;
  for (unsigned I = 1; I <= 40; ++I) {
    Slopes.clear();
    for (std::size_t V = 0; V < Given.size(); ++V) {
      PoseSlope By{};
      for (double &G : By)
        G = Normal(Random) + 3;
      Slopes.push_back({V, By});
    }
    Goal.step(Slopes, I);
  }
  EXPECT_GT(Goal.change().MeanTurn, 1e-2);
  std::array<double, 3> Motion{};
  double Growth = 0;
  for (std::size_t V = 0; V < Given.size(); ++V)
    for (std::size_t K = 0; K < 3; ++K) {
      const double Shift = Goal.at(V).Position[K] - Given[V].Position[K];
      Motion[K] += Shift / 9;
      Growth += Shift * Given[V].Position[K] / 81;
    }
  for (const double M : Motion)
    EXPECT_NEAR(M, 0, 1e-6);
  EXPECT_NEAR(Growth, 0, 1e-6);

  const auto Apart = [&](std::size_t V) {
    double Sum = 0;
    const Camera A = P.at(V), B = Goal.at(V);
    for (std::size_t K = 0; K < 3; ++K) {
      Sum += std::pow(A.Position[K] - B.Position[K], 2);
      for (std::size_t I = 0; I < 3; ++I)
        Sum += std::pow(A.Rotation[K][I] - B.Rotation[K][I], 2);
    }
    return Sum;
  };
  const auto All = [&] {
    double Sum = 0;
    for (std::size_t V = 0; V < Given.size(); ++V)
      Sum += Apart(V);
    return Sum;
  };
  const double Before = All();
  for (unsigned I = 1; I <= 300; ++I) {
    Slopes.clear();
    for (std::size_t V = 0; V < Given.size(); ++V) {
      const Camera A = P.at(V), B = Goal.at(V);
      PoseSlope By{};
      for (std::size_t K = 0; K < 3; ++K) {
        By[K] = 2 * (A.Position[K] - B.Position[K]);
        // d|A - B|^2 for A turned about axis K of the world.
        const std::size_t X = (K + 1) % 3, Y = (K + 2) % 3;
        for (std::size_t C = 0; C < 3; ++C)
          By[3 + K] += 2 * (A.Rotation[X][C] * B.Rotation[Y][C] * -1 +
                            A.Rotation[Y][C] * B.Rotation[X][C]);
      }
      Slopes.push_back({V, By});
    }
    P.step(Slopes, I);
  }
  EXPECT_LT(All(), 1e-3 * Before);
}

/// Pictures were taken from elsewhere than the capture says: the poses come
/// back, as far as not all of them are wrong in the same way. Without a rate
/// they stay.
TEST_P(DisturbedPosesOnDevice, AreFoundAgain) {
  const Scene S = randomScene(Random, 40, 0);
  TrainRun Run;
  Run.Extent = 3;
  Run.Settings = settings(4e-3);
  Run.Settings.LastPoseRate = 2e-4;
  Run.Settings.PositionSteps = 160;
  Run.Settings.PositionRate = Run.Settings.LastPositionRate = 1e-12;
  Run.Settings.ColourRate = Run.Settings.OpacityRate = Run.Settings.ScaleRate =
      Run.Settings.RotationRate = 0; // the scene is right
  Launcher L(*Dev, "", {});
  build(L, Run.Settings);
  std::vector<Camera> Said;
  for (int I = 0; I < 8; ++I)
    Said.push_back(cameraAt(0.8 * I));
  // Random steps, of which the common part is taken out.
  Poses Taken(L, Run.Settings, Said, Run.Extent);
  std::uniform_real_distribution<double> Unit(-1, 1);
  for (unsigned I = 1; I <= 6; ++I) {
    std::vector<Poses::Slope> Slopes;
    for (std::size_t V = 0; V < Said.size(); ++V) {
      PoseSlope By{};
      for (double &G : By)
        G = (V % 2 == 0 ? 1 : -1) + 2 * Unit(Random);
      Slopes.push_back({V, By});
    }
    Taken.step(Slopes, I);
  }
  TrainingSet Set;
  for (std::size_t V = 0; V < Said.size(); ++V)
    Set.Training.push_back({Said[V], photographed(S, Taken.at(V)), {}, {}});
  BackwardOptions Options;
  Options.Poses = true;
  DeviceRenderer R(L, Rules::Inria, std::get<1>(GetParam()), Options, {});
  OneRank Alone;
  // How far the means are from their places on the pictures, px.
  const auto Apart = [&](const Trainer &T) {
    const auto G = toReference<double>(S);
    double Sum = 0;
    for (std::size_t V = 0; V < Said.size(); ++V) {
      const auto Found =
          reference::project(G, toReference<double>(T.pose(V)), {});
      const auto Want =
          reference::project(G, toReference<double>(Taken.at(V)), {});
      for (std::size_t I = 0; I < S.size(); ++I)
        Sum += std::hypot(Found[I].Mean.x - Want[I].Mean.x,
                          Found[I].Mean.y - Want[I].Mean.y);
    }
    return Sum / static_cast<double>(Said.size() * S.size());
  };
  Trainer T(L, R, Set, Run, Alone);
  T.start(S);
  const double Before = Apart(T);
  std::optional<Checkpoint> Half;
  double First = 0, Last = 0;
  for (int I = 0; I < 160; ++I) {
    const double Loss = T.step().Loss.Value;
    First += I < 8 ? Loss : 0;
    Last += I >= 152 ? Loss : 0;
    if (I == 149)
      Half = T.save();
  }
  ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
  EXPECT_GT(Before, 0.5);
  EXPECT_LT(Apart(T), 0.25 * Before);
  EXPECT_LT(Last, 0.5 * First);
  EXPECT_GT(T.poseChange().MeanTurn, 0.005);
  // The same bits from the middle on.
  const Checkpoint Whole = T.save();
  EXPECT_EQ(Whole.Poses.size(), 18 * Said.size());
  T.restore(*Half);
  while (T.iteration() < 160)
    T.step();
  EXPECT_EQ(T.save().Poses, Whole.Poses);
  // Without a rate.
  TrainRun Plain = Run;
  Plain.Settings.PoseRate = 0;
  Trainer Stays(L, R, Set, Plain, Alone);
  Stays.start(S);
  for (int I = 0; I < 8; ++I)
    Stays.step();
  EXPECT_EQ(Apart(Stays), Before);
  EXPECT_TRUE(Stays.save().Poses.empty());
}

std::string nameOf(const testing::TestParamInfo<std::tuple<Rules, Path>> &Of) {
  return std::string(name(std::get<0>(Of.param))) + "_" +
         std::string(name(std::get<1>(Of.param)));
}

INSTANTIATE_TEST_SUITE_P(
    Paths, PosesOnDevice,
    testing::Combine(testing::Values(Rules::Inria, Rules::Gsplat),
                     testing::Values(Path::Raster, Path::Simt)),
    nameOf);

INSTANTIATE_TEST_SUITE_P(Paths, DisturbedPosesOnDevice,
                         testing::Combine(testing::Values(Rules::Inria),
                                          testing::Values(Path::Raster,
                                                          Path::Simt)),
                         nameOf);

} // namespace
} // namespace vorion::splat
