#include "capture/fuzz/Targets.h"

#include "capture/Colmap.h"
#include "capture/Photo.h"
#include "capture/Transforms.h"
#include "capture/testing/CaptureWriters.h"
#include "io/Exr.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace vorion::splat::fuzz {
namespace {

/// Aborts unless \p Holds: what libFuzzer and the replaying test notice.
void require(bool Holds) {
  if (!Holds)
    std::abort();
}

/// With nothing that a terminal would act on.
void requireOneLine(const Error &E) {
  require(!E.What.empty());
  for (const std::string &Text : {E.Where, E.What})
    require(escaped(Text) == Text);
}

void requireWhole(const CapturePoints &P) {
  require(P.Positions.size() == P.Colours.size());
  require(P.Positions.size() == 3 * P.size());
  require(std::ranges::all_of(P.Positions,
                              [](float V) { return std::isfinite(V); }));
}

void requireWhole(const Camera &C) {
  require(C.Width > 0 && C.Height > 0);
  require(std::isfinite(C.Fx) && C.Fx > 0 && std::isfinite(C.Fy) && C.Fy > 0);
  require(std::isfinite(C.Cx) && std::isfinite(C.Cy));
  for (std::size_t I = 0; I < 3; ++I) {
    require(std::isfinite(C.Position[I]));
    for (const double V : C.Rotation[I])
      require(std::isfinite(V));
  }
}

/// A model as readColmap() takes it.
std::string bundled(testing::Folder F, bool Text) {
  std::string Out(1, Text ? '\1' : '\0');
  for (const char *Name : {"cameras", "images", "points3D"}) {
    const std::string &Content =
        F[fmt::format("sparse/0/{}.{}", Name, Text ? "txt" : "bin")];
    for (const int Shift : {0, 8})
      Out += static_cast<char>(Content.size() >> Shift & 0xFF);
    Out += Content;
  }
  return Out;
}

} // namespace

void readColmap(Bytes Input) {
  if (Input.empty())
    return;
  const bool Text = byteAt(Input, 0) % 2 != 0;
  Input = Input.subspan(1);
  Bytes Parts[3];
  for (Bytes &Part : Parts) {
    if (Input.size() < 2)
      return;
    const std::size_t Length =
        std::min<std::size_t>(load<uint16_t>(Input, 0), Input.size() - 2);
    Part = Input.subspan(2, Length);
    Input = Input.subspan(2 + Length);
  }
  const ColmapFiles Files{
      {"cameras", Parts[0]}, {"images", Parts[1]}, {"points", Parts[2]}};
  const auto Read = Text ? parseColmapText(Files) : parseColmapBinary(Files);
  if (!Read)
    return requireOneLine(Read.error());
  require(!Read->Views.empty());
  for (const auto &V : Read->Views)
    requireWhole(V.Pose);
  requireWhole(Read->Points);
}

void readTransforms(Bytes Input) {
  const auto Read = parseTransforms("input", Input);
  if (!Read)
    requireOneLine(Read.error());
  const auto Points = parsePointCloud("input", Input);
  if (Points)
    requireWhole(*Points);
  else
    requireOneLine(Points.error());
}

void readPhoto(Bytes Input) {
  const auto Read = decodePhoto("input", Input);
  if (Read)
    require(Read->pixels() > 0 && Read->Rgba.size() == 4 * Read->pixels());
  else
    requireOneLine(Read.error());
}

void readExr(Bytes Input) {
  const auto Read = decodeExr("input", Input);
  if (Read)
    require(Read->pixels() > 0 && Read->Render.size() == 3 * Read->pixels() &&
            (Read->Alpha.empty() || Read->Alpha.size() == Read->pixels()));
  else
    requireOneLine(Read.error());
}

Seeds colmapSeeds() {
  const testing::SampleCapture C = testing::sampleCapture();
  return {{"text", bundled(testing::colmapTextOf(C), true)},
          {"binary", bundled(testing::colmapBinaryOf(C), false)}};
}

Seeds transformsSeeds() {
  const testing::SampleCapture C = testing::sampleCapture();
  return {{"own", testing::transformsOf(C)["transforms.json"]},
          {"nerf", testing::nerfSyntheticOf(C)["transforms_train.json"]},
          {"points", testing::pointCloudOf(C)}};
}

Seeds photoSeeds() {
  std::string Rgba;
  for (int I = 0; I < 4 * 5 * 3; ++I)
    Rgba += static_cast<char>(I % 4 == 3 ? 0xff - I : 37 * I);
  return {{"png", testing::pngOf(5, 3, Rgba)},
          {"jpeg", testing::jpegOf(5, 3, Rgba)},
          {"webp", testing::webpOf(5, 3, Rgba)}};
}

Seeds exrSeeds() {
  Image I{5, 3, {}, {}};
  for (int V = 0; V < 5 * 3 * 3; ++V)
    I.Render.push_back(0.1F * static_cast<float>(V * 7 % 45));
  Seeds All{{"float", *encodeExr(I, false)}};
  I.Alpha.assign(5 * 3, 0.5F);
  All.emplace_back("half", *encodeExr(I, true));
  return All;
}

} // namespace vorion::splat::fuzz
