#include "render/Renderer.h"

#include "effects/Registry.h"
#include "render/Pipeline.h"

#include <fmt/format.h>
#include <limits>

namespace vorion::splat {

namespace {

SortedPairs readPairs(Launcher &L, const Frame &F) {
  SortedPairs P;
  P.Tiles.resize(F.Pairs);
  P.Gaussians.resize(F.Pairs);
  std::vector<uint32_t> Bits(F.Gaussians.Count);
  L.read("tiles of pairs", P.Tiles.data(), F.ByTile.Keys,
         4 * uint64_t{F.Pairs});
  L.read("Gaussians of pairs", P.Gaussians.data(), F.List,
         4 * uint64_t{F.Pairs});
  L.read("depths", Bits.data(), F.Depths.Keys, 4 * uint64_t{F.Gaussians.Count});
  P.DepthBits.reserve(F.Pairs);
  for (uint32_t &G : P.Gaussians) {
    G &= ~SPANS_TILES;
    P.DepthBits.push_back(Bits[G]);
  }
  return P;
}

/// Of the pixels that \c Pipeline::drawDepths left.
DepthMap readDepths(Launcher &L, const Frame &F, const cl::Buffer &Pixels) {
  const Image Drawn = readPicture(L, F, Pixels, /*Resolved=*/false);
  DepthMap D{Drawn.Width, Drawn.Height, {}, Drawn.Alpha};
  D.Depth.reserve(Drawn.pixels());
  for (std::size_t P = 0; P < Drawn.pixels(); ++P)
    D.Depth.push_back(Drawn.Render[3 * P]);
  return D;
}

} // namespace

cl::Buffer resolve(Launcher &L, const Frame &F,
                   const std::array<float, 3> &Background) {
  cl::Buffer Picture = L.allocate("picture", 16 * uint64_t{F.pixels()});
  L.run(ResolveProgram, "resolve", L.device().computeUnits() * Lanes, Lanes,
        F.Pixels, Picture, 4 * F.pixels(), Background[0], Background[1],
        Background[2], F.View.effects);
  return Picture;
}

Image readPicture(Launcher &L, const Frame &F, const cl::Buffer &Picture,
                  bool Resolved) {
  Image I;
  I.Width = static_cast<int>(F.View.size[0]);
  I.Height = static_cast<int>(F.View.size[1]);
  std::vector<float> Rgba(4 * std::size_t{F.pixels()});
  L.read("picture", Rgba.data(), Picture, 4 * Rgba.size());
  I.Render.resize(3 * std::size_t{F.pixels()});
  I.Alpha.resize(F.pixels());
  for (std::size_t P = 0; P < F.pixels(); ++P) {
    for (std::size_t K = 0; K < 3; ++K)
      I.Render[3 * P + K] = Rgba[4 * P + K];
    I.Alpha[P] = Resolved ? Rgba[4 * P + 3] : 1 - Rgba[4 * P + 3];
  }
  return I;
}

namespace {

/// What can be said to be wrong before the device is asked; builds the
/// programs.
Expected<Success> begin(Launcher &L, const RenderPlan &Plan, const Scene &S) {
  if (S.size() > std::numeric_limits<int32_t>::max())
    return Error{"", "more than 2^31 - 1 Gaussians, whose numbers have 31 bits",
                 ExitCode::LimitReached};
  L.beginStage(Stage::Build);
  for (const ProgramSpec &Program : Plan.Programs)
    L.build(Program);
  L.beginStage(Stage::Upload);
  return Success{};
}

/// From blended pixels to the host.
RenderResult finish(Launcher &L, const RenderPlan &Plan, const Frame &F,
                    const RenderOptions &Options) {
  // Without a background the pixels are the picture, but for 1 - T.
  const bool Resolved = Plan.Effects.done(effects::Background);
  cl::Buffer Picture = F.Pixels;
  if (Resolved) {
    L.beginStage(Stage::Resolve);
    Picture = resolve(L, F, Options.Background);
  }
  L.beginStage(Stage::ReadBack);
  RenderResult R;
  R.Visible = F.Visible;
  R.Pairs = F.Pairs;
  R.Culled = F.Culled;
  R.Picture = readPicture(L, F, Picture, Resolved);
  return R;
}

/// Renders the pictures of a sequence, and knows which stage is whose.
class Sequence {
public:
  Sequence(Launcher &Launch, const RenderPlan &P, const GaussianBuffers &Input,
           const std::vector<Camera> &Views, const RenderOptions &O)
      : L(Launch), Plan(P), Gaussians(Input), Cameras(Views), Options(O),
        FirstStage(L.stages()) {
    R.Frames.resize(Views.size());
  }

