#include "capture/Capture.h"
#include "commands/CaptureInfo.h"
#include "commands/Commands.h"
#include "commands/InputFiles.h"
#include "commands/OutputFile.h"
#include "commands/SceneArguments.h"
#include "io/Hash.h"
#include "io/ReportHead.h"
#include "scene/Statistics.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"

#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

struct InfoArguments {
  SceneArguments Scene;
  std::string JsonFile;
  CaptureOptions Read; ///< of a capture
};

Json json(const Distribution &S) {
  return {{"min", S.Least},
          {"median", S.Median},
          {"mean", S.Mean},
          {"max", S.Largest}};
}

std::string jsonReport(const InfoArguments &A, const SceneFile &F,
                       const SceneStatistics &S, const std::string &Hash) {
  Json Report = reportHead("splat-info");
  Report.update(
      {{"scene", {{"file", A.Scene.Path}, {"fnv1a64", Hash}}},
       {"format", name(F.Format)},
       {"format_version", F.Version},
       {"data_sets", F.Files},
       {"gaussians", F.Gaussians.size()},
       {"sh_degree", F.Gaussians.ShDegree},
       {"dropped_nonfinite", F.Dropped},
       {"antialiased", F.DrawnAs.Antialiased},
       {"antialiased_by", F.DrawnAs.Source},
       {"dilation", F.DrawnAs.Dilation ? Json(*F.DrawnAs.Dilation) : Json()},
       {"documented_axes", recordOf(F.Format).Axes},
       {"axes_changed", A.Scene.Axes},
       {"bounds", {{"min", S.Low}, {"max", S.High}}},
       {"inner_bounds", {{"min", S.InnerLow}, {"max", S.InnerHigh}}},
       {"opacity", json(S.Opacity)},
       {"transparent_share", S.Transparent},
       {"largest_scale", json(S.LargestScale)},
       {"axis_ratio", json(S.AxisRatio)}});
  return jsonText(Report, 2) + "\n";
}

std::string textReport(const InfoArguments &A, const SceneFile &F,
                       const SceneStatistics &S) {
  std::string Text =
      fmt::format("{}: {}", escaped(A.Scene.Path), name(F.Format));
  if (F.Version != 0)
    Text += fmt::format(" version {}", F.Version);
  if (F.Files > 1)
    Text += fmt::format(", {} data sets", F.Files);
  Text +=
      fmt::format("\n{}, SH degree {}{}\n",
                  counted(F.Gaussians.size(), "Gaussian"), F.Gaussians.ShDegree,
                  F.DrawnAs.Antialiased ? ", trained antialiased" : "");
  if (!F.DrawnAs.Source.empty() || F.DrawnAs.Dilation)
    Text += fmt::format(
        "drawn        {}{}{}\n",
        F.DrawnAs.Antialiased ? "antialiased" : "classic",
        F.DrawnAs.Source.empty() ? "" : fmt::format(" ({})", F.DrawnAs.Source),
        F.DrawnAs.Dilation ? fmt::format(", dilation {}", *F.DrawnAs.Dilation)
                           : "");
  const SceneFormatRecord &Kind = recordOf(F.Format);
  Text += fmt::format("axes         {} by {}; {}\n",
                      Kind.Axes.empty() ? CustomaryAxes : Kind.Axes,
                      Kind.Axes.empty() ? "custom, not specified by the format"
                                        : "the format's documentation",
                      A.Scene.Axes.empty() ? "not converted"
                                           : "changed " + A.Scene.Axes + "");
  const auto Box = [&](const char *Name, const std::array<double, 3> &Low,
                       const std::array<double, 3> &High) {
    Text +=
        fmt::format("{:<13}x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z "
                    "{:.6g} to {:.6g}\n",
                    Name, Low[0], High[0], Low[1], High[1], Low[2], High[2]);
  };
  Box("bounds", S.Low, S.High);
  Box("98 % within", S.InnerLow, S.InnerHigh);
  const auto Row = [&](const char *Name, const Distribution &V) {
    Text += fmt::format("{:<13}min {:.4g}, median {:.4g}, mean {:.4g}, max "
                        "{:.4g}\n",
                        Name, V.Least, V.Median, V.Mean, V.Largest);
  };
  Row("opacity", S.Opacity);
  Text +=
      fmt::format("             {:.2f} % below 1/255\n", 100 * S.Transparent);
  Row("longest axis", S.LargestScale);
  Row("axis ratio", S.AxisRatio);
  return Text;
}

Expected<Success> run(const InfoArguments &A) {
  if (auto Checked = checkJsonName(A.JsonFile); !Checked)
    return Checked;
  const bool OfCapture = isCapture(A.Scene.Path);
  InputFiles Inputs;
  if (OfCapture)
    Inputs.capture(A.Scene.Path);
  else
    Inputs.scene(A.Scene.Path);
  if (auto Claimed = claimOutputs({{"--json", A.JsonFile}}, Inputs.named());
      !Claimed)
    return Claimed;
  if (const auto Words = wordsOf(A.Scene); OfCapture && !Words.empty())
    return Error{"",
                 fmt::format("{}: {} is a capture, expected a scene with it",
                             Words.front(), escaped(A.Scene.Path)),
                 ExitCode::Usage};
  if (OfCapture)
    return describeCapture(A.Scene.Path, A.JsonFile, A.Read);
  const auto File = loadScene(A.Scene);
  if (!File)
    return File.error();
  const SceneStatistics S = statisticsOf(File->Gaussians);
  if (!A.JsonFile.empty()) {
    const auto Hash = hashScene(A.Scene.Path);
    if (!Hash)
      return Hash.error();
    if (auto Written =
            writeFileAtomically(A.JsonFile, jsonReport(A, *File, S, *Hash));
        !Written)
      return Written;
  }
  printOut("{}", textReport(A, *File, S));
  return Success{};
}

} // namespace

Runner addInfo(CLI::App &App) {
  auto A = std::make_shared<InfoArguments>();
  addSceneOptions(App, A->Scene);
  writesFile(App.add_option("--json", A->JsonFile, "Write the report as JSON"),
             {".json"});
  addPlaceOptions(App, A->Read);
  return [A](const DeviceOptions &) { return run(*A); };
}

} // namespace vorion::splat
