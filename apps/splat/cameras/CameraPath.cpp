#include "cameras/CameraPath.h"

#include "io/CameraLens.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

namespace vorion::splat {
namespace {

using Json = nlohmann::json;

std::optional<double> numberAt(const Json &Object, const char *Key) {
  const auto It = Object.find(Key);
  if (It == Object.end() || !It->is_number() ||
      !std::isfinite(It->get<double>()))
    return std::nullopt;
  return It->get<double>();
}

std::optional<int> sideAt(const Json &Document, const char *Key) {
  const auto Side = numberAt(Document, Key);
  if (!Side || *Side != std::floor(*Side) || *Side < 1 || *Side > MaxImageSize)
    return std::nullopt;
  return static_cast<int>(*Side);
}

/// Camera to world by rows, of 16 numbers by rows or by columns.
using Matrix = std::array<double, 16>;
std::optional<Matrix> matrixOf(const Json &J) {
  // three.js' editor kept the matrix as the text of a list.
  if (J.is_string()) {
    const auto Parsed = parseJson<Json>(J.get_ref<const std::string &>(), "",
                                        "a list of numbers");
    return Parsed && Parsed->is_array() ? matrixOf(*Parsed) : std::nullopt;
  }
  if (!J.is_array() || J.size() != 16)
    return std::nullopt;
  Matrix M{};
  for (std::size_t I = 0; I < 16; ++I) {
    if (!J[I].is_number() || !std::isfinite(J[I].get<double>()))
      return std::nullopt;
    M[I] = J[I].get<double>();
  }
  // The row 0 0 0 1 tells rows from columns.
  if (M[3] == 0 && M[7] == 0 && M[11] == 0 &&
      (M[12] != 0 || M[13] != 0 || M[14] != 0))
    for (std::size_t R = 0; R < 4; ++R)
      for (std::size_t C = R + 1; C < 4; ++C)
        std::swap(M[4 * R + C], M[4 * C + R]);
  return M;
}

/// By the names that nerfstudio's viewer has for its cameras.
Expected<const LensModel *> modelOf(const std::string &Where,
                                    const Json &Document) {
  const auto Type = Document.find("camera_type");
  if (Type == Document.end())
    return CameraModel().Model;
  if (Type->is_string())
    if (const LensModel *Model = lensModelOfViewer(Type->get<std::string>()))
      return Model;
  return Error{Where,
               fmt::format("camera_type {}, expected {}",
                           printable(jsonText(*Type)), knownViewerModels())};
}

/// Pixels of a pinhole whose picture sees \p Fov degrees of height. nerfstudio
/// takes the same number as a fisheye's pixels a radian.
double focalOf(int Height, double Fov) {
  return 0.5 * Height / std::tan(Fov * std::numbers::pi / 180 / 2);
}

/// With the lens of \p Model; the sphere takes no \p Focal.
Camera posed(const Matrix &M, const LensModel *Model, int Width, int Height,
             double Focal) {
  Camera C = Camera::ahead(Width, Height, Focal);
  C.Optics.Model = Model;
  if (Model->CoversSphere)
    setSphere(C);
  for (std::size_t R = 0; R < 3; ++R) {
    C.Position[R] = M[4 * R + 3];
    for (std::size_t K = 0; K < 3; ++K) // y up and z back
      C.Rotation[R][K] = K == 0 ? M[4 * R + K] : -M[4 * R + K];
  }
  return C;
}

} // namespace

bool isCameraPath(const Json &Document) {
  return Document.is_object() &&
         (Document.contains("camera_path") || Document.contains("keyframes"));
}

Expected<std::vector<Camera>> parseCameraPath(const std::string &Where,
                                              const Json &Document) {
  const auto Width = sideAt(Document, "render_width"),
             Height = sideAt(Document, "render_height");
  if (!Width || !Height)
    return Error{
        Where,
        fmt::format(
            "key render_{} is missing or invalid, expected 1 to {} pixels",
            Width ? "height" : "width", MaxImageSize)};
  const auto Model = modelOf(Where, Document);
  if (!Model)
    return Model.error();
  const bool IsSphere = (*Model)->CoversSphere;
  const auto HasSome = [&](const char *Key) {
    const auto It = Document.find(Key);
    return It != Document.end() && It->is_array() && !It->empty();
  };
  const char *List = HasSome("camera_path") ? "camera_path" : "keyframes";
  if (!HasSome(List))
    return Error{Where, "no camera in camera_path, expected at least one"};
  const char *Key =
      std::string_view(List) == "keyframes" ? "matrix" : "camera_to_world";
  std::vector<Camera> Cameras;
  for (const Json &One : Document[List]) {
    const std::string Name = fmt::format("{:05}", Cameras.size());
    const auto Fail = [&](const std::string &What) {
      return Error{Where, fmt::format("camera {}: {}", Name, What)};
    };
    if (!One.is_object() || !One.contains(Key))
      return Fail(fmt::format("key {} is missing, expected 16 numbers", Key));
    const auto M = matrixOf(One[Key]);
    if (!M)
      return Fail(fmt::format("key {} is invalid, expected 16 numbers", Key));
    const auto Fov = One.contains("fov") ? numberAt(One, "fov")
                                         : numberAt(Document, "default_fov");
    // The sphere has none.
    if (!IsSphere && (!Fov || !(*Fov > 0.001 && *Fov < 179.9)))
      return Fail(
          "key fov is missing or invalid, expected degrees between 0 and "
          "180");
    Camera C = posed(*M, *Model, *Width, *Height,
                     IsSphere ? 0 : focalOf(*Height, *Fov));
    C.Id = static_cast<int>(Cameras.size());
    C.Name = Name;
    if (!isRotation(C.Rotation))
      return Fail(fmt::format("key {} is invalid, expected a rotation and a "
                              "translation",
                              Key));
    Cameras.push_back(std::move(C));
  }
  return Cameras;
}

} // namespace vorion::splat
