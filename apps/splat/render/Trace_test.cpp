// Traced rays on the device: boxes beside their definition, the tree beside a
// search of all Gaussians, and what has one place on a ray.

#include "device/OnDevice.h"
#include "kernels/trace.cl.h"
#include "render/Pipeline.h"
#include "render/Plan.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace vorion::splat {
namespace {

class TracedRays : public OnDevice {
protected:
  TracedRays() {
    Options.Kind = RendererKind::Trace;
    Options.Blending = Path::Simt;
    Options.Dilation = 0;
  }

  /// In front of the camera and around it, of all shapes, discs among them.
  Scene scene(std::size_t Count) {
    const auto In = [&](double Low, double High) {
      return static_cast<float>(
          std::uniform_real_distribution(Low, High)(Random));
    };
    Scene S = Scene::sized(Count, 0);
    for (std::size_t I = 0; I < Count; ++I) {
      for (std::size_t K = 0; K < 3; ++K) {
        S.Means[3 * I + K] = In(-2, 2);
        S.LogScales[3 * I + K] = In(-5, -1);
        S.Sh[3 * I + K] = In(-1, 1);
      }
      if (I % 7 == 0)
        S.LogScales[3 * I + 1] = -std::numeric_limits<float>::infinity();
      for (std::size_t K = 0; K < 4; ++K)
        S.Quats[4 * I + K] = In(-1, 1);
      S.OpacityLogits[I] = In(-7, 3);
    }
    return S;
  }

  Camera camera() const {
    Camera C = Camera::ahead(21, 14, 18);
    C.Position = {0.3, -0.2, -3};
    return C;
  }

  /// Draws \p S, and gives the frame to \p Look.
  template <typename Function> void draw(const Scene &S, Function Look) {
    const RenderPlan Plan = planRender(S.ShDegree, Options);
    Launcher L(*Dev, "", {});
    L.beginStage(Stage::Build);
    for (const ProgramSpec &P : Plan.Programs)
      L.build(P);
    L.beginStage(Stage::Upload);
    const GaussianBuffers B = uploadGaussians(L, S, Plan.Effects);
    Pipeline P(L, Options, Plan.Effects);
    P.draw(B, camera());
    ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
    Look(L, P.frame());
    ASSERT_FALSE(L.failure()) << L.failure()->What;
  }

