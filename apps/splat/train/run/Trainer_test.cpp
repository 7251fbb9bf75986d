// The loop, mostly with the reference as its renderer: what it does with
// gradients, not how they are made.
#include "train/run/Trainer.h"

#include "analyze/ToReference.h"
#include "device/OnDevice.h"
#include "picture/Layout.h"
#include "reference/Backward.h"
#include "reference/Render.h"
#include "render/Planes.h"
#include "train/optimize/DeviceRenderer.h"
#include "train/settings/SettingsTable.h"
#include "train/testing/SmallScenes.h"

#include <algorithm>
#include <barrier>
#include <cmath>
#include <cstring>
#include <numeric>
#include <thread>

namespace vorion::splat {
namespace {

/// Renders and differentiates in fp64 on the host.
class ReferenceRenderer : public GradientRenderer {
public:
  ReferenceRenderer(Launcher &Launch) : Launch(Launch) {}

  void setBackground(const std::array<float, 3> &C) override {
    Options.Background = {C[0], C[1], C[2]};
  }

  cl::Buffer forward(const DeviceScene &D, const Camera &C,
                     int ShDegree) override {
    Pose = C;
    Now = D.download(Launch);
    // Bands above the degree left out.
    const std::vector<float> Sh = shPlanes(Now, ShDegree);
    Now = sceneOfPlanes(geometryPlanes(Now), Sh, ShDegree);
    const auto P = reference::render(toReference<double>(Now),
                                     toReference<double>(C), Options);
    std::vector<float> Rgba;
    for (std::size_t I = 0; I < P.Render.size(); ++I) {
      for (int K = 0; K < 3; ++K)
        Rgba.push_back(static_cast<float>(P.Render[I][K]));
      Rgba.push_back(static_cast<float>(1 - P.Transmittance[I]));
    }
    return upload(Rgba);
  }

  Backward backward(const cl::Buffer &ByRender, const cl::Buffer & /*ByAlpha*/,
                    const DepthTargets & /*Known*/) override {
    const std::size_t Pixels =
        static_cast<std::size_t>(Pose.Width * Pose.Height);
    std::vector<float> Given(3 * Pixels);
    Launch.read("upstream", Given.data(), ByRender, 4 * Given.size());
    reference::Upstream U;
    for (std::size_t I = 0; I < Pixels; ++I)
      U.Render.emplace_back(Given[3 * I], Given[3 * I + 1], Given[3 * I + 2]);
    U.Alpha.assign(Pixels, 0);
    const auto G = toReference<double>(Now);
    const auto B = renderBackward(G, toReference<double>(Pose), U, Options);

    Scene Slopes = Scene::sized(Now.size(), Now.ShDegree);
    std::vector<float> Means2d(2 * Now.size());
    std::vector<uint32_t> Depths;
    std::vector<splat_gaussian> Records(Now.size());
    for (std::size_t I = 0; I < Now.size(); ++I) {
      double Norm = 0;
      for (std::size_t K = 0; K < 4; ++K)
        Norm += double(Now.Quats[4 * I + K]) * Now.Quats[4 * I + K];
      for (int K = 0; K < 3; ++K) {
        const auto At = 3 * I + static_cast<std::size_t>(K);
        Slopes.Means[At] = static_cast<float>(B.Means[I][K]);
        Slopes.LogScales[At] =
            static_cast<float>(B.Scales[I][K] * G.Scales[I][K]);
      }
      for (int K = 0; K < 4; ++K)
        Slopes.Quats[4 * I + static_cast<std::size_t>(K)] =
            static_cast<float>(B.Quats[I][K] / std::sqrt(Norm));
      Slopes.OpacityLogits[I] = static_cast<float>(
          B.Opacities[I] * G.Opacities[I] * (1 - G.Opacities[I]));
      Means2d[I] = static_cast<float>(B.Means2d[I].x);
      Means2d[Now.size() + I] = static_cast<float>(B.Means2d[I].y);
      Depths.push_back(0); // all are seen in these tests
      Records[I].conic[0] = Records[I].conic[2] = 1;
    }
    for (std::size_t I = 0; I < B.Sh.size(); ++I)
      for (int K = 0; K < 3; ++K)
        Slopes.Sh[3 * I + static_cast<std::size_t>(K)] =
            static_cast<float>(B.Sh[I][K]);
    const auto Geometry = geometryPlanes(Slopes);
    const auto Sh = shPlanes(Slopes, Slopes.ShDegree);
    return {{upload(Geometry), upload(Sh)},
            {upload(Records), upload(Depths), upload(Means2d), 0, Pose.Width,
             Pose.Height}};
  }

private:
  template <typename T> cl::Buffer upload(const std::vector<T> &Values) {
    const cl::Buffer B = Launch.allocate("values", sizeof(T) * Values.size());
    Launch.write("values", B, Values.data(), sizeof(T) * Values.size());
    return B;
  }

