#include "commands/PictureOptions.h"

#include "commands/Choices.h"
#include "commands/Usage.h"
#include "mesh/Mesh.h"
#include "render/PixelLists.h"
#include "scene/Activation.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Printable.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <utility>

namespace vorion::splat {

namespace {

/// What is given up for time or area, on either path.
void addDatapathOptions(CLI::App &App, RenderOptions &O) {
  const HelpGroup Group(App, "Accuracy and speed");
  addChoice(App, "--exp", O.Exponential, ExpUnits,
            "Exponential unit; tables need the rasterizer");
  addSize(App, "--alpha-cutoff", O.AlphaCutoff, {1, 2, 4, 8},
          "Minimum alpha of a blended Gaussian, in units of 1/255",
          std::to_string(O.AlphaCutoff));
  App.add_option("--depth-bits", O.DepthBits,
                 "Number of leading depth bits in the sort key (default 32)")
      ->check(isBetween(1U, 32U));
  App.add_option(
         "--sh-degree", O.ShLimit,
         "Maximum degree of spherical harmonics that are evaluated (default 3)")
      ->check(isBetween(0, 3));
}

void addRasterOptions(CLI::App &App, DrawArguments &A) {
  const HelpGroup Group(App, "Accuracy and speed");
  RenderOptions &O = A.Options;
  addChoice(App, "--blend", O.Arithmetic, BlendUnits,
            "Precision of the multiplications in the rasterizer's blend stage; "
            "sums are fp32");
  App.add_option("--ztiles", O.ZTiles,
                 "Number of depth segments of a tile's list that are blended "
                 "independently and then merged (default 1)")
      ->check(isBetween(1U, MaxZTiles));
  App.add_option(
         "--pixel-unit", A.PixelUnit,
         "Condition for handing the rest of a tile's list to the pixel unit: N "
         "entries are left, a fraction P of the pixels is saturated, or the "
         "last A/B of the list is reached (default off)")
      ->option_text("off|count:N|occluded:P|last:A/B[,...]");
  App.add_flag("--skip-saturated", O.SkipSaturated,
               "Do not spend lane slots of the rasterizer on saturated pixels");
}

} // namespace

void addNearOption(CLI::App &App, std::optional<float> &Near) {
  const HelpGroup Group(App, "Picture");
  App.add_option("--near", Near,
                 "Depth of the near plane (default: 0.2 with INRIA's rules, "
                 "0.01 with gsplat's; less for scenes that are seen from "
                 "less than 1 unit)")
      ->option_text("Z");
}

Expected<Success> checkNear(const std::optional<float> &Near) {
  if (Near && !(std::isnormal(*Near) && *Near > 0))
    return usage(fmt::format("--near {}: expected a depth above 0, from {:.3g} "
                             "to {:.3g}",
                             *Near, std::numeric_limits<float>::min(),
                             std::numeric_limits<float>::max()));
  return Success{};
}

void hintAtNear(const RenderOptions &O, const ViewFacts &F) {
  if (!O.Near && 2 * F.BeforeNear > F.InView)
    printDiagnostic(
        "splat", "note", "",
        fmt::format("{} of {} Gaussians in front of the camera are culled by "
                    "the near plane at depth {:g}: --near sets a smaller depth",
                    F.BeforeNear, F.InView, O.nearLimit()));
}

void addPictureOptions(CLI::App &App, RenderOptions &O) {
  const HelpGroup Group(App, "Picture");
  addRulesOption(App, O.Convention);
  addChoice(
      App, "--support", O.Reach,
      {Support::Exact, Support::Box3, Support::Square3, Support::Official16},
      "Rule for the pixels that a Gaussian covers");
  addPathOption(App, O.Blending,
                "Unit that blends: the rasterizer or the cores");
  addBackgroundOption(
      App, O.Background,
      "Background colour, e.g. 1,1,1 for white (default 0,0,0)");
  addNearOption(App, O.Near);
  App.add_option(
      "--cutoff", O.Cutoff,
      "Transmittance below which a pixel is saturated (default 0.0001)");
  addProjectionOption(App, O.Through);
}

static Expected<Success> checkGroup(Path Blending, unsigned SimtGroup) {
  if (Blending == Path::Raster && SimtGroup != RenderOptions().SimtGroup)
    return usage("--simt-group applies to the cores only, expected --path "
                 "simt");
  return Success{};
}

Expected<Success> checkTilesBack(Path Blending,
                                 const std::optional<unsigned> &Tile,
                                 unsigned SimtGroup) {
  if (Blending == Path::Raster && Tile)
    return usage(fmt::format("--tile {}: the rasterizer's backward pass has "
                             "tiles of 32x64 pixels, expected --path simt",
                             *Tile));
  return checkGroup(Blending, SimtGroup);
}

Expected<Success> checkPictureOptions(const RenderOptions &O) {
  if (auto Checked = checkGroup(O.Blending, O.SimtGroup); !Checked)
    return Checked;
  for (const float B : O.Background)
    if (!std::isfinite(B))
      return usage(fmt::format("--background {}: expected finite numbers", B));
  if (auto Checked = checkNear(O.Near); !Checked)
    return Checked;
  if (!(O.Cutoff >= 0 && O.Cutoff < 1))
    return usage(fmt::format("--cutoff {}: expected 0 <= T < 1", O.Cutoff));
  if (O.Blending == Path::Raster && O.Reach == Support::Official16)
    return usage(
        "--support official16 has tiles of 16x16 pixels, expected --path simt");
  return Success{};
}

void addDrawOptions(CLI::App &App, DrawArguments &A, bool Effects) {
  addPictureOptions(App, A.Options);
  addDatapathOptions(App, A.Options);
  addTileOption(App, A.Options.Tile, {8, 16, 32, 64},
                "64, or 16 with --path simt");
  addRasterOptions(App, A);
  addGroupOption(App, A.Options.SimtGroup);
  HelpGroup Group(App, "Picture");
  addChoice(App, "--order", A.Options.Order,
            {PixelOrder::Depth, PixelOrder::Ray},
            "Blend order: by the depths of the Gaussians' centres, or per "
            "pixel by the depths along its ray (docs/numerics.md)");
  Group.next("Accuracy and speed");
  App.add_flag("--cull-blocks", A.Options.CullBlocks,
               "Cull blocks of 16 Gaussians that are outside a pinhole "
               "camera's frustum; results are bit-identical (docs/ideas.md)");
  addSize(App, "--ray-window", A.Options.RayWindow, {4, 8, 16},
          "Number of Gaussians that a pixel of --order ray or --renderer trace "
          "finds in each pass over its list or tree; results are bit-identical",
          std::to_string(A.Options.RayWindow));
  if (!Effects)
    return;
  Group.next("Device and kernels");
  takesSomeOf(
      App.add_option("--effects", A.Effects,
                     "Effects compiled into the kernels: those that the scene "
                     "needs, all, all under run-time flags, or the named ones "
                     "(default auto; docs/effects.md)"),
      effectChoices())
      ->option_text("auto|all|flags|NAME,...");
}

Expected<Success> parseDrawTexts(DrawArguments &A) {
  auto Tail = parseTailRule(A.PixelUnit);
  if (!Tail)
    return Tail.error();
  A.Options.PixelUnit = *Tail;
  auto Request = parseEffectRequest(A.Effects);
  if (!Request)
    return Request.error();
  A.Request = std::move(*Request);
  return Success{};
}

Expected<Success> checkDrawOptions(const RenderOptions &O) {
  if (auto Checked = checkPictureOptions(O); !Checked)
    return Checked;
  if (O.Blending == Path::Simt && !isOnCores(O.Exponential))
    return usage(fmt::format(
        "--exp {} is a unit of the rasterizer, expected --path raster",
        name(O.Exponential)));
  if (O.Blending == Path::Simt &&
      (O.ZTiles != 1 || O.PixelUnit.any() || O.SkipSaturated ||
       O.Arithmetic != BlendUnit::Fp32))
    return usage("--ztiles, --pixel-unit, --skip-saturated and --blend apply "
                 "to the rasterizer only, expected --path raster");
  if (O.Blending == Path::Raster && O.Tile == 8U)
    return usage("--tile 8: the rasterizer has tiles of 16, 32 or 64 pixels, "
                 "expected one of these, or --path simt");
  if (O.CullBlocks && O.Through == Spread::Unscented)
    return usage("--cull-blocks bounds footprints by the Jacobian, expected "
                 "--projection jacobian");
  if (O.Blending == Path::Raster && O.Order == PixelOrder::Ray)
    return usage("--order ray needs the cores, because the rasterizer blends "
                 "in list order, expected --path simt");
  if (O.Order == PixelOrder::Ray && O.DepthBits != RenderOptions().DepthBits)
    return usage(
        "--depth-bits rounds the depths of centres, expected --order depth");
  if (O.Order == PixelOrder::Depth && O.Kind != RendererKind::Trace &&
      O.RayWindow != RenderOptions().RayWindow)
    return usage("--ray-window applies to rays only, expected --order ray");
  if (O.Kind != RendererKind::Trace && O.Restart != RenderOptions().Restart)
    return usage("--ray-restart applies to traced rays only, expected "
                 "--renderer trace");
  if (O.Reach == Support::Official16 && O.tileSize() != 16)
    return usage(fmt::format("--tile {}: --support official16 has tiles of "
                             "16x16 pixels, expected 16",
                             O.tileSize()));
  return Success{};
}

void warnOfMissing(const EffectPlan &P, const std::string &Asked) {
  for (const Effect *E : P.missing())
    printDiagnostic("splat", "warning", "",
                    fmt::format("--effects {} excludes {}, which the scene "
                                "needs ({}): the picture differs",
                                Asked, E->Name, P.of(*E).Detected.Figure));
}

void addMeshPrecisionOptions(CLI::App &App, RenderOptions &O) {
  const HelpGroup Group(App, "Accuracy and speed");
  App.add_option("--subpixel-bits", O.SubpixelBits,
                 "Sub-pixel bits of the corners of a mesh's triangles "
                 "(default 8)")
      ->check(isBetween(1U, MaxSubpixelBits));
  addChoice(App, "--mesh-depth", O.MeshDepth, DepthFormats,
            "Format of a mesh's depth buffer");
  App.add_option("--filter-bits", O.FilterBits,
                 "Bits of the weights of a mesh's texture filters (default: "
                 "fp32)")
      ->check(isBetween(1U, MaxFilterBits));
}

CLI::Option *addVectorOption(CLI::App &App, const std::string &Name,
                             const std::string &Example,
                             std::function<void(std::array<float, 3>)> Take,
                             const std::string &Help) {
  // One word: three floats would take the options behind it, too.
  return App.add_option_function<std::string>(
      Name,
      [Name, Example, Take = std::move(Take)](const std::string &Text) {
        const auto Words = CLI::detail::split(Text, ',');
        std::array<float, 3> Value{};
        bool Read = Words.size() == Value.size();
        for (std::size_t N = 0; Read && N < Value.size(); ++N)
          Read = CLI::detail::lexical_cast(Words[N], Value[N]);
        if (!Read)
          throw CLI::ValidationError(
              Name, fmt::format("{}, expected three numbers, e.g. {}", Text,
                                Example));
        Take(Value);
      },
      Help);
}

void addBackgroundOption(CLI::App &App, std::array<float, 3> &Colour,
                         const std::string &Help) {
  addVectorOption(
      App, "--background", "1,0.5,0",
      [&Colour](std::array<float, 3> Value) { Colour = Value; }, Help)
      ->option_text("R,G,B");
}

void addRulesOption(CLI::App &App, Rules &Convention) {
  addChoice(App, "--rules", Convention, {Rules::Inria, Rules::Gsplat},
            "Rendering convention");
}

void addProjectionOption(CLI::App &App, Spread &Through) {
  addChoice(
      App, "--projection", Through, {Spread::Jacobian, Spread::Unscented},
      "Projection of covariances: by the camera's Jacobian at the mean, or by "
      "the unscented transform with seven sigma points (docs/cameras.md)");
}

void addPathOption(CLI::App &App, Path &Blending, const std::string &Help) {
  addChoice(App, "--path", Blending, {Path::Raster, Path::Simt}, Help);
}

void addTileOption(CLI::App &App, std::optional<unsigned> &Tile,
                   const std::vector<unsigned> &Tiles,
                   std::string_view Default) {
  const HelpGroup Heading(App, "Accuracy and speed");
  addSize(App, "--tile", Tile, Tiles, "Tile size in pixels", Default);
}

void addGroupOption(CLI::App &App, unsigned &Group) {
  const HelpGroup Heading(App, "Accuracy and speed");
  addSize(App, "--simt-group", Group, {16, 64, 256},
          "Work-items per tile on the simt path", std::to_string(Group));
}

void addBackwardOptions(CLI::App &App, BackwardOptions &B) {
  const HelpGroup Group(App, "Accuracy and speed");
  addChoice(App, "--reciprocal", B.Unit, Reciprocals,
            "Unit of the rasterizer for 1/(1 - alpha)");
  addChoice(App, "--sum", B.Order, {GatherOrder::Tree, GatherOrder::Rows},
            "Order in which the rasterizer's gather stage sums rows");
  addChoice(App, "--simt-sums", B.Pixels,
            {SimtSums::Ordered, SimtSums::Atomics, SimtSums::Warp},
            "Summation over pixels in the backward pass on the cores: in a "
            "fixed order, by atomics as in INRIA's code, or by a reduction in "
            "each warp and then atomics");
}

Expected<Success> checkBackwardOptions(const BackwardOptions &B,
                                       Path Blending) {
  const BackwardOptions Default;
  if (Blending == Path::Simt &&
      (B.Unit != Default.Unit || B.Order != Default.Order))
    return usage("--reciprocal and --sum apply to the rasterizer only, "
                 "expected --path raster");
  if (Blending == Path::Raster && B.Pixels != Default.Pixels)
    return usage("--simt-sums applies to the cores only, expected --path simt");
  return Success{};
}

void addGradientOptions(CLI::App &App, RenderOptions &O, BackwardOptions &B) {
  O.Training = true;
  addPictureOptions(App, O);
  addTileOption(App, O.Tile, TilesBack, DefaultTileBack);
  addGroupOption(App, O.SimtGroup);
  addBackwardOptions(App, B);
}

void addRendererOption(CLI::App &App, RendererKind &Kind,
                       const std::vector<RendererKind> &Kinds) {
  const HelpGroup Group(App, "Picture");
  addChoice(App, "--renderer", Kind, Kinds,
            "Evaluation of a Gaussian: as a footprint on the picture, or where "
            "it is densest on each pixel's ray, by lists of tiles, as a disc, "
            "or traced (docs/cameras.md)");
}

/// \p Default is what stands for the option without it.
template <typename Number>
static void addFalloffOption(CLI::App &App, Number &Degree,
                             std::string_view Default) {
  const HelpGroup Group(App, "Picture");
  addSize(App, "--falloff-degree", Degree, {2, 4},
          "Degree of a Gaussian's density along rays: exp(-q / 2) or, as in "
          "3DGRT, exp(-q^2 / 18), q being the square of the distance in "
          "standard deviations",
          Default);
}

void addFalloffOption(CLI::App &App, unsigned &Degree) {
  addFalloffOption(App, Degree, std::to_string(Degree));
}

void addRendererOption(CLI::App &App, RendererKind &Kind, DrawingRequest &Drawn,
                       const std::vector<RendererKind> &Kinds) {
  addRendererOption(App, Kind, Kinds);
  addFalloffOption(App, Drawn.FalloffDegree, "the scene file's, or 2");
  App.get_option("--renderer")->each([&Drawn](const std::string &Chosen) {
    Drawn.Renderer = trainedRenderer(Chosen).value_or(RendererKind::Splat);
  });
}

void drawByFile(RenderOptions &O, const Drawing &D, Scene &S) {
  if (D.Renderer != RendererKind::Splat)
    O.Kind = D.Renderer;
  if (O.Kind == RendererKind::Surfel)
    flatten(S);
  if (hasFalloffDegree(O.Kind))
    O.FalloffDegree = D.FalloffDegree;
  drawAs(O, D);
}

Expected<Success> checkFalloff(RendererKind Kind,
                               const std::optional<unsigned> &Degree) {
  if (Degree.value_or(2) == 2 || hasFalloffDegree(Kind))
    return Success{};
  return usage("--falloff-degree 4 is of rays, expected --renderer ray or "
               "trace");
}

void warnOfRays(const Drawing &D, const std::string &Path) {
  if (D.Renderer != RendererKind::Splat)
    printDiagnostic("splat", "warning", Path,
                    fmt::format("was trained with --renderer {0}, and is drawn "
                                "as footprints: splat render draws it with "
                                "--renderer {0}",
                                name(D.Renderer)));
}

Expected<Success> excludedByRays(std::string_view Option, RendererKind Kind) {
  return usage(fmt::format("--renderer {} excludes {}, expected --renderer "
                           "splat",
                           name(Kind), Option));
}

Expected<Success> checkRenderer(const RenderOptions &O,
                                const DrawingRequest &Drawn) {
  if (O.Kind == RendererKind::Splat)
    return Success{};
  for (const auto &[Is, Option] :
       {std::pair{O.Reach != Support::Exact, "--support"},
        {O.Through != Spread::Jacobian, "--projection"},
        {O.Order != PixelOrder::Depth, "--order"},
        {Drawn.Antialiased.value_or(false), "--antialiased"},
        {Drawn.Dilation.has_value(), "--dilation"},
        {O.CullBlocks, "--cull-blocks"},
        {O.PixelUnit.any(), "--pixel-unit"}})
    if (Is)
      return excludedByRays(Option, O.Kind);
  if (O.Kind != RendererKind::Trace)
    return Success{};
  for (const auto &[Is, Option] :
       {std::pair{O.DepthBits != RenderOptions().DepthBits, "--depth-bits"},
        {O.Tile.has_value(), "--tile"},
        {O.SimtGroup != RenderOptions().SimtGroup, "--simt-group"}})
    if (Is)
      return excludedByRays(Option, O.Kind);
  if (O.Blending == Path::Raster)
    return usage("--renderer trace needs the cores, which take rays through a "
                 "tree, expected --path simt");
  return Success{};
}

Expected<Success> checkRays(const RenderOptions &O,
                            const std::string &Cameras) {
  if (O.Kind == RendererKind::Splat)
    return Success{};
  if (O.Rolling)
    return Error{Cameras,
                 fmt::format("--renderer {}: a camera with a rolling shutter, "
                             "expected a global one, or --renderer splat",
                             name(O.Kind))};
  if (O.Kind == RendererKind::Trace || O.Optics->isPinhole() ||
      O.Optics->IsParallel)
    return Success{};
  return Error{Cameras,
               fmt::format("--renderer {}: a camera of model {}, expected a "
                           "pinhole or parallel rays, or --renderer splat",
                           name(O.Kind), O.Optics->Name)};
}

Expected<Success> checkGradientOptions(const RenderOptions &O,
                                       const BackwardOptions &B) {
  if (O.Kind != RendererKind::Splat && B.Pixels != SimtSums::Ordered)
    return excludedByRays("--simt-sums", O.Kind);
  for (const auto &Checked : {checkPictureOptions(O),
                              checkTilesBack(O.Blending, O.Tile, O.SimtGroup)})
    if (!Checked)
      return Checked;
  return checkBackwardOptions(B, O.Blending);
}

Expected<Success> checkPixelLists(const RenderOptions &O,
                                  std::string_view Option) {
  if (hasPixelLists(O))
    return Success{};
  return usage(fmt::format("{} is computed on the host with the exact units, "
                           "expected --exp exact, --blend fp32, --ztiles 1 and "
                           "--order depth",
                           Option));
}

std::string toString(const BackwardOptions &B, Path Blending) {
  if (Blending != Path::Raster) {
    switch (B.Pixels) {
    case SimtSums::Ordered:
      return "";
    case SimtSums::Atomics:
      return ", sums by atomics";
    case SimtSums::Warp:
      return ", sums of a warp by atomics";
    }
  }
  return fmt::format(", reciprocal {}, sums in {} order", name(B.Unit),
                     name(B.Order));
}

} // namespace vorion::splat