  /// One after the other.
  void apart() {
    Pipeline P(L, Options, Plan.Effects);
    for (std::size_t Frame = 0; Frame < Cameras.size(); ++Frame) {
      P.draw(Gaussians, Cameras[Frame]);
      take(Frame, P);
    }
  }

  /// While a picture is blended the next one is prepared. The rasterizers get
  /// that as soon as they are done, before the first one is resolved.
  void overlapped() {
    Pipeline Both[2] = {{L, Options, Plan.Effects}, {L, Options, Plan.Effects}};
    for (std::size_t Frame = 0; Frame < Cameras.size(); ++Frame) {
      Pipeline &P = Both[Frame % 2];
      P.prepare(Gaussians, Cameras[Frame]);
      if (L.failure())
        return;
      P.prepareRasterizers();
      own(Frame);
      if (Frame != 0)
        wait(Frame - 1, Both[(Frame - 1) % 2]);
      L.beginStage(Stage::StartBlending);
      P.startBlending();
      own(Frame);
      if (Frame != 0)
        end(Frame - 1, Both[(Frame - 1) % 2]);
    }
    const std::size_t Last = Cameras.size() - 1;
    wait(Last, Both[Last % 2]);
    end(Last, Both[Last % 2]);
  }

  /// Needs that nothing failed.
  SequenceResult result() {
    const std::vector<StageReport> All = L.takeStages();
    for (std::size_t N = 0; N < R.FrameOf.size(); ++N) {
      R.Stages.push_back(All[FirstStage + N]);
      R.Frames[R.FrameOf[N]].Stages.push_back(All[FirstStage + N]);
    }
    return std::move(R);
  }

private:
  /// What has been begun since the last call is \p Frame's.
  void own(std::size_t Frame) {
    R.FrameOf.resize(L.stages() - FirstStage, Frame);
  }
  void wait(std::size_t Frame, Pipeline &P) {
    L.beginStage(Stage::WaitForBlending);
    P.waitForBlending();
    own(Frame);
  }
  void end(std::size_t Frame, Pipeline &P) {
    L.beginStage(Stage::EndBlending);
    P.endBlending();
    take(Frame, P);
  }
  void take(std::size_t Frame, const Pipeline &P) {
    if (L.failure())
      return;
    R.Frames[Frame] = finish(L, Plan, P.frame(), Options);
    R.Frames[Frame].DeviceBytes = L.mostBytes();
    own(Frame);
  }

  Launcher &L;
  const RenderPlan &Plan;
  const GaussianBuffers &Gaussians;
  const std::vector<Camera> &Cameras;
  const RenderOptions &Options;
  std::size_t FirstStage;
  SequenceResult R;
};

} // namespace

Expected<RenderResult> render(Launcher &L, const RenderPlan &Plan,
                              const Scene &S, const Camera &C,
                              const RenderOptions &Options, bool KeepPairs) {
  if (auto Begun = begin(L, Plan, S); !Begun)
    return Begun.error();
  const GaussianBuffers Gaussians = uploadGaussians(L, S, Plan.Effects);
  Pipeline P(L, Options, Plan.Effects);
  P.draw(Gaussians, C);
  if (L.failure())
    return *L.failure();
  RenderResult R = finish(L, Plan, P.frame(), Options);
  if (KeepPairs)
    R.Sorted = readPairs(L, P.frame());
  if (Plan.Effects.done(effects::Depth)) {
    L.beginStage(Stage::Depth);
    R.Depths = readDepths(L, P.frame(), P.drawDepths());
  }
  if (L.failure())
    return *L.failure();
  R.DeviceBytes = L.mostBytes();
  R.Stages = L.takeStages();
  return R;
}

Expected<SequenceResult> renderSequence(Launcher &L, const RenderPlan &Plan,
                                        const Scene &S,
                                        const std::vector<Camera> &Cameras,
                                        const RenderOptions &Options,
                                        bool Overlap) {
  if (auto Begun = begin(L, Plan, S); !Begun)
    return Begun.error();
  const GaussianBuffers Gaussians = uploadGaussians(L, S, Plan.Effects);
  Sequence Views(L, Plan, Gaussians, Cameras, Options);
  if (Overlap)
    Views.overlapped();
  else
    Views.apart();
  if (L.failure())
    return *L.failure();
  return Views.result();
}

} // namespace vorion::splat
