#include "commands/PictureOptions.h"

#include "commands/Choices.h"

#include <cmath>
#include <fmt/format.h>

namespace vorion::splat {

void addPictureOptions(CLI::App &App, RenderOptions &O) {
  addRulesOption(App, O.Convention);
  addChoice(
      App, "--support", O.Reach,
      {Support::Exact, Support::Box3, Support::Square3, Support::Official16},
      "Pixels that a Gaussian may reach");
  addPathOption(App, O.Blending, "Who blends: the rasterizer or the cores");
  addBackgroundOption(App, O.Background, "Colour r,g,b (default 0,0,0)");
  App.add_option("--cutoff", O.Cutoff,
                 "Transmittance at which a pixel is full (default 0.0001)");
}

void drawAs(RenderOptions &O, const Drawing &D) {
  O.Antialiased = D.Antialiased;
  O.AntialiasedBy = D.Source;
  O.Dilation = static_cast<float>(D.Dilation.value_or(O.Dilation));
}

Expected<Success> checkPictureOptions(const RenderOptions &O) {
  const auto Usage = [](std::string What) {
    return Error{"", std::move(What), ExitCode::Usage};
  };
  for (const float B : O.Background)
    if (!std::isfinite(B))
      return Usage(fmt::format("--background {}: expected finite numbers", B));
  if (!(O.Cutoff >= 0 && O.Cutoff < 1))
    return Usage(fmt::format("--cutoff {}: expected 0 <= T < 1", O.Cutoff));
  if (O.Blending == Path::Raster && O.Reach == Support::Official16)
    return Usage("--support official16 has tiles of 16x16 pixels, expected "
                 "--path simt with it");
  return Success{};
}

void addBackgroundOption(CLI::App &App, std::array<float, 3> &Colour,
                         const std::string &Help) {
  App.add_option("--background", Colour, Help)
      ->delimiter(',')
      ->option_text("R,G,B");
}

void addRulesOption(CLI::App &App, Rules &Convention) {
  addChoice(App, "--rules", Convention, {Rules::Inria, Rules::Gsplat},
            "Convention to follow");
}

void addPathOption(CLI::App &App, Path &Blending, const std::string &Help) {
  addChoice(App, "--path", Blending, {Path::Raster, Path::Simt}, Help);
}

void addSimtOptions(CLI::App &App, unsigned &Tile, unsigned &Group,
                    std::vector<unsigned> Tiles) {
  addSize(App, "--simt-tile", Tile, std::move(Tiles),
          "Side of a tile of the cores' path");
  addSize(App, "--simt-group", Group, {16, 64, 256},
          "Work-items that draw a tile on the cores' path");
}

void addBackwardOptions(CLI::App &App, BackwardOptions &B) {
  addChoice(App, "--reciprocal", B.Unit, Reciprocals,
            "The rasterizer's unit for 1/(1 - alpha)");
  addChoice(App, "--sum", B.Order, {GatherOrder::Tree, GatherOrder::Rows},
            "How the rasterizer's gather adds up rows");
}

Expected<Success> checkBackwardOptions(const BackwardOptions &B,
                                       Path Blending) {
  const BackwardOptions Default;
  if (Blending == Path::Simt &&
      (B.Unit != Default.Unit || B.Order != Default.Order))
    return Error{"",
                 "--reciprocal and --sum are the rasterizer's, expected --path "
                 "raster with them",
                 ExitCode::Usage};
  return Success{};
}

std::string toString(const BackwardOptions &B, Path Blending) {
  if (Blending != Path::Raster)
    return "";
  return fmt::format(", reciprocal {}, sums in {} order", name(B.Unit),
                     name(B.Order));
}

} // namespace vorion::splat
