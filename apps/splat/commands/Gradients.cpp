#include "commands/Commands.h"
#include "commands/DeviceArguments.h"
#include "commands/InputFiles.h"
#include "commands/OutputFile.h"
#include "commands/PictureOptions.h"
#include "commands/Progress.h"
#include "commands/SceneArguments.h"

#include "io/Npz.h"
#include "picture/SceneUnit.h"
#include "render/FrameTime.h"
#include "render/Gradients.h"
#include "render/Report.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"
#include "vorion/support/StatusLine.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

namespace vorion::splat {

namespace {

struct GradientArguments {
  SceneArguments Scene;
  std::string Cameras, View, Upstream, Output, Json, Device, KernelFolder;
  bool Time = false;
  RenderOptions Options;
  BackwardOptions Backward;
};

/// The array \p Name of \p File with \p Count elements.
Expected<std::vector<float>> arrayOf(const std::string &File, NpzFile &Arrays,
                                     const std::string &Name,
                                     std::size_t Count) {
  const NpyShape *Found = Arrays.find(Name);
  if (!Found)
    return Error{File, fmt::format("no array {}", Name)};
  if (Found->numbers() != Count)
    return Error{File, fmt::format("array {} has {} elements, expected {} for "
                                   "the view's pixels",
                                   Name, Found->numbers(), Count)};
  const auto Array = Arrays.read(Name);
  if (!Array)
    return Array.error();
  std::vector<float> Values = Array->toFloats();
  if (const auto Bad = std::ranges::find_if_not(
          Values, [](float V) { return std::isfinite(V); });
      Bad != Values.end())
    return Error{File, fmt::format("array {} has a NaN or an infinity as "
                                   "element {}, expected finite values",
                                   Name, Bad - Values.begin())};
  return Values;
}

Expected<PixelGradients> readUpstream(const std::string &File,
                                      const Camera &C) {
  auto Arrays = NpzFile::open(File);
  if (!Arrays)
    return Arrays.error();
  const std::size_t Pixels =
      static_cast<std::size_t>(C.Width) * static_cast<std::size_t>(C.Height);
  auto Render = arrayOf(File, *Arrays, "in_v_render", 3 * Pixels);
  if (!Render)
    return Render.error();
  auto Alpha = arrayOf(File, *Arrays, "in_v_alpha", Pixels);
  if (!Alpha)
    return Alpha.error();
  return PixelGradients{std::move(*Render), std::move(*Alpha)};
}

/// Under the names of the reference results, whose fp32 arrays are "f32_".
Npz arraysOf(const GradientResult &R, const Scene &S, RendererKind Kind) {
  const SceneGradients &G = R.Gradients;
  const std::size_t N = S.size();
  const auto W = static_cast<std::size_t>(R.Picture.Width);
  const auto H = static_cast<std::size_t>(R.Picture.Height);
  Npz Out{{"f32_render", NpyArray::of({H, W, 3}, R.Picture.Render)},
          {"f32_alpha", NpyArray::of({H, W}, R.Picture.Alpha)},
          {"f32_g_means2d", NpyArray::of({N, 2}, G.Means2d)},
          {"f32_g_means", NpyArray::of({N, 3}, G.Means)},
          {"f32_g_quats", NpyArray::of({N, 4}, G.Quats)},
          {"f32_g_scales", NpyArray::of({N, 3}, G.Scales)},
          {"f32_g_opacities", NpyArray::of({N}, G.Opacities)},
          {"f32_g_colors", NpyArray::of({N, S.coefficients(), 3}, G.Sh)}};
  const auto Plane = [&](std::size_t P) {
    const auto Begin = G.Sums.begin() + static_cast<std::ptrdiff_t>(P * N);
    return std::vector<float>(Begin, Begin + static_cast<std::ptrdiff_t>(N));
  };
  if (Kind == RendererKind::Splat)
    Out["f32_g_conics"] = NpyArray::of({N, 3}, G.Conics);
  std::vector<float> Colors(3 * N);
  for (std::size_t I = 0; I < N; ++I)
    for (std::size_t K = 0; K < 3; ++K)
      Colors[3 * I + K] = G.Sums[K * N + I];
  Out["f32_h_dc"] = NpyArray::of({N, 3}, Colors);
  static constexpr const char *OfFootprints[] = {"s",    "sdx",  "sdy",
                                                 "sdxx", "sdxy", "sdyy"};
  static constexpr const char *OfRays[] = {
      "s", "su", "sv", "suu", "suv", "svv", "suq", "svq", "sqq", "slx", "sly"};
  const auto Moments = Kind == RendererKind::Splat
                           ? std::span<const char *const>(OfFootprints)
                           : std::span<const char *const>(OfRays).first(
                                 recordSums(Kind) - SUM_S);
  for (std::size_t M = 0; M < Moments.size(); ++M)
    Out[fmt::format("f32_h_{}", Moments[M])] =
        NpyArray::of({N}, Plane(SUM_S + M));
  return Out;
}

Expected<Success> writeReport(const GradientArguments &A, const SceneFile &File,
                              const Camera &C, const Device &D,
                              const GradientResult &R) {
  const RenderPlan Plan = gradientPlan(File.Gaussians, C, A.Options);
  const auto Report =
      jsonReport({A.Scene.Path, A.Scene.Axes, A.Cameras, A.Output, File,
                  File.Gaussians.size(), C, A.Options, Plan, D, R,
                  BackwardRecord{A.Backward, A.Upstream, R.Gradients}});
  return Report ? writeFileAtomically(A.Json, jsonText(*Report, 2) + "\n")
                : Expected<Success>(Report.error());
}

Expected<Success> run(GradientArguments &A, DeviceOptions Machine) {
  for (const auto &Checked :
       {checkGradientOptions(A.Options, A.Backward),
        checkRenderer(A.Options, A.Scene.Options.Drawn),
        checkEnding("-o", A.Output, {".npz"}), checkJsonName(A.Json)})
    if (!Checked)
      return Checked;
  if (auto Claimed = claimOutputs({{"-o", A.Output}, {"--json", A.Json}},
                                  InputFiles()
                                      .watched()
                                      .scene(A.Scene.Path)
                                      .cameras(A.Cameras)
                                      .file("--upstream", A.Upstream)
                                      .named());
      !Claimed)
    return Claimed;
  auto File = loadScene(A.Scene);
  if (!File)
    return File.error();
  drawByFile(A.Options, File->DrawnAs, File->Gaussians);
  for (const auto &Checked :
       {checkGradientOptions(A.Options, A.Backward),
        checkRenderer(A.Options, A.Scene.Options.Drawn),
        checkFalloff(A.Options.Kind, A.Scene.Options.Drawn.FalloffDegree)})
    if (!Checked)
      return Checked;
  const auto All = readCameras(A.Cameras);
  if (!All)
    return All.error();
  const auto Chosen = selectCameras(A.Cameras, *All, {A.View});
  if (!Chosen)
    return Chosen.error();
  const Camera &C = Chosen->front();
  prepareToDraw(File->Gaussians, *All, A.Options.Convention, A.Options.Near);
  A.Options.Optics = C.Optics.Model;
  A.Options.Rolling = C.Optics.Shutter.has_value();
  if (auto Checked = checkRays(A.Options, A.Cameras); !Checked)
    return Checked;
  const auto U = readUpstream(A.Upstream, C);
  if (!U)
    return U.error();
  if (A.Time)
    turnClockOn(Machine, std::nullopt, "--time");
  auto D = openDevice(A.Device, A.Options.Blending, Machine);
  if (!D)
    return D.error();
  Launcher L(*D, A.KernelFolder, progress());
  const auto R =
      takeGradients(L, File->Gaussians, C, A.Options, A.Backward, *U);
  clearStatus();
  if (!R) {
    showBuildLog(L);
    return R.error();
  }
  if (auto Written =
          writeNpz(A.Output, arraysOf(*R, File->Gaussians, A.Options.Kind));
      !Written)
    return Written.error();
  if (!A.Json.empty())
    if (auto Reported = writeReport(A, *File, C, *D, *R); !Reported)
      return Reported;
  printOut("{} {}x{} on {}: {} rules, support {}, path {}{}\n"
           "{} seen, {} with tiles of {}x{}\n",
           escaped(C.Name), C.Width, C.Height, D->name(),
           name(A.Options.Convention), name(A.Options.Reach),
           name(A.Options.Blending), toString(A.Backward, A.Options.Blending),
           counted(R->Visible, "Gaussian"), counted(R->Pairs, "pair"),
           A.Options.tileSize(), A.Options.tileHeight());
  for (const StageReport &S : R->Stages)
    printOut("{:<18}{:>8.3f} s\n", name(S.Kind), S.Seconds);
  printOut("{}", frameText(R->Stages));
  return Success{};
}

} // namespace

Runner addGradients(CLI::App &App) {
  auto A = std::make_shared<GradientArguments>();
  addSceneOptions(App, A->Scene);
  HelpGroup Group(App, "Cameras");
  takesFile(
      App.add_option("--cameras", A->Cameras, "Views: INRIA's cameras.json"),
      {".json"})
      ->required();
  takesView(
      App.add_option("--view", A->View, "Name (img_name) or id of the view"))
      ->required();
  takesFile(
      App.add_option(
          "--upstream", A->Upstream,
          "Gradients of the loss (.npz): in_v_render with respect to the "
          "picture including its background, in_v_alpha with respect to alpha"),
      {".npz"})
      ->required();
  Group.next("Output");
  writesFile(App.add_option(
                 "-o,--output", A->Output,
                 "Gradients and the rasterizer's partial sums (.npz), with the "
                 "array names of the reference results (default: the scene's "
                 "name with -gradients.npz, in the current folder)"),
             {".npz"});
  writesFile(App.add_option("--json", A->Json,
                            "Write a report with options, counters and times"),
             {".json"});
  Group.next("Time and energy");
  App.add_flag("--time", A->Time,
               "Report the modelled time of the forward and backward pass "
               "(docs/model.md)");
  addGradientOptions(App, A->Options, A->Backward);
  addRendererOption(App, A->Options.Kind, A->Scene.Options.Drawn);
  addDeviceOption(App, A->Device);
  addKernelsOption(App, A->KernelFolder);
  return [A](const DeviceOptions &Machine) {
    nameOutput("-o", A->Output, A->Scene.Path, "-gradients.npz");
    return run(*A, Machine);
  };
}

} // namespace vorion::splat
