#include "io/Cameras.h"

#include "io/CameraLens.h"
#include "io/CameraShutter.h"
#include "io/Unsupported.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <ranges>

namespace vorion::splat {
namespace {

using Json = nlohmann::json;

/// Reads the keys of one record and remembers the first thing that is wrong.
class RecordReader {
public:
  RecordReader(const std::string &Path, std::size_t Index, const Json &Record)
      : Path(Path), Index(Index), Record(Record) {}

  Expected<Camera> read() {
    if (!Record.is_object())
      return Error{
          Path,
          fmt::format("record {} is not an object, expected a camera", Index)};
    Camera C;
    if (const Json *Name = key("img_name", "a string")) {
      if (Name->is_string())
        C.Name = Name->get<std::string>();
      else
        wrong("img_name", "a string");
    }
    View = C.Name;
    C.Id = integer("id", 0, 1 << 30);
    C.Width = integer("width", 1, MaxImageSize);
    C.Height = integer("height", 1, MaxImageSize);
    if (const Json *Position = key("position", RowWanted))
      row("position", *Position, C.Position);
    if (const Json *Rotation = key("rotation", RotationWanted)) {
      if (Rotation->is_array() && Rotation->size() == 3)
        for (std::size_t I = 0; I < 3; ++I)
          row("rotation", (*Rotation)[I], C.Rotation[I]);
      else
        wrong("rotation", RotationWanted);
    }
    if (auto Unsupported = unsupportedIn(Record))
      fail(std::move(*Unsupported));
    const auto Find = [&](const char *Key) -> const Json * {
      const auto It = Record.find(Key);
      return It == Record.end() ? nullptr : &*It;
    };
    if (auto Lens = readLens(Find))
      C.Optics = *Lens;
    else
      fail(Lens.error().What);
    if (auto Wrong = readShutter(Find, C))
      fail(std::move(*Wrong));
    if (C.Optics.Model->CoversSphere) {
      setSphere(C);
    } else {
      C.Fx = focal("fx");
      C.Fy = focal("fy");
      C.Cx = Record.contains("cx") ? number("cx") : 0.5 * C.Width;
      C.Cy = Record.contains("cy") ? number("cy") : 0.5 * C.Height;
    }
    if (!Problem && !isRotation(C.Rotation))
      wrong("rotation", "orthonormal axes with determinant +1");
    if (Problem)
      return *Problem;
    return C;
  }

private:
  static constexpr const char *RowWanted = "three finite numbers a row";
  static constexpr const char *RotationWanted =
      "three rows of three finite numbers";

  void fail(std::string What) {
    if (!Problem)
      Problem =
          Error{Path, View.empty() ? fmt::format("record {}: {}", Index, What)
                                   : fmt::format("view {}: {}", View, What)};
  }
  void wrong(const char *Key, const std::string &Wanted) {
    fail(fmt::format("key {} is invalid, expected {}", Key, Wanted));
  }

  const Json *key(const char *Key, const std::string &Wanted) {
    const auto It = Record.find(Key);
    if (It != Record.end())
      return &*It;
    fail(fmt::format("key {} is missing, expected {}", Key, Wanted));
    return nullptr;
  }

  double number(const char *Key) {
    const Json *J = key(Key, "a finite number");
    if (!J)
      return 0;
    if (!J->is_number() || !std::isfinite(J->get<double>())) {
      wrong(Key, "a finite number");
      return 0;
    }
    return J->get<double>();
  }

  double focal(const char *Key) {
    const double Value = number(Key);
    if (Record.contains(Key) && !(Value > 0))
      wrong(Key, "a positive number of pixels");
    return Value;
  }

  int integer(const char *Key, int Least, int Most) {
    const std::string Wanted =
        fmt::format("an integer from {} to {}", Least, Most);
    const Json *J = key(Key, Wanted);
    if (!J)
      return 0;
    // Unsigned 64-bit values above the range must not wrap on conversion.
    if (!J->is_number_integer() || J->get<double>() < Least ||
        J->get<double>() > Most) {
      wrong(Key, Wanted);
      return 0;
    }
    return J->get<int>();
  }

  void row(const char *Key, const Json &J, std::array<double, 3> &To) {
    bool Good = J.is_array() && J.size() == 3;
    for (std::size_t I = 0; Good && I < 3; ++I) {
      Good = J[I].is_number() && std::isfinite(J[I].get<double>());
      if (Good)
        To[I] = J[I].get<double>();
    }
    if (!Good)
      wrong(Key, RowWanted);
  }