  Launcher &Launch;
  reference::Options Options;
  Scene Now;
  Camera Pose;
};

/// Processes of a run as threads of this one.
class ThreadRanks : public Ranks {
public:
  /// What they have in common.
  struct Room {
    explicit Room(unsigned Count) : Size(Count), Everybody(Count) {}
    unsigned Size;
    std::barrier<> Everybody;
    void *Data = nullptr;
  };
  ThreadRanks(Room &In, unsigned Number) : Shared(In), Own(Number) {}

  unsigned rank() const override { return Own; }
  unsigned size() const override { return Shared.Size; }
  void share(unsigned From, void *Data, std::size_t Bytes) override {
    if (Own == From)
      Shared.Data = Data;
    Shared.Everybody.arrive_and_wait();
    if (Own != From && Bytes != 0)
      std::memcpy(Data, Shared.Data, Bytes);
    Shared.Everybody.arrive_and_wait();
  }

private:
  Room &Shared;
  unsigned Own;
};

void expectSame(const Checkpoint &A, const Checkpoint &B) {
  EXPECT_EQ(A.Iteration, B.Iteration);
  EXPECT_EQ(A.Geometry, B.Geometry);
  EXPECT_EQ(A.Sh, B.Sh);
  EXPECT_EQ(A.FirstGeometry, B.FirstGeometry);
  EXPECT_EQ(A.FirstSh, B.FirstSh);
  EXPECT_EQ(A.SecondGeometry, B.SecondGeometry);
  EXPECT_EQ(A.SecondSh, B.SecondSh);
  EXPECT_EQ(A.Identities, B.Identities);
  EXPECT_EQ(A.Notes.GradientSums, B.Notes.GradientSums);
  EXPECT_EQ(A.Notes.Views, B.Notes.Views);
  EXPECT_EQ(A.Notes.Radii, B.Notes.Radii);
  EXPECT_EQ(A.Losses, B.Losses);
  EXPECT_EQ(A.Exposures, B.Exposures);
  EXPECT_EQ(A.Poses, B.Poses);
}

class TrainerOnDevice : public OnDevice {
protected:
  static Camera cameraAt(double Angle) {
    return aroundOrigin(Camera::ahead(24, 20, 30), Angle, 0);
  }

  /// A few blobs about the origin.
  static Scene blobs(uint32_t Count, unsigned Seed) {
    std::mt19937 Numbers(Seed);
    std::uniform_real_distribution<float> Unit(-1, 1);
    Scene S = Scene::sized(Count, 1);
    for (float &V : S.Means)
      V = 0.7F * Unit(Numbers);
    for (float &V : S.LogScales)
      V = -1.5F + 0.3F * Unit(Numbers);
    for (std::size_t I = 0; I < Count; ++I) {
      S.Quats[4 * I] = 1;
      S.OpacityLogits[I] = 1;
      for (std::size_t K = 0; K < 3; ++K)
        S.Sh[12 * I + K] = Unit(Numbers);
    }
    return S;
  }

  /// Pictures of \p S from around.
  static TrainingSet picturesOf(const Scene &S) {
    TrainingSet Set;
    for (int I = 0; I < 6; ++I) {
      const Camera C = cameraAt(0.25 * I);
      (I == 2 ? Set.HeldOut : Set.Training)
          .push_back({C, photographed(S, C), {}, {}});
    }
    return Set;
  }

