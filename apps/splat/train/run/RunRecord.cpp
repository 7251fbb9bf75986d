#include "train/run/RunRecord.h"

#include "train/settings/SettingsTable.h"

#include "io/Hash.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

/// Of all that the pictures and their poses say.
std::string hashOf(const TrainingSet &Set) {
  std::string All;
  const auto Add = [&All](const auto *Values, std::size_t Count) {
    All.append(reinterpret_cast<const char *>(Values), Count * sizeof(*Values));
  };
  for (const auto *Views : {&Set.Training, &Set.HeldOut}) {
    All += fmt::format("{};", Views->size());
    for (const TrainView &V : *Views) {
      const Camera &C = V.Pose;
      All += fmt::format("{};{};{};", C.Name, C.Width, C.Height);
      for (const double D : {C.Fx, C.Fy, C.Cx, C.Cy})
        Add(&D, 1);
      Add(C.Position.data(), 3);
      for (const auto &Row : C.Rotation)
        Add(Row.data(), 3);
      if (const CameraModel &M = C.Optics; M != CameraModel()) {
        All += M.Model->Name;
        Add(M.K.data(), M.K.size());
        if (const auto &S = M.Shutter) {
          for (const double D : {S->Start, S->Across, S->Down})
            Add(&D, 1);
          Add(S->Motion.data(), 3);
          Add(S->Turn.data(), 3);
        }
      }
      Add(V.Picture.Rgb.data(), V.Picture.Rgb.size());
      Add(V.Counts.data(), V.Counts.size());
      Add(V.Alpha.data(), V.Alpha.size());
      Add(V.Depths.data(), V.Depths.size());
    }
  }
  return fnv1a64(All);
}

} // namespace

std::string hashPictures(const TrainingSet &Set) { return hashOf(Set); }

std::string hashPoints(const CapturePoints &Points) {
  std::string All;
  const auto Add = [&All](const auto &Values) {
    All += fmt::format("{};", Values.size());
    All.append(reinterpret_cast<const char *>(Values.data()),
               Values.size() * sizeof(Values[0]));
  };
  Add(Points.local());
  Add(Points.Colours);
  return fnv1a64(All);
}

Expected<WorldPoint> originOf(const std::string &File, const std::string &Run) {
  const auto Read = parseJson<Json>(Run, File, "a run's settings");
  if (!Read)
    return Read.error();
  if (!Read->is_object() || !Read->contains(OriginKey))
    return WorldPoint{};
  const Json &Origin = Read->at(OriginKey);
  if (!Origin.is_array() || Origin.size() != 3 ||
      !std::ranges::all_of(Origin, [](const Json &X) { return X.is_number(); }))
    return Error{File, fmt::format("the run's {} is {}, expected three numbers",
                                   OriginKey, jsonText(Origin))};
  return Origin.get<WorldPoint>();
}

