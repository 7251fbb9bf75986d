#include "render/Renderer.h"

#include "effects/Registry.h"
#include "kernels/activate_scene.cl.h"
#include "kernels/resolve.cl.h"
#include "render/Pipeline.h"

#include <array>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace vorion::splat {

namespace {

SortedPairs readPairs(Launcher &Launch, const Frame &F) {
  SortedPairs P;
  P.Gaussians.resize(F.Pairs);
  std::vector<uint32_t> Bits(F.drawn());
  std::vector<std::array<uint32_t, 2>> Ranges(F.tiles());
  Launch.read("tile ranges", Ranges.data(), F.Ranges, 8 * Ranges.size());
  for (uint32_t Tile = 0; Tile < Ranges.size(); ++Tile)
    P.Tiles.insert(P.Tiles.end(), Ranges[Tile][1] - Ranges[Tile][0], Tile);
  Launch.read("Gaussians of pairs", P.Gaussians.data(), F.List,
              4 * uint64_t{F.Pairs});
  Launch.read("depths", Bits.data(), F.Depths.Keys, 4 * uint64_t{F.drawn()});
  P.DepthBits.reserve(F.Pairs);
  for (uint32_t &G : P.Gaussians) {
    G &= ~SPANS_TILES;
    P.DepthBits.push_back(Bits[G]);
    G %= F.stride();
  }
  return P;
}

/// Of the pixels that \c Pipeline::drawDepths left.
DepthMap readDepths(Launcher &Launch, const Frame &F,
                    const cl::Buffer &Pixels) {
  const Image Drawn = readPicture(Launch, F, Pixels, /*Resolved=*/false);
  DepthMap D{Drawn.Width, Drawn.Height, {}, Drawn.Alpha};
  D.Depth.reserve(Drawn.pixels());
  for (std::size_t P = 0; P < Drawn.pixels(); ++P)
    D.Depth.push_back(Drawn.Render[3 * P]);
  return D;
}

/// Behind the Gaussians of \p D.
void addSurface(DepthMap &D, const VisibleMesh &V) {
  for (std::size_t P = 0; P < V.Triangles.size(); ++P) {
    if (V.Triangles[P] < 0)
      continue;
    D.Depth[P] += (1 - D.Alpha[P]) * V.Depth[P];
    D.Alpha[P] = 1;
  }
}

} // namespace

cl::Buffer resolve(Launcher &Launch, const Frame &F,
                   const std::array<float, 3> &Background) {
  cl::Buffer Picture = Launch.allocate("picture", 16 * uint64_t{F.pixels()});
  Launch.run(Launch.device().groupsAtOnce() * Lanes, Lanes,
             kernels::resolve::resolve{.pixels = F.Pixels,
                                       .picture = Picture,
                                       .values = 4 * F.pixels(),
                                       .red = Background[0],
                                       .green = Background[1],
                                       .blue = Background[2],
                                       .effects = F.View.effects});
  return Picture;
}

/// A picture of \p F that is still 0.
static Image blank(const Frame &F) {
  Image I;
  I.Width = static_cast<int>(F.View.size[0]);
  I.Height = static_cast<int>(F.View.size[1]);
  const std::size_t Pixels = F.pixels();
  I.Render.resize(3 * Pixels);
  I.Alpha.resize(Pixels);
  return I;
}

/// The pixels of \p I from those of the device.
static void fill(Image &I, bool Resolved, std::span<const float> Rgba) {
  for (std::size_t P = 0; P < I.Alpha.size(); ++P) {
    for (std::size_t K = 0; K < 3; ++K)
      I.Render[3 * P + K] = Rgba[4 * P + K];
    I.Alpha[P] = Resolved ? Rgba[4 * P + 3] : 1 - Rgba[4 * P + 3];
  }
}

Image readPicture(Launcher &Launch, const Frame &F, const cl::Buffer &Picture,
                  bool Resolved) {
  Image I = blank(F);
  Launch.readInPlace("picture", Picture, 4 * std::size_t{F.pixels()},
                     [&](auto Rgba) { fill(I, Resolved, Rgba); });
  return I;
}

Expected<Success> build(Launcher &Launch, const RenderPlan &Plan,
                        const Scene &S) {
  if (S.size() > std::numeric_limits<int32_t>::max())
    return Error{"", "more than 2^31 - 1 Gaussians, whose indices have 31 bits",
                 ExitCode::LimitReached};
  Launch.beginStage(Stage::Build);
  for (const ProgramSpec &Program : Plan.Programs)
    Launch.build(Program);
  return Success{};
}

