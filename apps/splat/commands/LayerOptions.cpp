#include "commands/LayerOptions.h"

#include "commands/Choices.h"
#include "commands/OutputFile.h"
#include "commands/PictureOptions.h"
#include "vorion/support/CommandLine.h"

#include <fmt/format.h>

namespace vorion::splat {

void addLayerOptions(CLI::App &App, LayerFiles &F) {
  const HelpGroup Group(App, "Beside the picture");
  const std::vector<std::string> Pictures(pictureEndings().begin(),
                                          pictureEndings().end());
  writesFile(App.add_option("--depth", F.Depth,
                            "Write each pixel's depth and alpha (.npz, .exr) "
                            "or its depth only (.pfm)"),
             {".npz", ".pfm", ".exr"});
  addChoice(App, "--depth-as", F.As,
            {DepthAs::Accumulated, DepthAs::Expected, DepthAs::Median},
            "Definition of depth: the weighted sum, the weighted mean, or the "
            "depth at which transmittance falls to one half");
  App.get_option("--depth-as")->needs("--depth");
  writesFile(App.add_option("--normals", F.Normals,
                            "Write each pixel's weighted sum of normals (a "
                            "picture; with 8 bits, encoded as colours)"),
             Pictures);
  writesFile(App.add_option("--opacity", F.Opacity,
                            "Write each pixel's opacity (a picture)"),
             Pictures);
  writesFile(App.add_option("--contributors", F.Contributors,
                            "Write the Gaussians with the largest weights of "
                            "each pixel (.npz: index, weight, count)"),
             {".npz"});
  App.add_option(
         "--top", F.Top,
         fmt::format("Number of contributors per pixel (default {})", F.Top))
      ->option_text("N")
      ->needs("--contributors")
      ->check(isBetween(1U, MaxTop));
}

Expected<Success> checkLayers(const LayerFiles &F, const RenderOptions &O,
                              bool IsOne) {
  for (const auto &Checked :
       {checkEnding("--depth", F.Depth, {".pfm", ".npz", ".exr"}),
        checkEnding("--normals", F.Normals, pictureEndings()),
        checkEnding("--opacity", F.Opacity, pictureEndings()),
        checkEnding("--contributors", F.Contributors, {".npz"})})
    if (!Checked)
      return Checked;
  for (const auto &[Option, File] : F.named())
    if (!IsOne && !File.empty())
      return Error{
          "",
          fmt::format("{} applies to one picture, expected one --view", Option),
          ExitCode::Usage};
  return F.needLists()
             ? checkPixelLists(O, F.Contributors.empty() ? "--depth-as median"
                                                         : "--contributors")
             : Success{};
}

} // namespace vorion::splat
