#include "view/Picked.h"

#include "view/Request.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::json;

namespace {

Error wrong(std::string_view Key, std::string_view Wanted) {
  return {"",
          fmt::format("the request's key {} is missing or invalid, expected {}",
                      Key, Wanted),
          ExitCode::Usage};
}

/// Finite numbers, as many as \p To has.
template <std::size_t Count>
bool readNumbers(const Json &List, std::array<double, Count> &To) {
  if (!List.is_array() || List.size() != Count)
    return false;
  for (std::size_t I = 0; I != Count; ++I) {
    if (!List[I].is_number() || !std::isfinite(List[I].get<double>()))
      return false;
    To[I] = List[I];
  }
  return true;
}

Expected<Stroke> strokeOf(const Json &Of) {
  Stroke S;
  auto View = parsePageCamera(Of.value("camera", Json()));
  if (!View)
    return View.error();
  S.View = std::move(*View);
  const Json Radius = Of.value("radius", Json()),
             Points = Of.value("points", Json());
  if (!Radius.is_number() || !(Radius > 0) || !(Radius <= MostViewed))
    return wrong("radius", fmt::format("above 0, up to {} pixels", MostViewed));
  S.Radius = Radius;
  if (!Points.is_array())
    return wrong("points", "an array");
  for (const Json &Each : Points) {
    std::array<double, 2> Point{};
    if (!readNumbers(Each, Point))
      return wrong("points", "pairs of numbers");
    S.Points.push_back(Point);
  }
  return S;
}

Expected<PickedPart> partOf(const Json &Of) {
  if (!Of.is_object())
    return wrong("parts", "objects");
  PickedPart P;
  const Json Op = Of.value("op", Json("add"));
  if (Op != "add" && Op != "remove")
    return wrong("op", "add or remove");
  P.IsAdded = Op == "add";
  std::array<double, 6> Box{};
  std::array<double, 4> Sphere{};
  std::array<double, 1> Bound{};
  if (Of.contains("box")) {
    if (!readNumbers(Of["box"], Box))
      return wrong("box", "six numbers");
    P.Of = Box;
  } else if (Of.contains("sphere")) {
    if (!readNumbers(Of["sphere"], Sphere))
      return wrong("sphere", "four numbers");
    P.Of = Sphere;
  } else if (Of.contains("fainter")) {
    if (!readNumbers(Json::array({Of["fainter"]}), Bound))
      return wrong("fainter", "an opacity");
    P.Of = Fainter{Bound[0]};
  } else if (Of.contains("larger")) {
    if (!readNumbers(Json::array({Of["larger"]}), Bound))
      return wrong("larger", "a standard deviation");
    P.Of = Larger{Bound[0]};
  } else if (Of.contains("stroke") && Of["stroke"].is_object()) {
    auto S = strokeOf(Of["stroke"]);
    if (!S)
      return S.error();
    P.Of = std::move(*S);
  } else {
    return wrong("parts",
                 "one of box, sphere, fainter, larger and stroke in each");
  }
  return P;
}

/// Projects centres to pixels.
class Projector {
public:
  explicit Projector(const Camera &C)
      : C(C), R(C.worldToCameraRotation()), T(C.worldToCameraTranslation()) {}

