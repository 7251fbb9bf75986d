// splat-reference: renders one view of a scene with the reference.

#include "Convert.h"
#include "Gradients.h"
#include "Tool.h"
#include "io/Npz.h"
#include "mesh/Mesh.h"
#include "reference/AlongRays.h"
#include "reference/PixelOrder.h"
#include "scene/Activation.h"
#include "scene/SceneFile.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::test {
namespace {

struct Arguments {
  std::string Scene, Cameras, View, Output, Json, Pairs;
  std::string Rules = "inria", Support = "exact", Precision = "f64";
  std::string Projection = "jacobian", Order = "depth";
  std::string Mesh, Visible;
  std::string Upstream, Gradients;
  std::vector<double> Light; ///< empty: none
  std::vector<float> Background{0, 0, 0};
  bool AlongRays = false;
  splat::ReadOptions Read;
  reference::Options Options;
};

reference::Options optionsOf(const Arguments &A) {
  reference::Options O = A.Options;
  O.Rule =
      A.Rules == "inria" ? reference::Rules::Inria : reference::Rules::Gsplat;
  O.Reach = supportNamed(A.Support);
  O.Through = A.Projection == "jacobian" ? reference::Spread::Jacobian
                                         : reference::Spread::Unscented;
  std::copy_n(A.Background.begin(), 3, O.Background.begin());
  return O;
}

/// The layers of \p Seen, which are planes of pixels as \p To has them.
Expected<Success> readLayers(const std::string &Where, splat::Npz &Seen,
                             const reference::Mesh &M,
                             reference::MeshView &To) {
  const std::vector<double> Depths = Seen["layer_depth"].toDoubles();
  const std::vector<int64_t> Triangles = Seen["layer_triangle"].toIntegers();
  const std::size_t Pixels = To.Depths.size();
  if (Depths.size() % Pixels != 0 || Triangles.size() != Depths.size() ||
      std::ranges::any_of(Triangles, [&](int64_t N) {
        return N >= static_cast<int64_t>(M.triangles());
      }))
    return Error{Where, "no planes of layers, expected what splat render "
                        "--visible wrote for this view and mesh"};
  To.Layers.resize(Pixels);
  for (std::size_t I = 0; I < Depths.size(); ++I)
    if (Triangles[I] >= 0)
      To.Layers[I % Pixels].push_back({Depths[I], Triangles[I]});
  return Success{};
}

/// The triangles that \p Visible names in the view of \p C.
Expected<reference::MeshView> readView(const std::string &Visible,
                                       const reference::Mesh &M,
                                       const reference::Camera<double> &C) {
  auto Seen = splat::readNpz(Visible);
  if (!Seen)
    return Seen.error();
  const splat::NpyArray Depths = (*Seen)["depth"],
                        Triangles = (*Seen)["triangle"];
  const std::vector<std::size_t> Shape{static_cast<std::size_t>(C.Height),
                                       static_cast<std::size_t>(C.Width)};
  reference::MeshView V;
  V.Triangles = Triangles.toIntegers();
  V.Depths = Depths.toDoubles();
  if (Depths.Shape != Shape || Triangles.Shape != Shape ||
      V.Triangles.size() != Shape[0] * Shape[1] ||
      std::ranges::any_of(V.Triangles, [&](int64_t N) {
        return N >= static_cast<int64_t>(M.triangles());
      }))
    return Error{
        Visible,
        fmt::format("no depth and triangle of {} x {} pixels, expected "
                    "what splat render --visible wrote for this "
                    "view and mesh",
                    C.Width, C.Height)};
  if (Seen->contains("layer_depth"))
    if (auto Read = readLayers(Visible, *Seen, M, V); !Read)
      return Read.error();
  return V;
}

/// The mesh of --mesh in the view of \p C, where --visible says or, without it,
/// wholly in fp64.
Expected<reference::Surface<double>>
surfaceOf(const Arguments &A, const reference::Camera<double> &C,
          const reference::Options &O) {
  const auto File = splat::readMesh(A.Mesh);
  if (!File)
    return File.error();
  std::optional<std::array<float, 3>> Light;
  if (!A.Light.empty()) {
    const double Length = std::hypot(A.Light[0], A.Light[1], A.Light[2]);
    Light.emplace();
    for (std::size_t K = 0; K < 3; ++K)
      (*Light)[K] = static_cast<float>(A.Light[K] / Length);
  }
  const reference::Mesh M = splat::toReference(*File, Light);
  const auto Seen = A.Visible.empty() ? Expected(reference::viewOf(M, C, O))
                                      : readView(A.Visible, M, C);
  if (!Seen)
    return Seen.error();
  return reference::surfaceOf(M, C, *Seen);
}

/// Writes what splat gradients is given and judged by.
Expected<Success> writeGradients(const Arguments &A, const splat::Scene &S,
                                 const reference::Camera<double> &C,
                                 const reference::Options &O) {
  auto Given = splat::readNpz(A.Upstream);
  if (!Given)
    return Given.error();
  const auto Render = (*Given)["in_v_render"].toDoubles();
  reference::Upstream U;
  for (std::size_t I = 0; I + 2 < Render.size(); I += 3)
    U.Render.emplace_back(Render[I], Render[I + 1], Render[I + 2]);
  U.Alpha = (*Given)["in_v_alpha"].toDoubles();
  if (U.Render.size() != static_cast<std::size_t>(C.Width) *
                             static_cast<std::size_t>(C.Height) ||
      U.Alpha.size() != U.Render.size())
    return Error{A.Upstream, fmt::format("no in_v_render and in_v_alpha of {} "
                                         "x {} pixels, expected these",
                                         C.Width, C.Height)};
  GradientFiles Files = gradientsAlongRays(S, C, O, std::move(U));
  Files.Expected.merge(Files.Upstream);
  return splat::writeNpz(A.Gradients, Files.Expected);
}

template <typename Real>
Expected<Success> run(const Arguments &A, const splat::Scene &S,
                      const splat::Camera &View) {
  const auto Started = std::chrono::steady_clock::now();
  const reference::Options O = optionsOf(A);
  const auto C = splat::toReference<Real>(View);
  const auto Splats = reference::project(splat::toReference<Real>(S), C, O);
  auto P = reference::blend(Splats, C.Width, C.Height, O);
  if constexpr (std::is_same_v<Real, double>) {
    std::optional<reference::Surface<double>> Behind;
    if (!A.Mesh.empty()) {
      auto Made = surfaceOf(A, C, O);
      if (!Made)
        return Made.error();
      Behind = std::move(*Made);
      P = reference::blend(Splats, C.Width, C.Height, O, &*Behind);
    }
    if (!A.Gradients.empty())
      if (auto Written = writeGradients(A, S, C, O); !Written)
        return Written;
    if (A.AlongRays)
      P = reference::renderAlongRays(
          splat::toReference<Real>(S), C, O,
          A.Order == "pose"  ? reference::RayDepths::Pose
          : A.Order == "ray" ? reference::RayDepths::Ray
                             : reference::RayDepths::Own);
    else if (A.Order == "ray") {
      const auto G = splat::toReference<Real>(S);
      auto R = reference::blendInOrder(Splats, C.Width, C.Height, O,
                                       reference::depthAlongRay(G, C),
                                       Behind ? &*Behind : nullptr);
      P.Render = std::move(R.Render);
      P.Transmittance = std::move(R.Transmittance);
    }
  }
  const auto Lists =
      reference::tileLists(Splats, O.Reach, O.TileSize, C.Width, C.Height);
  const std::chrono::duration<double> Seconds =
      std::chrono::steady_clock::now() - Started;
  if (!A.Output.empty())
    if (auto W = splat::writeNpz(A.Output, toNpz(P)); !W)
      return W;
  if (!A.Pairs.empty())
    if (auto W = splat::writeNpz(A.Pairs, toNpz(Lists, Splats)); !W)
      return W;

  const double Pixels = double(C.Width) * C.Height;
  const auto Visible = std::count_if(Splats.begin(), Splats.end(),
                                     [](const auto &X) { return X.Visible; });
  const auto ByPoints = std::ranges::count_if(
      Splats, [](const auto &X) { return X.Visible && X.ByPoints; });
  const nlohmann::ordered_json Report{{"scene", A.Scene},
                                      {"view", View.Name},
                                      {"resolution", {C.Width, C.Height}},
                                      {"rules", A.Rules},
                                      {"along_rays", A.AlongRays},
                                      {"support", A.Support},
                                      {"precision", A.Precision},
                                      {"antialiased", O.Antialiased},
                                      {"dilation", O.Dilation},
                                      {"background", A.Background},
                                      {"cutoff", O.Cutoff},
                                      {"tile", O.TileSize},
                                      {"visible", Visible},
                                      {"by_points", ByPoints},
                                      {"pairs", Lists.pairs()},
                                      {"blends", P.Blends},
                                      {"walked", P.Walked},
                                      {"saturated_pixels", P.Saturated},
                                      {"doubtful_share", P.doubtfulShare()},
                                      {"seconds", Seconds.count()}};
  if (!A.Json.empty())
    if (auto W = writeFileAtomically(A.Json, jsonText(Report, 2) + "\n"); !W)
      return W;
  fmt::print("{} {}x{} in {}: {} rules, support {}\n{} Gaussians seen, {} "
             "pairs with tiles of {}x{}\n{:.2f} blends, {:.1f} list entries a "
             "pixel, {:.2f} % saturated, {:.3f} % doubtful, {:.1f} s\n",
             View.Name, C.Width, C.Height, A.Precision, A.Rules, A.Support,
             Visible, Lists.pairs(), O.TileSize, O.TileSize,
             double(P.Blends) / Pixels, double(P.Walked) / Pixels,
             100 * double(P.Saturated) / Pixels, 100 * P.doubtfulShare(),
             Seconds.count());
  return Success{};
}

Expected<Success> run(Arguments &A) {
  for (const std::string *File : {&A.Output, &A.Pairs})
    if (!File->empty() && !File->ends_with(".npz"))
      return Error{*File, "unknown file extension, expected .npz",
                   ExitCode::Usage};
  if (A.AlongRays && (A.Precision != "f64" || A.Support != "exact" ||
                      A.Projection != "jacobian"))
    return Error{"",
                 "--along-rays is for --precision f64 without footprints, "
                 "expected no --support or --projection",
                 ExitCode::Usage};
  if (A.Gradients.empty() != A.Upstream.empty() ||
      (!A.Gradients.empty() && !A.AlongRays))
    return Error{
        "", "--upstream and --gradients are for --along-rays, expected all",
        ExitCode::Usage};
  if (A.Order == "pose" && !A.AlongRays)
    return Error{"", "--order pose is for --along-rays, expected it too",
                 ExitCode::Usage};
  if (A.Mesh.empty() && !(A.Visible.empty() && A.Light.empty()))
    return Error{"", "--visible and --light are for --mesh, expected it too",
                 ExitCode::Usage};
  if (!A.Mesh.empty() &&
      (A.Precision != "f64" || A.AlongRays || A.Order == "pose"))
    return Error{"",
                 "--mesh is for --precision f64 and --order depth or ray, "
                 "expected these",
                 ExitCode::Usage};
  auto File = splat::readScene(A.Scene, A.Read);
  if (!File)
    return File.error();
  if (A.Options.LowPass)
    splat::flatten(File->Gaussians);
  A.Options.Antialiased = File->DrawnAs.Antialiased;
  A.Options.Dilation = File->DrawnAs.Dilation.value_or(A.Options.Dilation);
  if (A.AlongRays && A.Order == "ray" &&
      (A.Options.Dilation != 0 || !A.Gradients.empty()))
    return Error{"",
                 "--along-rays --order ray has neither dilation nor "
                 "gradients, expected --dilation 0 and no --gradients",
                 ExitCode::Usage};
  if (!A.Gradients.empty() &&
      (A.Options.Dilation != 0 || A.Options.Antialiased))
    return Error{"",
                 "--gradients are of rays without dilation, expected "
                 "--dilation 0",
                 ExitCode::Usage};
  const auto View = splat::readCamera(A.Cameras, A.View);
  if (!View)
    return View.error();
  if (A.Options.LowPass &&
      (!A.AlongRays || A.Options.Dilation != 0 || A.Order != "depth" ||
       View->Optics.Shutter ||
       !(View->Optics.isPinhole() || View->Optics.Model->IsParallel)))
    return Error{A.Cameras,
                 "--surfels is for --along-rays --dilation 0 --order depth, "
                 "and pinholes or parallel rays of one moment, expected these",
                 ExitCode::Usage};
  if (A.Order == "ray" && !A.AlongRays &&
      (A.Precision != "f64" || View->Optics.Shutter ||
       !View->Optics.isPinhole()))
    return Error{A.Cameras,
                 "--order ray is for --precision f64 and pinholes of one "
                 "moment, expected these"};
  return A.Precision == "f64" ? run<double>(A, File->Gaussians, *View)
                              : run<float>(A, File->Gaussians, *View);
}

} // namespace
} // namespace vorion::test