namespace {

/// A picture on its way to the host.
struct Arriving {
  RenderResult Result; ///< with a blank picture
  bool Resolved = false;
  PendingRead Pixels;
};

/// From blended pixels to the host, until finish().
Arriving startFinish(Launcher &Launch, const RenderPlan &Plan, const Frame &F,
                     const RenderOptions &Options) {
  // Without a background the pixels are the picture, but for 1 - T.
  // A mirror's colours are in the pixels.
  const bool HasMesh =
      Plan.Effects.done(effects::Mesh) && Options.Kind != RendererKind::Trace;
  Arriving A{.Result = {},
             .Resolved = HasMesh || Plan.Effects.done(effects::Background),
             .Pixels = {}};
  cl::Buffer Picture = F.Pixels;
  if (A.Resolved) {
    Launch.beginStage(Stage::Resolve);
    Picture = HasMesh ? resolveMesh(Launch, F, Options)
                      : resolve(Launch, F, Options.Background);
  }
  Launch.beginStage(Stage::ReadBack);
  A.Result.Visible = F.seen();
  A.Result.Pairs = F.Pairs;
  A.Result.Culled = F.Culled;
  if (Options.Kind == RendererKind::Trace)
    A.Result.Rays = readRayWork(Launch, F);
  A.Result.Picture = blank(F);
  A.Pixels = Launch.startReading("picture", Picture, 4 * uint64_t{F.pixels()});
  return A;
}

RenderResult finish(Launcher &Launch, Arriving A) {
  Launch.finishReading(
      A.Pixels, [&](auto Rgba) { fill(A.Result.Picture, A.Resolved, Rgba); });
  return std::move(A.Result);
}

RenderResult finish(Launcher &Launch, const RenderPlan &Plan, const Frame &F,
                    const RenderOptions &Options) {
  return finish(Launch, startFinish(Launch, Plan, F, Options));
}

/// Renders the pictures of a sequence, and knows which stage is whose.
class Sequence {
public:
  Sequence(Launcher &Launch, const RenderPlan &P, const GaussianBuffers &Input,
           const std::vector<Camera> &Views, const RenderOptions &O)
      : Launch(Launch), Plan(P), Gaussians(Input), Cameras(Views), Options(O),
        FirstStage(Launch.stages()) {
    Result.Frames.resize(Views.size());
  }

  /// What no camera changes, which is accounted to the first picture.
  void activate() {
    splat::activate(Launch, Plan, Gaussians);
    own(0);
  }

  /// One after the other.
  void apart() {
    Pipeline P(Launch, Options, Plan.Effects);
    for (std::size_t Frame = 0; Frame < Cameras.size(); ++Frame) {
      P.draw(Gaussians, Cameras[Frame]);
      take(Frame, P);
    }
  }

  /// While a picture is blended the next one is prepared. The rasterizers get
  /// that as soon as they are done, before the first one is resolved. With DMA
  /// engines the first one goes to the host while the one after it is prepared.
  void overlapped() {
    Pipeline Both[2] = {{Launch, Options, Plan.Effects},
                        {Launch, Options, Plan.Effects}};
    for (std::size_t Frame = 0; Frame < Cameras.size(); ++Frame) {
      Pipeline &P = Both[Frame % 2];
      P.prepare(Gaussians, Cameras[Frame]);
      if (Launch.failure())
        return;
      P.prepareRasterizers();
      own(Frame);
      if (Frame != 0)
        wait(Frame - 1, Both[(Frame - 1) % 2]);
      Launch.beginStage(Stage::StartBlending);
      P.startBlending();
      own(Frame);
      if (Frame != 0)
        end(Frame - 1, Both[(Frame - 1) % 2]);
    }
    const std::size_t Last = Cameras.size() - 1;
    wait(Last, Both[Last % 2]);
    end(Last, Both[Last % 2]);
    arrived();
  }

  /// Needs that nothing failed.
  SequenceResult result() {
    const std::vector<StageReport> All = Launch.takeStages();
    for (std::size_t N = 0; N < Result.FrameOf.size(); ++N) {
      Result.Stages.push_back(All[FirstStage + N]);
      Result.Frames[Result.FrameOf[N]].Stages.push_back(All[FirstStage + N]);
    }
    return std::move(Result);
  }

private:
  /// What has been begun since the last call is \p Frame's.
  void own(std::size_t Frame) {
    Result.FrameOf.resize(Launch.stages() - FirstStage, Frame);
  }
  void wait(std::size_t Frame, Pipeline &P) {
    Launch.beginStage(Stage::WaitForBlending);
    P.waitForBlending();
    own(Frame);
  }
  void end(std::size_t Frame, Pipeline &P) {
    Launch.beginStage(Stage::EndBlending);
    P.endBlending();
    arrived();
    if (!Launch.device().copiesOverlap())
      return take(Frame, P);
    if (Launch.failure())
      return;
    Coming.emplace(Frame, startFinish(Launch, Plan, P.frame(), Options));
    own(Frame);
  }
  /// Waits for the picture that is on its way, if there is one.
  void arrived() {
    if (!Coming || Launch.failure())
      return;
    auto &[Frame, Picture] = *Coming;
    Result.Frames[Frame] = finish(Launch, std::move(Picture));
    Result.Frames[Frame].DeviceBytes = Launch.mostBytes();
    Coming.reset();
  }
  void take(std::size_t Frame, const Pipeline &P) {
    if (Launch.failure())
      return;
    Result.Frames[Frame] = finish(Launch, Plan, P.frame(), Options);
    Result.Frames[Frame].DeviceBytes = Launch.mostBytes();
    own(Frame);
  }

