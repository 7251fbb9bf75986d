/// The options that say what a picture is, and how its gradients are taken:
/// one meaning in every subcommand that draws.
#pragma once

#include "effects/EffectPlan.h"
#include "io/Cameras.h"
#include "picture/Options.h"
#include "render/Backward.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// Rules, support, path, background and cut-off. \p O must outlive the
/// parsing, here and below.
void addPictureOptions(CLI::App &App, RenderOptions &O);

/// Whether the values of these go together; an error is one of usage.
Expected<Success> checkPictureOptions(const RenderOptions &O);

/// All that says how a view is drawn; the texts are for parseDrawTexts().
struct DrawArguments {
  RenderOptions Options;
  std::string PixelUnit = "off", Effects = "auto";
  EffectRequest Request;
};

/// Declares the picture's options, what is given up for time or area, and the
/// paths' own; with \p Effects also --effects.
void addDrawOptions(CLI::App &App, DrawArguments &A, bool Effects = true);

/// Reads \p A's texts; an error is one of usage.
Expected<Success> parseDrawTexts(DrawArguments &A);

/// Whether all values go together; an error is one of usage.
Expected<Success> checkDrawOptions(const RenderOptions &O);

/// Says on the terminal which effects \p P leaves out that the picture needs;
/// \p Asked is the text of --effects.
void warnOfMissing(const EffectPlan &P, const std::string &Asked);

void addBackgroundOption(CLI::App &App, std::array<float, 3> &Colour,
                         const std::string &Help);

void addRulesOption(CLI::App &App, Rules &Convention);

void addProjectionOption(CLI::App &App, Spread &Through);

void addPathOption(CLI::App &App, Path &Blending, const std::string &Help);

/// Tile and group of the cores' path.
void addSimtOptions(CLI::App &App, unsigned &Tile, unsigned &Group,
                    const std::vector<unsigned> &Tiles);
/// What the tile may be where gradients are taken back: the cores keep one in
/// local memory.
inline const std::vector<unsigned> SimtTilesBack{8, 16};

/// Whether tile and group fit \p Blending; an error is one of usage.
Expected<Success> checkSimtOptions(Path Blending, unsigned SimtTile,
                                   unsigned SimtGroup);

/// What the rasterizer's backward mode computes with.
void addBackwardOptions(CLI::App &App, BackwardOptions &B);

/// Whether the values fit \p Blending; an error is one of usage.
Expected<Success> checkBackwardOptions(const BackwardOptions &B, Path Blending);

/// All that says how one view's gradients are taken; \p O is for training then.
void addGradientOptions(CLI::App &App, RenderOptions &O, BackwardOptions &B);

/// Whether \p Option, which needs the pixels' lists, goes with \p O; an error
/// is one of usage.
Expected<Success> checkPixelLists(const RenderOptions &O,
                                  std::string_view Option);

/// Whether all values go together; an error is one of usage.
Expected<Success> checkGradientOptions(const RenderOptions &O,
                                       const BackwardOptions &B);

/// These as a report says them, after a comma; empty where the cores go back.
std::string toString(const BackwardOptions &B, Path Blending);

} // namespace vorion::splat
