#include "commands/CaptureInfo.h"

#include "capture/Capture.h"
#include "commands/Choices.h"
#include "io/ReportHead.h"
#include "train/data/Start.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

struct Range {
  double Low, High;
};

/// Of \p Value over all views.
template <typename Function> Range rangeOf(const Capture &C, Function Value) {
  const auto First = static_cast<double>(Value(C.Views.front().Pose));
  Range R{First, First};
  for (const CaptureView &V : C.Views) {
    R.Low = std::min<double>(R.Low, Value(V.Pose));
    R.High = std::max<double>(R.High, Value(V.Pose));
  }
  return R;
}

/// Of the points along axis \p K; there is at least one.
Range boundsOf(const CapturePoints &P, std::size_t K) {
  Range R{P.Positions[K], P.Positions[K]};
  for (std::size_t I = K; I < P.Positions.size(); I += 3) {
    R.Low = std::min<double>(R.Low, P.Positions[I]);
    R.High = std::max<double>(R.High, P.Positions[I]);
  }
  return R;
}

struct Facts {
  Range Width, Height, FocalX, FocalY;
  CameraRing Ring;
  double Extent;

  explicit Facts(const Capture &C)
      : Width(rangeOf(C, [](const Camera &P) { return P.Width; })),
        Height(rangeOf(C, [](const Camera &P) { return P.Height; })),
        FocalX(rangeOf(C, [](const Camera &P) { return P.Fx; })),
        FocalY(rangeOf(C, [](const Camera &P) { return P.Fy; })),
        Ring(cameraRing(C)), Extent(sceneExtent(C)) {}
};

std::string textOf(const std::string &Path, const Capture &C) {
  const Facts F(C);
  const auto Span = [](const Range &R) {
    return R.Low == R.High ? fmt::format("{:.6g}", R.Low)
                           : fmt::format("{:.6g} to {:.6g}", R.Low, R.High);
  };
  std::string Text =
      fmt::format("{}: {} capture\n{}, {} of them held out ({})\n",
                  escaped(Path), name(C.Format),
                  counted(C.Views.size(), "view"), C.heldOut(), C.HeldOutBy);
  Text += readerLines(C.Notes, C.WithoutPicture);
  Text += fmt::format("pictures     {} x {} pixels\n", Span(F.Width),
                      Span(F.Height));
  Text += fmt::format("focal length x {}, y {} pixels\n", Span(F.FocalX),
                      Span(F.FocalY));
  const std::size_t Alone = C.photographsAlone();
  if (const std::size_t Bend = C.distorted() - Alone; Bend > 0)
    Text += fmt::format("lenses       distorted in {}: training undistorts "
                        "pictures, unless --distorted is given\n",
                        counted(Bend, "view"));
  if (Alone > 0)
    Text += fmt::format(
        "lenses       {} with full-sphere cameras or a rolling shutter: "
        "training needs --distorted\n",
        counted(Alone, "view"));
  Text += fmt::format("cameras      within {:.6g} of ({:.6g}, {:.6g}, {:.6g}), "
                      "extent {:.6g}\n",
                      F.Ring.Radius, F.Ring.Centre[0], F.Ring.Centre[1],
                      F.Ring.Centre[2], F.Extent);
  if (C.Points.Origin != WorldPoint{})
    Text +=
        fmt::format("frame        training measures from ({:.9g}, {:.9g}, "
                    "{:.9g}), because fp32 has too few digits here\n",
                    C.Points.Origin[0], C.Points.Origin[1], C.Points.Origin[2]);
  if (C.Points.size() == 0) {
    const RandomCube Cube = randomCube(C);
    return Text +
           fmt::format("points       none: training starts from random points "
                       "around {}, seen by {}\n",
                       Cube.centreText(), counted(Cube.SeenBy, "view"));
  }
  return Text + fmt::format("points       {}: x {}, y {}, z {}\n",
                            C.Points.size(), Span(boundsOf(C.Points, 0)),
                            Span(boundsOf(C.Points, 1)),
                            Span(boundsOf(C.Points, 2)));
}

std::string jsonOf(const std::string &Path, const Capture &C) {
  const Facts F(C);
  Json Views = Json::array();
  for (const CaptureView &V : C.Views)
    Views.push_back({{"name", V.Pose.Name},
                     {"width", V.Pose.Width},
                     {"height", V.Pose.Height},
                     {"fx", V.Pose.Fx},
                     {"fy", V.Pose.Fy},
                     {"cx", V.Pose.Cx},
                     {"cy", V.Pose.Cy},
                     {"position", V.Pose.Position},
                     {"rotation", V.Pose.Rotation},
                     {"held_out", V.HeldOut}});
  Json Report = reportHead("splat-capture");
  Report.update({{"capture", Path},
                 {"format", name(C.Format)},
                 {"held_out_by", C.HeldOutBy},
                 {"without_picture", C.WithoutPicture},
                 {"notes", C.Notes},
                 {"distorted", C.distorted()},
                 {"photographs_alone", C.photographsAlone()},
                 {"points", C.Points.size()},
                 {"camera_centre", F.Ring.Centre},
                 {"camera_radius", F.Ring.Radius},
                 {"extent", F.Extent},
                 {"views", Views}});
  return jsonText(Report, 2) + "\n";
}

} // namespace

std::string readerLines(std::span<const std::string> Notes,
                        std::size_t WithoutPicture) {
  std::string Text;
  for (const std::string &Note : Notes)
    Text += fmt::format("read         {}\n", Note);
  if (WithoutPicture > 0)
    Text += fmt::format("skipped      {} without a picture\n",
                        counted(WithoutPicture, "view"));
  return Text;
}

Expected<Success> describeCapture(const std::string &Path,
                                  const std::string &JsonFile,
                                  CaptureOptions Options) {
  // Photographs can be described through any lens.
  Options.Pictures = LensOf::Photograph;
  const auto C = readCapture(Path, Options);
  if (!C)
    return C.error();
  if (!JsonFile.empty())
    if (auto Written = writeFileAtomically(JsonFile, jsonOf(Path, *C));
        !Written)
      return Written;
  printOut("{}", textOf(Path, *C));
  return Success{};
}

void addMasksOption(CLI::App &App, MaskSource &Masks) {
  const HelpGroup Group(App, "Photographs");
  addChoice(App, "--masks", Masks,
            {MaskSource::None, MaskSource::Alpha, MaskSource::Files},
            "Pixels that are masked out: none, transparent ones, or those that "
            "are black in masks/NAME.png or the frame's mask_path");
}

void addHoldOutOption(CLI::App &App, std::optional<unsigned> &Every) {
  const HelpGroup Group(App, "Photographs");
  App.add_option("--hold-out", Every,
                 "Hold out every N-th view in order of names, 0: none "
                 "(default: as recorded in the capture, else 8)")
      ->option_text("N")
      ->check(isBetween(0U, 1000000U));
}

void addPlaceOptions(CLI::App &App, CaptureOptions &Options) {
  const HelpGroup Group(App, "Photographs");
  App.add_option("--images", Options.Images,
                 "Folder of a capture's pictures, in the capture's folder or "
                 "elsewhere; the intrinsics are scaled to the pictures "
                 "(default: found)")
      ->option_text("FOLDER");
  addOutsideOption(App, Options.AllowOutside);
}

void addOutsideOption(CLI::App &App, bool &Allow) {
  const HelpGroup Group(App, "Photographs");
  App.add_flag(
      "--allow-outside", Allow,
      "Allow a capture's pictures and points to be outside its folder");
}

} // namespace vorion::splat
