#include "commands/PictureOptions.h"

#include "commands/Choices.h"
#include "commands/Usage.h"
#include "render/PixelLists.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Printable.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace vorion::splat {

namespace {

/// What is given up for time or area, on either path.
void addDatapathOptions(CLI::App &App, RenderOptions &O) {
  addChoice(App, "--exp", O.Exponential, ExpUnits,
            "Exponential unit; tables are the rasterizer's");
  addSize(App, "--alpha-cutoff", O.AlphaCutoff, {1, 2, 4, 8},
          "Smallest alpha that is blended, in 1/255");
  App.add_option("--depth-bits", O.DepthBits,
                 "Leading bits of the depths that decide the order "
                 "(default 32)")
      ->option_text("1..32")
      ->check(isBetween(1U, 32U));
  App.add_option("--sh-degree", O.ShLimit,
                 "Leave out bands of spherical harmonics above this "
                 "(default 3)")
      ->option_text("0..3")
      ->check(isBetween(0, 3));
}

void addRasterOptions(CLI::App &App, DrawArguments &A) {
  RenderOptions &O = A.Options;
  addChoice(App, "--blend", O.Arithmetic, BlendUnits,
            "Multiplications of the rasterizer's blend stage; sums are fp32");
  addSize(App, "--tile", O.RasterTile, {16, 32, 64},
          "Side of a tile of the rasterizer's path");
  App.add_option("--ztiles", O.ZTiles,
                 "Parts of each tile's list that are blended apart and merged "
                 "(default 1)")
      ->option_text(fmt::format("1..{}", MaxZTiles))
      ->check(isBetween(1U, MaxZTiles));
  App.add_option("--pixel-unit", A.PixelUnit,
                 "When a list goes on in the pixel unit: so many entries are "
                 "left, a share of the pixels is full, or the last part of the "
                 "list is reached (default off)")
      ->option_text("off|count:N|occluded:P|last:A/B[,...]");
  App.add_flag("--skip-saturated", O.SkipSaturated,
               "The rasterizer gives no lane slot to saturated pixels");
}

} // namespace

void addPictureOptions(CLI::App &App, RenderOptions &O) {
  addRulesOption(App, O.Convention);
  addChoice(
      App, "--support", O.Reach,
      {Support::Exact, Support::Box3, Support::Square3, Support::Official16},
      "Pixels that a Gaussian may reach");
  addPathOption(App, O.Blending, "Who blends: the rasterizer or the cores");
  addBackgroundOption(App, O.Background,
                      "Colour r,g,b, white is 1,1,1 (default 0,0,0)");
  App.add_option("--near", O.Near,
                 "Least depth that is drawn (default 0.2 by INRIA's rules, "
                 "0.01 by gsplat's)")
      ->option_text("Z");
  App.add_option("--cutoff", O.Cutoff,
                 "Transmittance at which a pixel is full (default 0.0001)");
  addProjectionOption(App, O.Through);
}

Expected<Success> checkSimtOptions(Path Blending, unsigned SimtTile,
                                   unsigned SimtGroup) {
  const RenderOptions Default;
  if (Blending == Path::Raster &&
      (SimtTile != Default.SimtTile || SimtGroup != Default.SimtGroup))
    return usage("--simt-tile and --simt-group are the cores', expected --path "
                 "simt with them");
  return Success{};
}

Expected<Success> checkPictureOptions(const RenderOptions &O) {
  if (auto Checked = checkSimtOptions(O.Blending, O.SimtTile, O.SimtGroup);
      !Checked)
    return Checked;
  for (const float B : O.Background)
    if (!std::isfinite(B))
      return usage(fmt::format("--background {}: expected finite numbers", B));
  if (O.Near && !(std::isnormal(*O.Near) && *O.Near > 0))
    return usage(fmt::format("--near {}: expected a depth above 0, from {:.3g} "
                             "to {:.3g}",
                             *O.Near, std::numeric_limits<float>::min(),
                             std::numeric_limits<float>::max()));
  if (!(O.Cutoff >= 0 && O.Cutoff < 1))
    return usage(fmt::format("--cutoff {}: expected 0 <= T < 1", O.Cutoff));
  if (O.Blending == Path::Raster && O.Reach == Support::Official16)
    return usage("--support official16 has tiles of 16x16 pixels, expected "
                 "--path simt with it");
  return Success{};
}

