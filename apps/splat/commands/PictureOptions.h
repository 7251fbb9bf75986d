/// The options that define a picture and the computation of its gradients, with
/// the same meaning in all subcommands that render.
#pragma once

#include "effects/EffectPlan.h"
#include "io/Cameras.h"
#include "picture/Options.h"
#include "render/Backward.h"
#include "scene/Drawing.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// Declares rules, support, path, background and cut-off. \p O must outlive the
/// parsing, here and below.
void addPictureOptions(CLI::App &App, RenderOptions &O);

/// Checks that these values are consistent; otherwise a usage error.
Expected<Success> checkPictureOptions(const RenderOptions &O);

/// All options that determine how a view is rendered; parseDrawTexts() parses
/// the strings.
struct DrawArguments {
  RenderOptions Options;
  std::string PixelUnit = "off", Effects = "auto";
  EffectRequest Request;
};

/// Declares the options of the picture, of approximations, and of the paths;
/// with \p Effects also --effects.
void addDrawOptions(CLI::App &App, DrawArguments &A, bool Effects = true);

/// Parses the strings of \p A; an error is a usage error.
Expected<Success> parseDrawTexts(DrawArguments &A);

/// Checks that all values are consistent; otherwise a usage error.
Expected<Success> checkDrawOptions(const RenderOptions &O);

/// Prints a warning with the effects that the picture needs and \p P omits; \p
/// Asked is the value of --effects.
void warnOfMissing(const EffectPlan &P, const std::string &Asked);

/// Declares the options that approximate a mesh.
void addMeshPrecisionOptions(CLI::App &App, RenderOptions &O);

/// Declares an option of three numbers with commas between them. \p Example is
/// for the message about others.
CLI::Option *addVectorOption(CLI::App &App, const std::string &Name,
                             const std::string &Example,
                             std::function<void(std::array<float, 3>)> Take,
                             const std::string &Help);

void addBackgroundOption(CLI::App &App, std::array<float, 3> &Colour,
                         const std::string &Help);

/// Declares --near, for which checkNear() has a usage error if it is no depth.
void addNearOption(CLI::App &App, std::optional<float> &Near);
Expected<Success> checkNear(const std::optional<float> &Near);

/// Prints a note where the rules' near plane hides more of a view of \p F than
/// it shows.
void hintAtNear(const RenderOptions &O, const ViewFacts &F);

void addRulesOption(CLI::App &App, Rules &Convention);

void addProjectionOption(CLI::App &App, Spread &Through);

void addPathOption(CLI::App &App, Path &Blending, const std::string &Help);

/// Declares the tile size, one of \p Tiles; \p Default is for the help.
void addTileOption(CLI::App &App, std::optional<unsigned> &Tile,
                   const std::vector<unsigned> &Tiles,
                   std::string_view Default);
/// The tile sizes of the backward pass on the cores, which keep a tile in local
/// memory.
inline const std::vector<unsigned> TilesBack{8, 16};
inline constexpr std::string_view DefaultTileBack =
    "32x64, or 16 with --path simt";

/// Declares the group of the path `simt`.
void addGroupOption(CLI::App &App, unsigned &Group);

/// Checks tile and group of the backward pass for the path \p Blending; an
/// error is a usage error.
Expected<Success> checkTilesBack(Path Blending,
                                 const std::optional<unsigned> &Tile,
                                 unsigned SimtGroup);

/// Declares the options of the rasterizer's backward mode.
void addBackwardOptions(CLI::App &App, BackwardOptions &B);

/// Checks the values for the path \p Blending; an error is a usage error.
Expected<Success> checkBackwardOptions(const BackwardOptions &B, Path Blending);

/// Declares --renderer with \p Kinds.
void addRendererOption(CLI::App &App, RendererKind &Kind,
                       const std::vector<RendererKind> &Kinds = {
                           TrainedRenderers.begin(), TrainedRenderers.end()});
/// The same with --falloff-degree, for scenes whose files may record them: \p
/// Drawn gets what is given.
void addRendererOption(CLI::App &App, RendererKind &Kind, DrawingRequest &Drawn,
                       const std::vector<RendererKind> &Kinds = {
                           TrainedRenderers.begin(), TrainedRenderers.end()});

/// Declares --falloff-degree, whose default is \p Degree.
void addFalloffOption(CLI::App &App, unsigned &Degree);

/// A usage error if \p Kind does not support the falloff of \p Degree.
Expected<Success> checkFalloff(RendererKind Kind,
                               const std::optional<unsigned> &Degree);

/// drawAs(), with the renderer and falloff that \p D names. A scene that is
/// drawn as surfels loses each Gaussian's smallest scale.
void drawByFile(RenderOptions &O, const Drawing &D, Scene &S);

/// Says that a scene \p Path trained for another renderer is drawn as
/// footprints.
void warnOfRays(const Drawing &D, const std::string &Path);

/// The usage error that \p Option is of footprints, or of another renderer than
/// \p Kind.
Expected<Success> excludedByRays(std::string_view Option,
                                 RendererKind Kind = RendererKind::Ray);

/// Refuses options that only footprints have.
Expected<Success> checkRenderer(const RenderOptions &O,
                                const DrawingRequest &Drawn);

/// Refuses cameras of file \p Cameras with rolling shutters, because a Gaussian
/// has one colour in a picture, and for lists of rays those whose rays are not
/// affine in the pixel.
Expected<Success> checkRays(const RenderOptions &O, const std::string &Cameras);

/// Declares all options of the gradients of a view; \p O is then set for
/// training.
void addGradientOptions(CLI::App &App, RenderOptions &O, BackwardOptions &B);

/// Checks that \p Option, which needs pixel lists, is compatible with \p O;
/// otherwise a usage error.
Expected<Success> checkPixelLists(const RenderOptions &O,
                                  std::string_view Option);

/// Checks that all values are consistent; otherwise a usage error.
Expected<Success> checkGradientOptions(const RenderOptions &O,
                                       const BackwardOptions &B);

/// The options as text of a report, after a comma; empty if the cores run the
/// backward pass.
std::string toString(const BackwardOptions &B, Path Blending);

} // namespace vorion::splat