  const std::string &Path;
  std::size_t Index;
  const Json &Record;
  std::string View;
  std::optional<Error> Problem;
};

} // namespace

bool isRotation(const std::array<std::array<double, 3>, 3> &R) {
  constexpr double Slack = 2e-3;
  for (int I = 0; I < 3; ++I)
    for (int J = 0; J < 3; ++J) {
      double Dot = 0;
      for (int K = 0; K < 3; ++K)
        Dot += R[K][I] * R[K][J];
      if (!(std::abs(Dot - (I == J)) < Slack))
        return false;
    }
  const double Determinant = R[0][0] * (R[1][1] * R[2][2] - R[1][2] * R[2][1]) -
                             R[0][1] * (R[1][0] * R[2][2] - R[1][2] * R[2][0]) +
                             R[0][2] * (R[1][0] * R[2][1] - R[1][1] * R[2][0]);
  return Determinant > 0;
}

Camera Camera::ahead(int Width, int Height, double Focal) {
  Camera C;
  C.Width = Width;
  C.Height = Height;
  for (std::size_t I = 0; I < 3; ++I)
    C.Rotation[I][I] = 1;
  C.Fx = C.Fy = Focal;
  C.Cx = 0.5 * Width;
  C.Cy = 0.5 * Height;
  return C;
}

std::array<double, 9> Camera::worldToCameraRotation() const {
  std::array<double, 9> R{};
  for (int I = 0; I < 3; ++I)
    for (int J = 0; J < 3; ++J)
      R[3 * I + J] = Rotation[J][I];
  return R;
}

std::array<double, 3> Camera::worldToCameraTranslation() const {
  std::array<double, 3> T{};
  for (int I = 0; I < 3; ++I)
    for (int J = 0; J < 3; ++J)
      T[I] -= Rotation[J][I] * Position[J];
  return T;
}

Expected<std::vector<Camera>> readCameras(const std::string &Path) {
  const auto Document = readJson<Json>(Path, "an array of cameras");
  return Document ? parseCameras(Path, *Document) : Document.error();
}

Expected<std::vector<Camera>> parseCameras(const std::string &Path,
                                           const Json &Document) {
  if (!Document.is_array() || Document.empty())
    return Error{Path, "expected a non-empty array of cameras"};
  std::vector<Camera> Cameras;
  for (std::size_t I = 0; I < Document.size(); ++I) {
    auto C = RecordReader(Path, I, Document[I]).read();
    if (!C)
      return C.error();
    Cameras.push_back(std::move(*C));
  }
  return Cameras;
}

/// Those of \p Cameras that \p View may mean: by their whole names, else by
/// their numbers, or by what their pictures are called in their folders.
static std::vector<const Camera *>
camerasMeant(const std::vector<Camera> &Cameras, const std::string &View) {
  const auto All = [&](const auto &IsMeant) {
    std::vector<const Camera *> Found;
    for (const Camera &C : Cameras)
      if (IsMeant(C))
        Found.push_back(&C);
    return Found;
  };
  auto Named = All([&](const Camera &C) { return C.Name == View; });
  if (!Named.empty())
    return Named;
  // Captures name pictures in folders: "left/0001.jpg".
  return All([&](const Camera &C) {
    const std::filesystem::path P(C.Name);
    return std::to_string(C.Id) == View || P.filename() == View ||
           P.stem() == View;
  });
}

/// The one of \p Cameras, which \p Path has, that is called \p View.
static Expected<Camera> cameraNamed(const std::string &Path,
                                    const std::vector<Camera> &Cameras,
                                    const std::string &View) {
  const std::vector<const Camera *> Meant = camerasMeant(Cameras, View);
  if (Meant.size() == 1)
    return *Meant.front();
  if (!Meant.empty())
    return Error{Path,
                 fmt::format("view {} is ambiguous: {} (number {}) or {} "
                             "(number {}), expected a unique name or number",
                             View, Meant[0]->Name, Meant[0]->Id, Meant[1]->Name,
                             Meant[1]->Id),
                 ExitCode::Usage};
  // A long list helps nobody.
  constexpr std::size_t MostNamed = 12;
  std::string Known;
  for (std::size_t I = 0; I < Cameras.size() && I < MostNamed; ++I)
    Known += (I ? ", " : "") + Cameras[I].Name;
  if (Cameras.size() > MostNamed)
    Known += fmt::format(" and {} more", Cameras.size() - MostNamed);
  return Error{Path,
               fmt::format("no view {}, expected one of {}{}", View, Known,
                           didYouMean(View, std::views::transform(
                                                Cameras, &Camera::Name))),
               ExitCode::Usage};
}

Expected<std::vector<Camera>>
selectCameras(const std::string &Path, const std::vector<Camera> &Cameras,
              const std::vector<std::string> &Views) {
  std::vector<Camera> Found;
  for (const std::string &View : Views) {
    auto C = cameraNamed(Path, Cameras, View);
    if (!C)
      return C.error();
    Found.push_back(std::move(*C));
  }
  return Found;
}

Expected<std::vector<Camera>>
readCameras(const std::string &Path, const std::vector<std::string> &Views) {
  const auto Cameras = readCameras(Path);
  if (!Cameras)
    return Cameras.error();
  return selectCameras(Path, *Cameras, Views);
}

Expected<Camera> readCamera(const std::string &Path, const std::string &View) {
  auto Cameras = readCameras(Path, {View});
  if (!Cameras)
    return Cameras.error();
  return std::move(Cameras->front());
}

Json camerasJson(const std::vector<Camera> &Cameras) {
  Json Document = Json::array();
  for (const Camera &C : Cameras) {
    Json Record{{"id", C.Id},
                {"img_name", C.Name},
                {"width", C.Width},
                {"height", C.Height},
                {"position", C.Position},
                {"rotation", C.Rotation},
                {"fx", C.Fx},
                {"fy", C.Fy},
                {"cx", C.Cx},
                {"cy", C.Cy}};
    if (!C.Optics.isPinhole())
      Record.update(lensJson(C.Optics));
    if (const auto &S = C.Optics.Shutter) {
      Record["rolling_shutter"] = {S->Start, S->Across, S->Down};
      Record["rolling_motion"] = S->Motion;
      Record["rolling_turn"] = S->Turn;
    }
    Document.push_back(std::move(Record));
  }
  return Document;
}

Expected<Success> writeCameras(const std::string &Path,
                               const std::vector<Camera> &Cameras) {
  return writeFileAtomically(Path, jsonText(camerasJson(Cameras), 1) + "\n");
}

} // namespace vorion::splat