  /// Of Gaussian \p I of \p S; empty behind the camera and outside the picture.
  std::optional<std::array<double, 2>> place(const Scene &S,
                                             std::size_t I) const {
    std::array<double, 3> P = T;
    for (std::size_t Row = 0; Row != 3; ++Row)
      for (std::size_t K = 0; K != 3; ++K)
        P[Row] += R[3 * Row + K] * S.mean(3 * I + K);
    const auto [X, Y, Z] = P;
    const LensModel &Lens = *C.Optics.Model;
    LensPlace At{X, Y};
    if (Lens.CoversSphere) {
      At = {std::atan2(X, Z), std::atan2(Y, std::hypot(X, Z))};
    } else if (!(Z > 0)) {
      return std::nullopt;
    } else if (!Lens.IsParallel) {
      // Beyond that, a lens shows nothing.
      if (std::hypot(X, Y) > C.Optics.reach() * Z)
        return std::nullopt;
      At = C.Optics.distorted(X / Z, Y / Z);
    }
    const std::array<double, 2> Pixel{C.Cx + C.Fx * At[0], C.Cy + C.Fy * At[1]};
    if (!(Pixel[0] >= 0 && Pixel[0] < C.Width && Pixel[1] >= 0 &&
          Pixel[1] < C.Height))
      return std::nullopt;
    return Pixel;
  }

private:
  const Camera &C;
  std::array<double, 9> R;
  std::array<double, 3> T;
};

/// Those whose centres are under the stroke, at any depth.
Selection underStroke(const Scene &S, const Stroke &Under) {
  const auto Width = static_cast<std::size_t>(Under.View.Width),
             Height = static_cast<std::size_t>(Under.View.Height);
  // Which pixels are painted, by their centres.
  std::vector<bool> Painted(Width * Height);
  const auto Bound = [](double At, std::size_t Side) {
    return static_cast<std::size_t>(
        std::clamp(std::ceil(At), 0.0, static_cast<double>(Side)));
  };
  for (const auto &[X, Y] : Under.Points)
    for (std::size_t Row = Bound(Y - Under.Radius - 0.5, Height);
         Row < Bound(Y + Under.Radius + 0.5, Height); ++Row)
      for (std::size_t Column = Bound(X - Under.Radius - 0.5, Width);
           Column < Bound(X + Under.Radius + 0.5, Width); ++Column)
        if (std::hypot(static_cast<double>(Column) + 0.5 - X,
                       static_cast<double>(Row) + 0.5 - Y) <= Under.Radius)
          Painted[Row * Width + Column] = true;
  const Projector To(Under.View);
  Selection Of(S.size());
  for (std::size_t I = 0; I != S.size(); ++I)
    if (const auto At = To.place(S, I))
      Of[I] = Painted[static_cast<std::size_t>((*At)[1]) * Width +
                      static_cast<std::size_t>((*At)[0])];
  return Of;
}

struct Selector {
  const Scene &S;
  Selection operator()(const std::array<double, 6> &Box) const {
    return inBox(S, Box);
  }
  Selection operator()(const std::array<double, 4> &Sphere) const {
    return inSphere(S, Sphere);
  }
  Selection operator()(const Fainter &Than) const {
    return fainterThan(S, Than.Opacity);
  }
  Selection operator()(const Larger &Than) const {
    return largerThan(S, Than.Deviation);
  }
  Selection operator()(const Stroke &Under) const {
    return underStroke(S, Under);
  }
};

} // namespace

Expected<PickedRequest> parsePicked(std::string_view Text) {
  const JsonLimits Limits{
      .Depth = 8, .Bytes = LargestViewRequest, .Values = 1 << 14, .Keys = 32};
  const auto Read = parseJson<Json>(Text, "", "a request of the page", Limits);
  if (!Read)
    return Error{"", Read.error().What, ExitCode::Usage};
  if (!Read->is_object())
    return wrong("parts", "an object with it");
  PickedRequest R;
  const Json Parts = Read->value("parts", Json::array());
  if (!Parts.is_array())
    return wrong("parts", "an array");
  for (const Json &Each : Parts) {
    auto Part = partOf(Each);
    if (!Part)
      return Part.error();
    R.Parts.push_back(std::move(*Part));
  }
  if (Read->contains("camera")) {
    auto View = parsePageCamera((*Read)["camera"]);
    if (!View)
      return View.error();
    R.View = std::move(*View);
  }
  if (!Read->contains("do"))
    return R;
  const Json &Do = (*Read)["do"];
  const Json Scene = Read->value("scene", Json());
  if (!Scene.is_number_unsigned())
    return wrong("scene", "the number of a scene");
  R.Scene = Scene;
  for (const auto &[Name, Kind] : {std::pair("delete", EditKind::Delete),
                                   {"crop", EditKind::Crop},
                                   {"undo", EditKind::Undo}})
    if (Do == Name)
      R.Do = Kind;
  if (!R.Do)
    return wrong("do", "delete, crop or undo");
  return R;
}

Selection selected(const Scene &S, const std::vector<PickedPart> &Parts) {
  Selection All(S.size());
  for (const PickedPart &P : Parts) {
    const Selection Of = std::visit(Selector{S}, P.Of);
    for (std::size_t I = 0; I != All.size(); ++I)
      if (Of[I])
        All[I] = P.IsAdded;
  }
  return All;
}

std::vector<std::array<float, 2>> placesOf(const Scene &S, const Selection &Of,
                                           const Camera &View,
                                           std::size_t Most) {
  const Projector To(View);
  std::vector<std::array<float, 2>> All;
  for (std::size_t I = 0; I != S.size(); ++I)
    if (Of[I])
      if (const auto At = To.place(S, I))
        All.push_back({static_cast<float>((*At)[0] / View.Width),
                       static_cast<float>((*At)[1] / View.Height)});
  const std::size_t Step = 1 + All.size() / Most;
  std::vector<std::array<float, 2>> Some;
  for (std::size_t I = 0; I < All.size(); I += Step)
    Some.push_back(All[I]);
  return Some;
}

} // namespace vorion::splat