  Launcher &Launch;
  const RenderPlan &Plan;
  const GaussianBuffers &Gaussians;
  const std::vector<Camera> &Cameras;
  const RenderOptions &Options;
  std::size_t FirstStage;
  SequenceResult Result;
  std::optional<std::pair<std::size_t, Arriving>> Coming; ///< and its number
};

} // namespace

void activate(Launcher &Launch, const RenderPlan &Plan,
              const GaussianBuffers &Gaussians) {
  if (!Plan.Effects.done(effects::ActivatedScene))
    return;
  Launch.beginStage(Stage::Activate);
  Launch.run(itemsFor(Gaussians.Count), GroupSize,
             kernels::activate_scene::activate_scene{.all = Gaussians.Geometry,
                                                     .count = Gaussians.Count});
}

Expected<RenderResult> draw(Launcher &Launch, const RenderPlan &Plan,
                            const GaussianBuffers &Gaussians, const Camera &C,
                            const RenderOptions &Options, bool KeepPairs) {
  Pipeline P(Launch, Options, Plan.Effects);
  P.draw(Gaussians, C);
  if (Launch.failure())
    return *Launch.failure();
  RenderResult R = finish(Launch, Plan, P.frame(), Options);
  if (KeepPairs)
    R.Sorted = readPairs(Launch, P.frame());
  if (Options.KeepVisible)
    R.MeshShown = readVisible(Launch, P.frame(), Options);
  if (Plan.Effects.done(effects::PixelLists))
    R.Lists = readLists(Launch, P.frame(), Options);
  if (Plan.Effects.done(effects::Normals)) {
    Launch.beginStage(Stage::Normals);
    R.Normals =
        readPicture(Launch, P.frame(), P.drawNormals(), /*Resolved=*/false);
  }
  if (Plan.Effects.done(effects::Depth)) {
    Launch.beginStage(Stage::Depth);
    R.Depths = readDepths(Launch, P.frame(), P.drawDepths());
    if (Plan.Effects.done(effects::Mesh))
      addSurface(*R.Depths, readVisible(Launch, P.frame(), Options));
  }
  if (Launch.failure())
    return *Launch.failure();
  R.DeviceBytes = Launch.mostBytes();
  R.Stages = Launch.takeStages();
  return R;
}

/// \p S, and the mesh if there is one.
static GaussianBuffers upload(Launcher &Launch, const RenderPlan &Plan,
                              SceneSource S, const RenderOptions &Options) {
  GaussianBuffers B = uploadGaussians(Launch, S, Plan.Effects);
  if (Plan.Effects.done(effects::Mesh))
    B.Surface =
        uploadMesh(Launch, *Options.Surface, Plan.Effects, Options.Kind);
  return B;
}

Expected<RenderResult> render(Launcher &Launch, const RenderPlan &Plan,
                              SceneSource S, const Camera &C,
                              const RenderOptions &Options, bool KeepPairs) {
  if (auto Built = build(Launch, Plan, S.scene()); !Built)
    return Built.error();
  Launch.beginStage(Stage::Upload);
  return draw(Launch, Plan, upload(Launch, Plan, S, Options), C, Options,
              KeepPairs);
}

Expected<SequenceResult> renderSequence(Launcher &Launch,
                                        const RenderPlan &Plan, SceneSource S,
                                        const std::vector<Camera> &Cameras,
                                        const RenderOptions &Options,
                                        bool Overlap) {
  if (auto Built = build(Launch, Plan, S.scene()); !Built)
    return Built.error();
  Launch.beginStage(Stage::Upload);
  const GaussianBuffers Gaussians = upload(Launch, Plan, S, Options);
  Sequence Views(Launch, Plan, Gaussians, Cameras, Options);
  Views.activate();
  if (Overlap)
    Views.overlapped();
  else
    Views.apart();
  if (Launch.failure())
    return *Launch.failure();
  return Views.result();
}

} // namespace vorion::splat
