#include "view/Request.h"

#include "io/CameraLens.h"
#include "picture/TailRule.h"
#include "render/MeshRules.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::json;

namespace {

constexpr std::array<std::string_view, Layers.size()> LayerNames{
    "picture", "depth", "error", "list", "blends", "cycles", "saturation"};

Error wrong(std::string_view Key, std::string_view Wanted) {
  return {"",
          fmt::format("the request's key {} is missing or invalid, expected {}",
                      Key, Wanted),
          ExitCode::Usage};
}

/// The finite number \p Key of \p Of.
std::optional<double> numberOf(const Json &Of, const char *Key) {
  const auto At = Of.find(Key);
  if (At == Of.end() || !At->is_number())
    return std::nullopt;
  const double Value = *At;
  return std::isfinite(Value) ? std::optional(Value) : std::nullopt;
}

std::optional<std::array<double, 3>> threeOf(const Json &List) {
  std::array<double, 3> Three{};
  if (!List.is_array() || List.size() != Three.size())
    return std::nullopt;
  for (std::size_t I = 0; I != Three.size(); ++I) {
    if (!List[I].is_number() || !std::isfinite(List[I].get<double>()))
      return std::nullopt;
    Three[I] = List[I];
  }
  return Three;
}

Expected<int> sideOf(const Json &Of, const char *Key) {
  const auto Side = numberOf(Of, Key);
  if (!Side || *Side != std::floor(*Side) || *Side < 1 || *Side > MostViewed)
    return wrong(Key, fmt::format("1 to {} pixels", MostViewed));
  return static_cast<int>(*Side);
}

} // namespace

nlohmann::ordered_json cameraJson(const Camera &C) {
  return {{"name", C.Name},
          {"width", C.Width},
          {"height", C.Height},
          {"position", C.Position},
          {"rotation", C.Rotation},
          {"fx", C.Fx},
          {"fy", C.Fy},
          {"cx", C.Cx},
          {"cy", C.Cy},
          {"lens", lensJson(C.Optics)},
          // A sphere has no picture without its lens, and parallel rays have no
          // focal length.
          {"lens_is_a_choice", !C.Optics.Model->Keys.empty()}};
}

Expected<Camera> movedCamera(Camera C, const Json &Of) {
  if (Of.contains("position")) {
    const auto Position = threeOf(Of["position"]);
    if (!Position)
      return wrong("position", "three numbers");
    C.Position = *Position;
  }
  if (!Of.contains("rotation"))
    return C;
  const Json &Rows = Of["rotation"];
  if (!Rows.is_array() || Rows.size() != C.Rotation.size())
    return wrong("rotation", "three rows");
  for (std::size_t Row = 0; Row != C.Rotation.size(); ++Row) {
    const auto Three = threeOf(Rows[Row]);
    if (!Three)
      return wrong("rotation", "rows of three numbers");
    C.Rotation[Row] = *Three;
  }
  if (!isRotation(C.Rotation))
    return wrong("rotation", "a rotation");
  return C;
}

Expected<Camera> parsePageCamera(const Json &Of) {
  if (!Of.is_object())
    return wrong("camera", "an object");
  Camera C;
  for (const auto &[Key, Side] :
       {std::pair("width", &C.Width), std::pair("height", &C.Height)}) {
    const auto Read = sideOf(Of, Key);
    if (!Read)
      return Read.error();
    *Side = *Read;
  }
  for (const auto &[Key, Focal] :
       {std::pair("fx", &C.Fx), std::pair("fy", &C.Fy)}) {
    *Focal = numberOf(Of, Key).value_or(0);
    if (!(*Focal > 0))
      return wrong(Key, "a focal length above 0");
  }
  const Json Lens = Of.value("lens", Json());
  if (!Lens.is_null() && !Lens.is_object())
    return wrong("lens", "an object");
  C.Cx = numberOf(Of, "cx").value_or(C.Width / 2.0);
  C.Cy = numberOf(Of, "cy").value_or(C.Height / 2.0);
  for (const char *Key : {"position", "rotation"})
    if (!Of.contains(Key))
      return wrong(Key, "an array");
  auto Placed = movedCamera(std::move(C), Of);
  if (!Placed)
    return Placed;
  C = std::move(*Placed);
  // As cameras.json has it; a sphere's focal lengths follow from the size.
  if (Lens.is_object()) {
    const auto Read = readLens([&](const char *Key) {
      const auto At = Lens.find(Key);
      return At == Lens.end() ? nullptr : &*At;
    });
    if (!Read)
      return Error{"", "the request's lens: " + Read.error().What,
                   ExitCode::Usage};
    C.Optics = *Read;
    if (C.Optics.Model->CoversSphere)
      setSphere(C);
  }
  return C;
}

std::string_view name(Layer L) {
  return LayerNames[static_cast<std::size_t>(L)];
}