  static void build(Launcher &Launch, const TrainingSet &Pictures = {},
                    const TrainSettings &Settings = {}) {
    Launch.beginStage(Stage::Blend);
    for (const ProgramSpec &P : Trainer::programs(Settings, Pictures))
      Launch.build(P);
  }
};

TEST_F(TrainerOnDevice, LearnsAndGoesOnFromACheckpointBitForBit) {
  TrainRun Run;
  // All of a run's events within few steps.
  Run.Settings.DensifyAfter = 5;
  Run.Settings.DensifyInterval = 6;
  Run.Settings.DensifyGradient = 5e-3;
  Run.Settings.ResetInterval = 17;
  Run.Settings.ShInterval = 8;
  Run.Settings.MostGaussians = 60;
  Run.Settings.PositionRate = 1e-3;
  Run.Settings.ColourRate = 0.1;
  Run.Extent = 3;
  Run.Seed = 5;
  const TrainingSet Set = picturesOf(blobs(12, 1));

  std::vector<Checkpoint> Unbroken;
  std::vector<double> Losses;
  {
    Launcher Launch(*Dev, "", {});
    build(Launch);
    ReferenceRenderer R(Launch);
    OneRank Alone;
    Trainer T(Launch, R, Set, Run, Alone);
    T.start(blobs(30, 2));
    const double Before = T.evaluate()[0];
    bool Grew = false;
    for (unsigned I = 1; I <= 24; ++I) {
      const uint32_t Count = T.gaussians();
      const StepReport Step = T.step();
      ASSERT_FALSE(Launch.failure())
          << Launch.failure()->What << Launch.buildLog();
      EXPECT_EQ(Step.Iteration, I);
      // What is due after a sixth one waits for the next: no run ends with it.
      EXPECT_EQ(Step.Density.has_value(), I > 6 && I % 6 == 1);
      if (I % 6 == 0)
        EXPECT_EQ(T.gaussians(), Count);
      Grew |= Step.Density && Step.Density->After > Step.Density->Before;
      Losses.push_back(Step.Loss.Value);
      if (I % 8 == 0)
        Unbroken.push_back(T.save());
      if (I == 16)
        EXPECT_GT(T.evaluate()[0], Before + 1) << "dB";
    }
    EXPECT_TRUE(Grew);
    EXPECT_LE(T.gaussians(), 60U);
  }
  const auto Mean = [&](std::ptrdiff_t From) {
    return std::accumulate(Losses.begin() + From, Losses.begin() + From + 5,
                           0.0) /
           5;
  };
  EXPECT_LT(Mean(11), 0.9 * Mean(0)); // before the reset of opacities
  // From each checkpoint, in a program of its own so to say.
  for (std::size_t From = 0; From + 1 < Unbroken.size(); ++From) {
    Launcher Launch(*Dev, "", {});
    build(Launch);
    ReferenceRenderer R(Launch);
    OneRank Alone;
    Trainer T(Launch, R, Set, Run, Alone);
    T.restore(Unbroken[From]);
    while (T.iteration() < 24)
      T.step();
    expectSame(T.save(), Unbroken.back());
  }
}

/// Work of equal rows, of one long row among short ones, and of fewer rows than
/// processes.
TEST(TileShare, RowsAreDividedByTheirWork) {
  using Rows = std::vector<uint32_t>;
  EXPECT_EQ(balancedRows({5, 5, 5, 5}, 1), (Rows{0, 4}));
  EXPECT_EQ(balancedRows({5, 5, 5, 5}, 2), (Rows{0, 2, 4}));
  EXPECT_EQ(balancedRows({1, 1, 1, 1, 1, 1, 1, 1}, 3), (Rows{0, 3, 5, 8}));
  EXPECT_EQ(balancedRows({9, 1, 1, 1}, 2), (Rows{0, 1, 4}));
  EXPECT_EQ(balancedRows({1, 1, 1, 9}, 2), (Rows{0, 3, 4}));
  const Rows Few = balancedRows({3, 3}, 5);
  ASSERT_EQ(Few.size(), 6U);
  EXPECT_EQ(Few.front(), 0U);
  EXPECT_EQ(Few.back(), 2U);
  EXPECT_TRUE(std::ranges::is_sorted(Few));
}

/// Processes divide seven rows of tiles and three of the loss; eight have more
/// than there are rows.
TEST_F(TrainerOnDevice, AnyNumberOfProcessesHasTheSameBits) {
  struct Case {
    unsigned Batch;
    Path Blending;
    double ExposureRate, PoseRate;
    std::vector<unsigned> Processes;
  };
  const Scene Shown = blobs(12, 1), Start = blobs(20, 2);
  TrainingSet Set;
  for (int I = 0; I < 5; ++I) {
    const Camera C = aroundOrigin(Camera::ahead(40, 100, 60), 0.25 * I, 0);
    Set.Training.push_back({C, photographed(Shown, C), {}, {}});
  }
  for (std::size_t Pixel = 0; Pixel < 4000; ++Pixel)
    Set.Training[1].Counts.push_back(Pixel % 40 < 25 ? 1 : 0);
  for (const Case &K : {Case{1, Path::Raster, 0, 0, {2, 8}},
                        Case{4, Path::Raster, 0.01, 1e-3, {2}},
                        Case{3, Path::Simt, 0, 0, {3}}}) {
    TrainRun Run;
    Run.Settings.DensifyAfter = 1;
    Run.Settings.DensifyInterval = 3;
    Run.Settings.DensifyGradient = 5e-3;
    Run.Settings.ShInterval = 2;
    Run.Settings.SizeInterval = 2;
    Run.Settings.PositionRate = 1e-3;
    Run.Settings.ExposureRate = K.ExposureRate;
    Run.Settings.PoseRate = K.PoseRate;
    Run.Extent = 3;
    Run.Batch = K.Batch;
    // By process; a run ends between two changes of density, notes being kept.
    const auto Train = [&](unsigned Processes) {
      std::vector<Checkpoint> Kept(Processes);
      ThreadRanks::Room Room(Processes);
      std::vector<std::thread> Threads;
      for (unsigned Own = 0; Own < Processes; ++Own)
        Threads.emplace_back([&, Own] {
          Launcher Launch(*Dev, "", {});
          build(Launch, Set, Run.Settings);
          BackwardOptions Backward;
          Backward.Poses = K.PoseRate != 0;
          DeviceRenderer R(Launch, Rules::Inria, K.Blending, Backward, {});
          ThreadRanks Together(Room, Own);
          Trainer T(Launch, R, Set, Run, Together);
          T.start(Start);
          for (int I = 0; I < 5; ++I)
            T.step(I == 3);
          Kept[Own] = T.save();
          EXPECT_FALSE(Launch.failure())
              << Launch.failure()->What << Launch.buildLog();
        });
      for (std::thread &T : Threads)
        T.join();
      return Kept;
    };
    const Checkpoint Alone = Train(1)[0];
    EXPECT_GT(Alone.gaussians(), Start.size());
    for (const unsigned Processes : K.Processes)
      for (const Checkpoint &C : Train(Processes))
        expectSame(C, Alone);
  }
}

/// Moves, draws and steps too: on two processes as on one, and after going on
/// from a checkpoint.
TEST_F(TrainerOnDevice, McmcHasTheSameBits) {
  TrainRun Run;
  Run.Settings = *readPreset("mcmc");
  Run.Settings.DensifyAfter = 1;
  Run.Settings.DensifyInterval = 3;
  Run.Settings.LeastOpacity = 0.45;
  Run.Settings.OpacityRate = 1;
  Run.Settings.GrowShare = 0.2;
  Run.Settings.ExposureRate = 0.01;
  Run.Extent = 3;
  Run.Batch = 2;
  const TrainingSet Set = picturesOf(blobs(12, 1));
  Scene Start = blobs(20, 2);
  for (std::size_t I = 0; I < 10; ++I)
    Start.OpacityLogits[I] = -0.2F;
  const auto Train = [&](unsigned Processes, const Checkpoint *From) {
    std::vector<Checkpoint> Kept(Processes), Half(Processes);
    ThreadRanks::Room Room(Processes);
    std::vector<std::thread> Threads;
    for (unsigned Own = 0; Own < Processes; ++Own)
      Threads.emplace_back([&, Own] {
        Launcher Launch(*Dev, "", {});
        build(Launch, Set, Run.Settings);
        ReferenceRenderer R(Launch);
        ThreadRanks Together(Room, Own);
        Trainer T(Launch, R, Set, Run, Together);
        if (From)
          T.restore(*From);
        else
          T.start(Start);
        while (T.iteration() < 8) {
          T.step();
          ASSERT_FALSE(Launch.failure())
              << Launch.failure()->What << Launch.buildLog();
          if (T.iteration() == 3)
            Half[Own] = T.save();
        }
        Kept[Own] = T.save();
      });
    for (std::thread &T : Threads)
      T.join();
    return std::pair(Kept, Half);
  };
  const auto [Kept, Half] = Train(1, nullptr);
  EXPECT_EQ(Kept[0].gaussians(), 28U);  // 20, 24, 28
  EXPECT_NE(Kept[0].Identities[0], 0U); // it moved
  EXPECT_EQ(Kept[0].Exposures.size(), 36 * Set.Training.size());
  expectSame(Train(1, Half.data()).first[0], Kept[0]);
  for (const Checkpoint &C : Train(2, nullptr).first)
    expectSame(C, Kept[0]);
}

/// Colours come from counters: a run that goes on has those of one that was not
/// interrupted, and held-out views keep the background that was asked for.
TEST_F(TrainerOnDevice, ARandomBackgroundIsTheSameAgain) {
  TrainRun Run;
  Run.Extent = 3;
  Run.RandomBackground = true;
  TrainingSet Set = picturesOf(blobs(12, 1));
  for (TrainView &V : Set.Training)
    V.Alpha.assign(V.Picture.pixels(), 128);
  Set.Training[1].Counts.assign(Set.Training[1].Picture.pixels(), 1);
  Set.Training[1].Counts[7] = 0;
  const Scene Start = blobs(20, 2);
  Launcher Launch(*Dev, "", {});
  build(Launch, Set);
  ReferenceRenderer R(Launch);
  OneRank Alone;
  Trainer Whole(Launch, R, Set, Run, Alone);
  Whole.start(Start);
  const double Before = Whole.evaluate()[0];
  std::optional<Checkpoint> Half;
  for (int I = 1; I <= 6; ++I) {
    Whole.step();
    if (I == 3)
      Half = Whole.save();
  }
  Trainer Again(Launch, R, Set, Run, Alone);
  Again.restore(*Half);
  for (int I = 4; I <= 6; ++I)
    Again.step();
  expectSame(Again.save(), Whole.save());
  Run.RandomBackground = false;
  R.setBackground({0, 0, 0});
  Trainer Plain(Launch, R, Set, Run, Alone);
  Plain.start(Start);
  EXPECT_EQ(Plain.evaluate()[0], Before);
  Plain.step();
  EXPECT_NE(Plain.losses()[0], Whole.losses()[0]);
  EXPECT_FALSE(Launch.failure()) << Launch.failure()->What;
}

/// An iteration of two views is the mean of their gradients and losses.
TEST_F(TrainerOnDevice, ABatchIsTheMeanOfItsViews) {
  TrainRun Run;
  Run.Extent = 3;
  const TrainingSet Set = picturesOf(blobs(12, 1));
  const Scene Start = blobs(20, 2);
  const auto FirstLosses = [&](unsigned Batch, unsigned Steps) {
    Run.Batch = Batch;
    Run.Settings.PositionRate = Run.Settings.ColourRate =
        Run.Settings.OpacityRate = Run.Settings.ScaleRate =
            Run.Settings.RotationRate = 1e-12; // the scene stays as it is
    Launcher Launch(*Dev, "", {});
    build(Launch);
    ReferenceRenderer R(Launch);
    OneRank Alone;
    Trainer T(Launch, R, Set, Run, Alone);
    T.start(Start);
    for (unsigned I = 0; I < Steps; ++I)
      T.step();
    EXPECT_FALSE(Launch.failure())
        << Launch.failure()->What << Launch.buildLog();
    return std::pair(T.losses(), T.save());
  };
  const auto [Each, AfterBoth] = FirstLosses(1, 2);
  const auto [Both, Once] = FirstLosses(2, 1);
  ASSERT_EQ(Each.size(), 2U);
  ASSERT_EQ(Both.size(), 1U);
  EXPECT_NEAR(Both[0], (Each[0] + Each[1]) / 2, 1e-6);
  // Adam's first moment after one step is a tenth of the mean gradient, after
  // two 0.09 of the first and 0.1 of the second.
  double Off = 0, Whole = 0;
  Checkpoint Single = FirstLosses(1, 1).second;
  for (std::size_t I = 0; I < Once.FirstGeometry.size(); ++I) {
    const double A = Single.FirstGeometry[I] / 0.1;
    const double B = (AfterBoth.FirstGeometry[I] - 0.09 * A) / 0.1;
    Off += std::pow(Once.FirstGeometry[I] - 0.1 * (A + B) / 2, 2);
    Whole += std::pow(Once.FirstGeometry[I], 2);
  }
  EXPECT_LT(std::sqrt(Off / Whole), 1e-4);
}

} // namespace
} // namespace vorion::splat