Json runRecord(const TrainRun &Run, const TrainingSet &Pictures,
               const PictureSource &Source, int ShDegree, Rules Convention,
               const Blender &By, const BackwardOptions &Backward) {
  const TrainSettings &S = Run.Settings;
  Json J{
      {"capture", Source.Format},
      {"pictures", hashOf(Pictures)},
      {"downscale", Source.Downscale},
      {"background", Run.Background},
      {"extent", Run.Extent},
      {"seed", Run.Seed},
      {"batch", Run.Batch},
      {"sh_degree", ShDegree},
      {"rules", name(Convention)},
      {"path", name(By.Kind)},
      {"reciprocal", name(Backward.Unit)},
      {"sums", name(Backward.Order)},
      {"max_gaussians", S.MostGaussians},
      {"adam", {S.Beta1, S.Beta2, S.Epsilon}},
      {"position_rate", {S.PositionRate, S.LastPositionRate, S.PositionSteps}},
      {"rates",
       {S.ColourRate, S.LaterColourRate, S.OpacityRate, S.ScaleRate,
        S.RotationRate}},
      {"dssim", S.DSsim},
      {"sh_interval", S.ShInterval},
      {"densify",
       {S.DensifyInterval, S.DensifyAfter, S.DensifyUntil, S.DensifyGradient,
        S.SplitExtent, S.SplitShrink}},
      {"prune", {S.LeastOpacity, S.MostExtent, S.MostRadius}},
      {"reset", {S.ResetInterval, S.ResetOpacity, S.WhiteReset}}};
  if (Json Changed = changedSettings(S); !Changed.empty())
    J["settings"] = std::move(Changed);
  if (Run.RandomBackground)
    J["random_background"] = true;
  if (Run.Antialiased)
    J["antialiased"] = true;
  if (Run.Near)
    J["near"] = *Run.Near;
  if (Run.Origin != WorldPoint{})
    J[OriginKey] = Run.Origin;
  if (Run.Pictures == LensOf::Photograph)
    J["distorted"] = true;
  if (Run.Through != Spread::Jacobian)
    J["projection"] = name(Run.Through);
  if (Run.Kind != RendererKind::Splat)
    J["renderer"] = name(Run.Kind);
  if (Run.FalloffDegree != 2)
    J["falloff_degree"] = Run.FalloffDegree;
  if (Run.Masks != MaskSource::None)
    J["masks"] = name(Run.Masks);
  // What the order of the cores' sums depends on.
  if (Backward.Pixels != SimtSums::Ordered)
    J["simt_sums"] = name(Backward.Pixels);
  if (By.Tile && By.Tile != 16U) // the default of the cores
    J["tile"] = *By.Tile;
  if (Run.From.empty())
    J["points"] = Run.Points;
  else
    J["from"] = Run.From;
  return J;
}

/// What the value of \p Key was made from, if that is the run's input: for
/// messages that two runs differ. Empty for options.
static std::string_view inputOf(std::string_view Key) {
  if (Key == "pictures")
    return ", hashes of all pictures and poses: --exclude, --downscale and "
           "changed files change them";
  if (Key == "extent")
    return ", from the cameras of training: --hold-out, --exclude and changed "
           "files change it";
  if (Key == "near")
    return ", by default from the distance of cameras and points: --near sets "
           "it";
  if (Key == OriginKey)
    return ", from where training measures the capture's far coordinates";
  if (Key == "points")
    return ", hashes of the initial points";
  return "";
}

/// Where a run's record \p Has differs from \p Wanted; nothing if it does not.
/// Options come before figures of the input, which may differ because of them.
static std::optional<std::string> differenceOf(const Json &Has,
                                               const Json &Wanted) {
  const auto Text = [](const Json &J, const std::string &Key) {
    return J.contains(Key) ? jsonText(J[Key]) : "not given";
  };
  std::set<std::string> Keys;
  for (const Json *J : {&Has, &Wanted})
    for (const auto &[Key, Value] : J->items())
      Keys.insert(Key);
  for (const bool IsInput : {false, true})
    for (const std::string &Key : Keys) {
      if (inputOf(Key).empty() == IsInput ||
          (Has.contains(Key) && Wanted.contains(Key) &&
           Has[Key] == Wanted[Key]))
        continue;
      // The settings that differ from their defaults.
      if (Key == "settings")
        return differenceOf(Has.value(Key, Json::object()),
                            Wanted.value(Key, Json::object()));
      return fmt::format("{} is {}, expected {}{}", Key, Text(Has, Key),
                         Text(Wanted, Key), inputOf(Key));
    }
  return std::nullopt;
}

Expected<Success> checkSameRun(const std::string &File, const std::string &Has,
                               const Json &Wanted) {
  if (Has == jsonText(Wanted))
    return Success{};
  const auto Read = parseJson<Json>(Has, File, "a run's settings");
  if (!Read)
    return Read.error();
  const auto Difference =
      Read->is_object() ? differenceOf(*Read, Wanted) : std::nullopt;
  return Error{File,
               "a checkpoint of another run" +
                   (Difference ? ": " + *Difference : ", expected one of this"),
               ExitCode::Usage};
}

} // namespace vorion::splat