std::optional<Heat> heatOf(Layer L) {
  const auto *const Found =
      std::ranges::find(Heats, name(L), [](Heat H) { return name(H); });
  return Found == Heats.end() ? std::nullopt : std::optional(*Found);
}

bool isLayerOf(Layer L, const ShownScene &S) {
  if (!S.Surface)
    return true;
  return L == Layer::Depth ? !S.Surface->has(AlphaMode::Blend) : !heatOf(L);
}

Expected<ViewRequest> parseViewRequest(std::string_view Text) {
  // A request is small; its limits keep what is no page's from taking memory.
  const JsonLimits Limits{
      .Depth = 8, .Bytes = LargestViewRequest, .Values = 256, .Keys = 32};
  const auto Read = parseJson<Json>(Text, "", "a request of the page", Limits);
  if (!Read)
    return Error{"", Read.error().What, ExitCode::Usage};
  if (!Read->is_object())
    return wrong("camera", "an object with it");
  ViewRequest R;
  const auto View = parsePageCamera(Read->value("camera", Json()));
  if (!View)
    return View.error();
  R.View = *View;
  const Json Named = Read->value("setting", Json("default"));
  if (!Named.is_string())
    return wrong("setting", "a name");
  const auto Chosen = Setting::parse(Named.get<std::string>());
  if (!Chosen)
    return Error{"", Chosen.error().What, ExitCode::Usage};
  R.Chosen = *Chosen;
  const Json Shown = Read->value("layer", Json("picture"));
  const auto Found = std::ranges::find_if(
      Layers, [&](Layer L) { return Shown == std::string(name(L)); });
  if (Found == Layers.end())
    return wrong("layer",
                 fmt::format("one of {}", fmt::join(LayerNames, ", ")));
  R.Shown = *Found;
  // Depths are a second blend, which is no part of a frame's time.
  R.Clock = R.Shown != Layer::Depth &&
            (Read->value("clock", Json()) == true || heatOf(R.Shown));
  R.Compare = Read->value("compare", Json()) == true || R.Shown == Layer::Error;
  for (const auto &[Key, At, Side] : {std::tuple("x", &R.X, R.View.Width),
                                      std::tuple("y", &R.Y, R.View.Height)}) {
    const double Value = numberOf(*Read, Key).value_or(0);
    if (!(Value >= 0 && Value < Side))
      return wrong(Key, "a pixel of the picture");
    *At = static_cast<int>(Value);
  }
  return R;
}

Error superseded() {
  return {"", "superseded by a newer request", ExitCode::LimitReached};
}

bool isSuperseded(const Error &E) { return E.What == superseded().What; }

RenderOptions optionsOf(const ViewRequest &R, const ShownScene &Of) {
  const Setting &S = R.Chosen;
  const auto Number = [&](KnobId Id) {
    return static_cast<unsigned>(std::stoul(S.value(Id)));
  };
  RenderOptions O;
  drawAs(O, Of.File.DrawnAs);
  O.Near = Of.Near;
  O.Optics = R.View.Optics.Model;
  O.Exponential = S.exponential();
  O.Arithmetic = S.arithmetic();
  O.AlphaCutoff = Number(KnobId::AlphaCutoff);
  O.Cutoff = std::stof(S.value(KnobId::Cutoff));
  O.Tile = Number(KnobId::Tile);
  O.Reach = S.support();
  O.ShLimit = static_cast<int>(Number(KnobId::ShDegree));
  O.DepthBits = Number(KnobId::DepthBits);
  O.ZTiles = Number(KnobId::ZTiles);
  // The knob's values are rules.
  O.PixelUnit = *parseTailRule(S.value(KnobId::PixelUnit));
  O.SkipSaturated = S.value(KnobId::SkipSaturated) == "on";
  O.SubpixelBits = Number(KnobId::SubpixelBits);
  O.MeshDepth = DepthFormats[S.place(KnobId::MeshDepth)];
  if (S.place(KnobId::FilterBits) != 0)
    O.FilterBits = Number(KnobId::FilterBits);
  O.Surface = Of.Surface;
  O.Light = Of.Light;
  O.KeepVisible = Of.Surface != nullptr;
  return O;
}

Expected<Success> checkMesh(const ViewRequest &R, const ShownScene &Of) {
  const RenderOptions O = optionsOf(R, Of);
  if (heatOf(R.Shown) && !isLayerOf(R.Shown, Of))
    return Error{O.Surface->file(),
                 fmt::format("the layer {} shows one command per tile, "
                             "expected no mesh",
                             name(R.Shown)),
                 ExitCode::Usage};
  for (const auto &Checked :
       {checkMeshCamera(O, ""), checkMeshPrecision(O, "")})
    if (!Checked)
      return Checked;
  return checkTransparency(O, R.Shown == Layer::Depth);
}

} // namespace vorion::splat