int main(int Count, char **Values) {
  using namespace vorion::test;
  CLI::App App("Renders one view of a scene with the reference renderer.",
               "splat-reference");
  Arguments A;
  App.add_option("scene", A.Scene, "Scene of any format that splat reads")
      ->required();
  App.add_option("--cameras", A.Cameras, "Views: INRIA's cameras.json")
      ->required();
  App.add_option("--view", A.View, "img_name or id of the view")->required();
  App.add_option("-o,--output", A.Output,
                 "Picture, alpha and masks of doubtful pixels (.npz)");
  App.add_option("--pairs", A.Pairs,
                 "Sorted tile, depth_bits and index arrays (.npz)");
  App.add_option("--json", A.Json,
                 "Write counts and the options that they depend on");
  App.add_option("--projection", A.Projection, "Projection, as in splat render")
      ->check(CLI::IsMember({"jacobian", "unscented"}))
      ->capture_default_str();
  App.add_option("--point-spread", A.Options.PointSpread,
                 "With --projection unscented: largest distance of a sigma "
                 "point from the mean on the picture, in units of the smaller "
                 "of focal length and the picture's longer side")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  App.add_option("--order", A.Order,
                 "Depths that define a pixel's blend order, with f64; ray: "
                 "where each Gaussian is densest on the pixel's ray, and with "
                 "--along-rays the near plane takes this depth, too; pose: "
                 "with --along-rays, depths at the camera's pose, as for "
                 "footprints under a rolling shutter")
      ->check(CLI::IsMember({"depth", "ray", "pose"}))
      ->capture_default_str();
  App.add_option("--mesh", A.Mesh,
                 "With f64: a mesh with the Gaussians (docs/meshes.md)");
  App.add_option("--visible", A.Visible,
                 "Its depths and triangles, from splat render --visible "
                 "(default: computed in fp64; pixels within half a sub-pixel "
                 "of an edge are doubtful)");
  App.add_option("--light", A.Light, "Direction x,y,z of a light on the mesh")
      ->delimiter(',')
      ->expected(3);
  App.add_flag("--along-rays", A.AlongRays,
               "With f64: evaluate each Gaussian at its maximum density along "
               "the pixel's ray, from the camera's position at the pixel's "
               "exposure, in place of a projected footprint");
  App.add_flag("--surfels", A.Options.LowPass,
               "With --along-rays: take its smallest scale from each Gaussian, "
               "with the low-pass filter of 2D Gaussians");
  App.add_option("--falloff-degree", A.Options.FalloffDegree,
                 "With --along-rays: degree of the density's falloff")
      ->check(CLI::IsMember({2, 4}))
      ->capture_default_str();
  App.add_option("--upstream", A.Upstream,
                 "With --along-rays: gradients of a loss, as for splat "
                 "gradients");
  App.add_option("--gradients", A.Gradients,
                 "With --upstream: gradients of the scene, as splat-fixture "
                 "writes them, and those of the loss without doubtful pixels");
  App.add_option("--near", A.Options.Near, "Near plane (0: that of the rules)")
      ->capture_default_str();
  App.add_option("--rules", A.Rules, "Convention to follow")
      ->check(CLI::IsMember({"inria", "gsplat"}))
      ->capture_default_str();
  App.add_option("--support", A.Support, "Pixels that a Gaussian may reach")
      ->check(CLI::IsMember({"exact", "box3", "square3", "official16"}))
      ->capture_default_str();
  App.add_option("--precision", A.Precision, "Precision of all arithmetic")
      ->check(CLI::IsMember({"f64", "f32"}))
      ->capture_default_str();
  App.add_flag_callback(
      "--antialiased", [&A] { A.Read.Drawn.Antialiased = true; },
      "Compensate opacity for the dilation (default: as the scene's file "
      "says)");
  App.add_flag_callback(
      "--no-antialiased", [&A] { A.Read.Drawn.Antialiased = false; },
      "Do not compensate, whatever the file says");
  App.add_option(
         "--dilation", A.Read.Drawn.Dilation,
         "Variance added to both axes of the 2D covariance, px^2 (default: as "
         "the scene's file says, or 0.3)")
      ->check(CLI::NonNegativeNumber);
  App.add_flag("--drop-nonfinite", A.Read.DropNonFinite,
               "Leave out Gaussians with a NaN or an infinity");
  App.add_option("--background", A.Background, "Colour r,g,b (default 0,0,0)")
      ->delimiter(',')
      ->expected(3);
  App.add_option("--cutoff", A.Options.Cutoff,
                 "Transmittance at which a pixel is saturated")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  App.add_option("--tile", A.Options.TileSize, "Tile size in pixels")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  App.add_option("--threads", A.Options.Threads,
                 "Host threads (0: all); results do not depend on it")
      ->check(CLI::Range(0U, 1024U))
      ->capture_default_str();
  return runTool(App, Count, Values, [&A] { return run(A); });
}