void addDrawOptions(CLI::App &App, DrawArguments &A, bool Effects) {
  addPictureOptions(App, A.Options);
  addDatapathOptions(App, A.Options);
  addRasterOptions(App, A);
  addSimtOptions(App, A.Options.SimtTile, A.Options.SimtGroup, {8, 16, 32, 64});
  addChoice(App, "--order", A.Options.Order,
            {PixelOrder::Depth, PixelOrder::Ray},
            "Pixels blend by the depths of centres or by those along their own "
            "rays (docs/numerics.md)");
  App.add_flag("--cull-blocks", A.Options.CullBlocks,
               "Blocks of 16 Gaussians of which a pinhole sees none are left "
               "out whole; changes no bit (docs/ideas.md)");
  addSize(App, "--ray-window", A.Options.RayWindow, {4, 8, 16},
          "Gaussians that a pixel of --order ray finds each time that it "
          "goes through its list; changes no bit");
  if (!Effects)
    return;
  takesSomeOf(
      App.add_option(
          "--effects", A.Effects,
          "Effects compiled into the kernels: what the scene calls for, "
          "all, all behind run-time flags, or those named (default "
          "auto; docs/effects.md)"),
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
    return usage(fmt::format("--exp {} is the rasterizer's, expected --path "
                             "raster with it",
                             name(O.Exponential)));
  if (O.Blending == Path::Simt &&
      (O.ZTiles != 1 || O.PixelUnit.any() || O.SkipSaturated ||
       O.Arithmetic != BlendUnit::Fp32 ||
       O.RasterTile != RenderOptions().RasterTile))
    return usage("--ztiles, --pixel-unit, --skip-saturated, --blend and --tile "
                 "are the rasterizer's, expected --path raster with them");
  if (O.CullBlocks && O.Through == Spread::Unscented)
    return usage("--cull-blocks bounds footprints by the Jacobian, expected "
                 "--projection jacobian with it");
  if (O.Blending == Path::Raster && O.Order == PixelOrder::Ray)
    return usage("--order ray is the cores', because the rasterizer blends by "
                 "its list, expected --path simt with it");
  if (O.Order == PixelOrder::Ray && O.DepthBits != RenderOptions().DepthBits)
    return usage("--depth-bits rounds the depths of centres, expected --order "
                 "depth with it");
  if (O.Order == PixelOrder::Depth && O.RayWindow != RenderOptions().RayWindow)
    return usage(
        "--ray-window belongs to --order ray, expected --order ray with it");
  if (O.Reach == Support::Official16 && O.SimtTile != 16)
    return usage(fmt::format("--simt-tile {}: --support official16 has tiles "
                             "of 16x16 pixels, expected 16",
                             O.SimtTile));
  return Success{};
}

void warnOfMissing(const EffectPlan &P, const std::string &Asked) {
  for (const Effect *E : P.missing())
    printDiagnostic("splat", "warning", "",
                    fmt::format("--effects {} leaves out {}, which the scene "
                                "calls for ({}): the picture differs",
                                Asked, E->Name, P.of(*E).Detected.Figure));
}

void addBackgroundOption(CLI::App &App, std::array<float, 3> &Colour,
                         const std::string &Help) {
  // One word: three floats would take the options behind it, too.
  App.add_option_function<std::string>(
         "--background",
         [&Colour](const std::string &Text) {
           const auto Words = CLI::detail::split(Text, ',');
           bool Read = Words.size() == Colour.size();
           for (std::size_t N = 0; Read && N < Colour.size(); ++N)
             Read = CLI::detail::lexical_cast(Words[N], Colour[N]);
           if (!Read)
             throw CLI::ValidationError(
                 "--background",
                 fmt::format("{}, expected three numbers, as 1,0.5,0", Text));
         },
         Help)
      ->option_text("R,G,B");
}

void addRulesOption(CLI::App &App, Rules &Convention) {
  addChoice(App, "--rules", Convention, {Rules::Inria, Rules::Gsplat},
            "Convention to follow");
}

void addProjectionOption(CLI::App &App, Spread &Through) {
  addChoice(App, "--projection", Through, {Spread::Jacobian, Spread::Unscented},
            "Gaussians go through the camera by its Jacobian at the mean or as "
            "seven points (docs/cameras.md)");
}

void addPathOption(CLI::App &App, Path &Blending, const std::string &Help) {
  addChoice(App, "--path", Blending, {Path::Raster, Path::Simt}, Help);
}

void addSimtOptions(CLI::App &App, unsigned &Tile, unsigned &Group,
                    const std::vector<unsigned> &Tiles) {
  addSize(App, "--simt-tile", Tile, Tiles, "Side of a tile of the cores' path");
  addSize(App, "--simt-group", Group, {16, 64, 256},
          "Work-items that draw a tile on the cores' path");
}

void addBackwardOptions(CLI::App &App, BackwardOptions &B) {
  addChoice(App, "--reciprocal", B.Unit, Reciprocals,
            "The rasterizer's unit for 1/(1 - alpha)");
  addChoice(App, "--sum", B.Order, {GatherOrder::Tree, GatherOrder::Rows},
            "How the rasterizer's gather adds up rows");
  addChoice(App, "--simt-sums", B.Pixels,
            {SimtSums::Ordered, SimtSums::Atomics, SimtSums::Warp},
            "How the cores' way back adds up pixels: in a fixed order, by "
            "atomics as INRIA's program does, or first those of a warp and "
            "then by atomics");
}

Expected<Success> checkBackwardOptions(const BackwardOptions &B,
                                       Path Blending) {
  const BackwardOptions Default;
  if (Blending == Path::Simt &&
      (B.Unit != Default.Unit || B.Order != Default.Order))
    return usage("--reciprocal and --sum are the rasterizer's, expected --path "
                 "raster with them");
  if (Blending == Path::Raster && B.Pixels != Default.Pixels)
    return usage("--simt-sums is the cores', expected --path simt with it");
  return Success{};
}

void addGradientOptions(CLI::App &App, RenderOptions &O, BackwardOptions &B) {
  O.Training = true;
  addPictureOptions(App, O);
  addSimtOptions(App, O.SimtTile, O.SimtGroup, SimtTilesBack);
  addBackwardOptions(App, B);
}

Expected<Success> checkGradientOptions(const RenderOptions &O,
                                       const BackwardOptions &B) {
  if (auto Checked = checkPictureOptions(O); !Checked)
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
