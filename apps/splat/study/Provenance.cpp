#include "study/Provenance.h"

#include "device/Configuration.h"
#include "device/Programs.h"
#include "study/PointStore.h"
#include "vorion/support/File.h"
#include "vorion/support/Hash.h"
#include "vorion/support/Json.h"

#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <system_error>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

void append(std::string &To, const auto &Values) {
  To += fmt::format("{};", Values.size());
  To.append(reinterpret_cast<const char *>(Values.data()),
            Values.size() * sizeof(Values[0]));
}

/// The files' hashes, or nothing if one is missing.
Json hashesOf(const std::vector<std::string> &Files) {
  Json Hashes = Json::array();
  for (const std::string &File : Files) {
    const auto Hash = fnv1a64OfFile(File);
    if (!Hash)
      return {};
    Hashes.push_back(*Hash);
  }
  return Hashes;
}

} // namespace

Expected<std::string> hashMachine(const DeviceOptions &Options) {
  auto Machine = machineConfiguration(Options);
  if (!Machine)
    return Machine.error();
  if (Machine->is_object()) {
    Machine->erase("file");
    if (Machine->contains("base") && (*Machine)["base"].is_object())
      (*Machine)["base"].erase("file");
  }
  return fnv1a64(jsonText(*Machine));
}

Expected<Provenance> commonProvenance(const DeviceOptions &Options) {
  const auto Programs = hashPrograms();
  if (!Programs)
    return Programs.error();
  const auto Machine = hashMachine(Options);
  if (!Machine)
    return Machine.error();
  return Provenance{{"programs", *Programs}, {"machine", *Machine}};
}

std::string hashView(const Camera &View) {
  std::string All = fmt::format("{};{};", View.Width, View.Height);
  append(All, std::array{View.Fx, View.Fy, View.Cx, View.Cy});
  append(All, View.Position);
  for (const auto &Row : View.Rotation)
    append(All, Row);
  if (!View.Optics.isPinhole()) {
    All += View.Optics.Model->Name;
    append(All, View.Optics.K);
  }
  if (const auto &S = View.Optics.Shutter) {
    append(All, std::array{S->Start, S->Across, S->Down});
    append(All, S->Motion);
    append(All, S->Turn);
  }
  return fnv1a64(All);
}

Expected<std::string> hashCapture(const Capture &C) {
  std::string All = fmt::format("{};{};", name(C.Format), C.HeldOutBy);
  for (const CaptureView &V : C.Views) {
    auto Picture = fnv1a64OfFile(V.Picture);
    if (!Picture)
      return Picture;
    Camera Taken = V.Pose;
    Taken.Optics = V.Optics;
    All += fmt::format("{};{};{};{};", V.Pose.Name, hashView(Taken), *Picture,
                       V.HeldOut);
    if (V.Mask.empty())
      continue;
    auto Mask = fnv1a64OfFile(V.Mask);
    if (!Mask)
      return Mask;
    All += *Mask + ";";
  }
  append(All, C.Points.local());
  append(All, C.Points.Colours);
  return fnv1a64(All);
}

std::string difference(const Json &Had, const Provenance &Wanted) {
  std::vector<std::string> Names;
  for (const auto &[Name, Is] : Wanted)
    if (!Had.is_object() || !Had.contains(Name) || Had[Name] != Is)
      Names.push_back(Name);
  std::string Text;
  for (std::size_t I = 0; I < Names.size(); ++I)
    Text += (I == 0 ? "" : I + 1 == Names.size() ? " and " : ", ") + Names[I];
  return Text;
}

std::string hashLine(const Provenance &From) {
  std::vector<std::string> Hashes;
  for (const auto &[Name, Is] : From)
    if (Is.size() == 16 &&
        Is.find_first_not_of("0123456789abcdef") == std::string::npos)
      Hashes.push_back(fmt::format("{} {}", Name, Is));
  return fmt::format("fnv1a64: {}", fmt::join(Hashes, ", "));
}

Expected<Success> makeOnce(const std::vector<std::string> &Files,
                           const Provenance &From,
                           const std::function<Expected<Success>()> &Make) {
  const std::string Beside = Files.front() + ".origin";
  if (const auto Had = readOwnJson(Beside))
    if (Had->is_object() &&
        difference(Had->value("made_from", Json()), From).empty() &&
        Had->value("fnv1a64", Json()) == hashesOf(Files))
      return Success{};
  // Broken off in the middle, the files are of nothing.
  std::error_code Ignored;
  std::filesystem::remove(Beside, Ignored);
  if (auto Made = Make(); !Made)
    return Made;
  return writeFileAtomically(
      Beside,
      jsonText(Json{{"made_from", From}, {"fnv1a64", hashesOf(Files)}}, 1) +
          "\n");
}

} // namespace vorion::splat