  RenderOptions Options;
};

TEST_F(TracedRays, BoxesHoldWhatReachesTheLeastAlpha) {
  const Scene S = scene(300);
  draw(S, [&](Launcher &L, const Frame &F) {
    const auto Keys = download(L, F.Depths.Keys, S.size());
    const auto Boxes = download<float>(L, F.Traced.Boxes, BOX_WORDS * S.size());
    std::size_t Faint = 0;
    for (std::size_t I = 0; I < S.size(); ++I) {
      const double Opacity = 1 / (1 + std::exp(-S.OpacityLogits[I]));
      ASSERT_EQ(Keys[I] >= CULLED, 255 * Opacity < 1) << I;
      Faint += Keys[I] >= CULLED;
      if (Keys[I] >= CULLED)
        continue;
      const double Reach = std::sqrt(2 * std::log(255 * Opacity));
      const auto *Q = &S.Quats[4 * I];
      const glm::dmat3 Axes =
          glm::mat3_cast(glm::normalize(glm::dquat(Q[0], Q[1], Q[2], Q[3])));
      for (std::size_t K = 0; K < 3; ++K) {
        double Square = 0;
        for (std::size_t A = 0; A < 3; ++A) {
          const double Scale = std::exp(double(S.LogScales[3 * I + A]));
          const double Along =
              Scale * Axes[static_cast<int>(A)][static_cast<int>(K)];
          Square += Along * Along;
        }
        const double Half = Reach * std::sqrt(Square);
        const double Mean = S.Means[3 * I + K] - camera().Position[K];
        const double Low = Boxes[BOX_WORDS * I + BOX_LOW + K];
        const double High = Boxes[BOX_WORDS * I + BOX_HIGH + K];
        EXPECT_LE(Low, Mean - Half) << I;
        EXPECT_GE(High, Mean + Half) << I;
        EXPECT_NEAR(Low, Mean - Half, 3e-5 * (1 + Half)) << I;
        EXPECT_NEAR(High, Mean + Half, 3e-5 * (1 + Half)) << I;
      }
    }
    EXPECT_GT(Faint, 10U);
    EXPECT_EQ(F.Culled[CULL_FAINT], Faint);
    EXPECT_EQ(F.Visible, S.size() - Faint);
  });
}

// With boxes around everything each pass of a ray looks at every Gaussian.
TEST_F(TracedRays, TheTreeLosesNoHit) {
  Options.RayWindow = 4;
  for (const auto &[Count, Restart] : {std::pair{0U, RayRestart::Checkpoint},
                                       {1U, RayRestart::Checkpoint},
                                       {4U, RayRestart::Root},
                                       {5U, RayRestart::Checkpoint},
                                       {17U, RayRestart::Checkpoint},
                                       {300U, RayRestart::Root},
                                       {300U, RayRestart::Checkpoint}}) {
    Options.Restart = Restart;
    draw(scene(Count), [&](Launcher &L, const Frame &F) {
      const TraceFrame &T = F.Traced;
      const auto Nodes =
          download<float>(L, T.Nodes,
                          BOX_WORDS * (T.Tree.leaves - T.Tree.gap +
                                       (T.Tree.count + 3) / 4 * 4));
      // But where there is nobody.
      constexpr float Most = std::numeric_limits<float>::max();
      std::vector<float> Everywhere(Nodes.size());
      for (std::size_t I = 0; I < Nodes.size(); ++I)
        Everywhere[I] =
            I % BOX_WORDS < BOX_HIGH && Nodes[I] != Most ? -Most : Most;
      const std::size_t Rays = F.pixels();
      const cl::Buffer Pixels = L.allocate("pixels", 16 * Rays),
                       Work = L.allocate("work", sizeof(splat_ray_work) * Rays);
      L.run(cl::NDRange(6 * Lanes, 4), cl::NDRange(Lanes, 1),
            kernels::trace::trace{.rays = T.Rays,
                                  .nodes = upload(L, Everywhere),
                                  .order = F.Order,
                                  .leaves = T.Leaves,
                                  .shapes = T.Shapes,
                                  .colors = T.Colors,
                                  .pixels = Pixels,
                                  .work = Work,
                                  .tree = T.Tree,
                                  .width = F.View.size[0],
                                  .height = F.View.size[1],
                                  .cutoff = Options.Cutoff,
                                  .effects = F.View.effects,
                                  .onward = cl_uint{0}});
      EXPECT_EQ(download(L, F.Pixels, 4 * Rays), download(L, Pixels, 4 * Rays))
          << Count;
      const auto Own = download<splat_ray_work>(L, T.Work, Rays),
                 All = download<splat_ray_work>(L, Work, Rays);
      uint64_t Fewer = 0, Blended = 0, Restarts = 0;
      for (std::size_t I = 0; I < Rays; ++I) {
        EXPECT_EQ(Own[I].blended, All[I].blended);
        // A box that is left for later may have nothing.
        EXPECT_GE(Own[I].passes, All[I].passes);
        EXPECT_LE(Own[I].passes, All[I].passes + 1);
        Fewer += All[I].evaluated - Own[I].evaluated;
        Blended += Own[I].blended;
        Restarts += Own[I].passes > 1;
      }
      if (Count < 300)
        return;
      EXPECT_GT(Blended, Rays);
      EXPECT_GT(Restarts, 0U);
      EXPECT_GT(Fewer, 10 * Blended);
    });
  }
}

// More of them than a pass keeps, in an order that Morton codes do not have.
TEST_F(TracedRays, AtOnePlaceTheOrderIsThatOfNumbers) {
  constexpr std::size_t Count = 40;
  Scene S = Scene::sized(Count, 0);
  for (std::size_t I = 0; I < Count; ++I) {
    for (std::size_t K = 0; K < 3; ++K) {
      S.Means[3 * I + K] = K == 2 ? 1 : 0;
      S.LogScales[3 * I + K] = 1;
    }
    S.Quats[4 * I] = 1;
    S.OpacityLogits[I] = -3;
    S.Sh[3 * I] = I % 2 == 0 ? 1.0F : -1.0F;
  }
  for (const unsigned Window : {4U, 16U}) {
    Options.RayWindow = Window;
    draw(S, [&](Launcher &L, const Frame &F) {
      const auto Pixels = download<float>(L, F.Pixels, 4 * F.pixels());
      const auto Work = download<splat_ray_work>(L, F.Traced.Work, F.pixels());
      // Nearly through the centre.
      const std::size_t At = 7 * F.View.size[0] + 9;
      EXPECT_EQ(Work[At].blended, Count);
      EXPECT_EQ(Work[At].passes, Count / Window + 1);
      // All have the same alpha, so colours alternate.
      const double T = Pixels[4 * At + 3];
      const double Alpha = 1 - std::pow(T, 1.0 / Count);
      double Red = 0, Through = 1;
      for (std::size_t I = 0; I < Count; ++I, Through *= 1 - Alpha)
        Red += Alpha * Through * (0.5 + (I % 2 == 0 ? ShC0 : -ShC0));
      EXPECT_LT(T, 0.5);
      EXPECT_NEAR(Pixels[4 * At], Red, 1e-5);
    });
  }
}

} // namespace
} // namespace vorion::splat
