#include "capture/Transforms.h"

#include "io/CameraLens.h"
#include "io/CameraShutter.h"
#include "io/PlyFile.h"
#include "io/Unsupported.h"
#include "scene/Scene.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>

namespace vorion::splat {
namespace {

using Json = nlohmann::json;

std::string withoutDot(std::string Name) {
  if (Name.starts_with("./"))
    Name.erase(0, 2);
  return Name;
}

/// Reads frames and what they inherit from the file; remembers what is wrong
/// first.
class TransformsReader {
public:
  TransformsReader(const std::string &Where, const Json &Document)
      : Where(Where), Document(Document) {}

  Expected<TransformsFile> read();

private:
  void fail(const std::string &What) {
    if (!Problem)
      Problem = Error{Where, View.empty() ? What : View + ": " + What};
  }
  /// The value of \p Key in the frame or else in the file.
  const Json *find(const Json &Frame, const char *Key) const {
    for (const Json *Object : {&Frame, &Document})
      if (const auto It = Object->find(Key);
          It != Object->end() && !It->is_null())
        return &*It;
    return nullptr;
  }
  std::optional<double> number(const Json &Frame, const char *Key);
  CameraModel readLens(const Json &Frame);
  CameraPlace readPlace(const Json &Frame, const char *Key);
  void readPose(const Json &Frame, CaptureView &V);
  void readCamera(const Json &Frame, TransformsView &V);
  void readSplit(TransformsFile &T);

  const std::string &Where;
  const Json &Document;
  std::string View;
  std::optional<Error> Problem;
};

std::optional<double> TransformsReader::number(const Json &Frame,
                                               const char *Key) {
  const Json *J = find(Frame, Key);
  if (!J)
    return std::nullopt;
  const auto Value = finiteNumber(*J, Key);
  if (!Value) {
    fail(Value.error().What);
    return std::nullopt;
  }
  return *Value;
}

/// Terms as nerfstudio and instant-ngp write them: k1 to k4 are of r^2 to r^8,
/// but OpenCV's full model has k4 to k6 in the denominator.
CameraModel TransformsReader::readLens(const Json &Frame) {
  const auto Lens = vorion::splat::readLens(
      [&](const char *Key) { return find(Frame, Key); }, FourthTerm::Above);
  if (!Lens) {
    fail(Lens.error().What);
    return {};
  }
  if (Lens->Model->IsParallel)
    fail("a photograph of an orthographic camera, expected a pinhole, fisheye "
         "or full-sphere camera");
  return *Lens;
}

CameraPlace TransformsReader::readPlace(const Json &Frame, const char *Key) {
  CameraPlace C;
  const auto It = Frame.find(Key);
  bool Good =
      It != Frame.end() && It->is_array() &&
      (It->size() == 3 || (It->size() == 4 && (*It)[3] == Json({0, 0, 0, 1})));
  for (std::size_t R = 0; Good && R < 3; ++R) {
    const Json &Row = (*It)[R];
    Good = Row.is_array() && Row.size() == 4;
    for (std::size_t K = 0; Good && K < 4; ++K) {
      Good = Row[K].is_number() && std::isfinite(Row[K].get<double>());
      if (!Good)
        break;
      const double Value = Row[K].get<double>();
      if (K == 3)
        C.Position[R] = Value;
      else // y up and z back become y down and z forward
        C.Rotation[R][K] = K == 0 ? Value : -Value;
    }
  }
  if (!Good || !isRotation(C.Rotation))
    fail(fmt::format("an invalid pose, expected {} with a rotation and a "
                     "translation, camera to world",
                     Key));
  return C;
}

/// As instant-ngp has it: a camera goes from transform_matrix_start to
/// transform_matrix_end, and rolling_shutter says when it exposes a pixel, by
/// start, across, down and the motion blur, which is not drawn.
void TransformsReader::readPose(const Json &Frame, CaptureView &V) {
  const bool HasStart = Frame.contains("transform_matrix_start");
  CameraPlace Place = readPlace(Frame, HasStart ? "transform_matrix_start"
                                                : "transform_matrix");
  std::array<double, 3> Moments{};
  if (const Json *J = find(Frame, "rolling_shutter")) {
    Json Three = *J;
    if (Three.is_array() && Three.size() == 4)
      Three.erase(3);
    const auto Read = shutterMoments(Three);
    if (!Read)
      fail(fmt::format("key rolling_shutter is invalid, expected start, across "
                       "and down from -{:g} to {:g}",
                       MostShutterMoment, MostShutterMoment));
    Moments = Read.value_or(Moments);
  }
  if (Frame.contains("transform_matrix_end") && !Problem) {
    const auto Way =
        wayBetween(Place, readPlace(Frame, "transform_matrix_end"));
    if (!Way) {
      fail(Way.error().What);
    } else {
      const auto &[Middle, Shutter] = *Way;
      Place = placeAt(Middle, Shutter, Moments[0]);
      if (Moments[1] != 0 || Moments[2] != 0) {
        Place = Middle;
        V.Optics.Shutter = {Moments[0], Moments[1], Moments[2], Shutter.Motion,
                            Shutter.Turn};
      }
    }
  }
  V.Pose.Position = Place.Position;
  V.Pose.Rotation = Place.Rotation;
}

void TransformsReader::readCamera(const Json &Frame, TransformsView &V) {
  const auto Read =
      readIntrinsics(Frame, Document, V.Optics.Model->CoversSphere);
  if (!Read)
    return fail(Read.error().What);
  V.Known = *Read;
  if (!find(Frame, "w") && !find(Frame, "h"))
    return;
  const auto Side = [&](const char *Key) {
    const auto Number = number(Frame, Key);
    if (!Number || !(*Number >= 1 && *Number <= MaxImageSize) ||
        *Number != std::floor(*Number)) {
      fail(fmt::format("key {} is missing or invalid, expected 1 to {} pixels",
                       Key, MaxImageSize));
      return 1;
    }
    return static_cast<int>(*Number);
  };
  V.Pose.Width = Side("w");
  V.Pose.Height = Side("h");
  complete(V.Pose, V.Known);
}

/// nerfstudio's lists: what its authors trained on and judged by.
void TransformsReader::readSplit(TransformsFile &T) {
  std::set<std::string> HeldOut;
  for (const char *Key : {"val_filenames", "test_filenames"}) {
    const auto It = Document.find(Key);
    if (It == Document.end())
      continue;
    if (!It->is_array() || !std::ranges::all_of(*It, &Json::is_string))
      return fail(
          fmt::format("key {} is invalid, expected names of pictures", Key));
    for (const Json &Name : *It)
      HeldOut.insert(withoutDot(Name.get<std::string>()));
  }
  for (TransformsView &V : T.Views)
    V.HeldOut = HeldOut.erase(V.Pose.Name) != 0;
  if (!HeldOut.empty())
    fail(fmt::format("key val_filenames or test_filenames has {}, expected "
                     "file_path of a frame",
                     printable(*HeldOut.begin())));
}

Expected<TransformsFile> TransformsReader::read() {
  if (!Document.is_object())
    return Error{Where, "not a JSON object, expected an object with frames"};
  const auto Frames = Document.find("frames");
  if (Frames == Document.end() || !Frames->is_array() || Frames->empty())
    return Error{Where,
                 "no frames, expected a list of at least one frame frame"};
  if (auto Unsupported = unsupportedIn(Document))
    fail(*Unsupported);
  TransformsFile T;
  for (const Json &Frame : *Frames) {
    View.clear();
    const auto Path = Frame.is_object() ? Frame.find("file_path") : Frame.end();
    if (!Frame.is_object() || Path == Frame.end() || !Path->is_string() ||
        Path->get<std::string>().empty()) {
      fail(fmt::format(
          "frame {} has no file_path, expected the name of a picture",
          T.Views.size()));
      break;
    }
    TransformsView V;
    V.Pose.Id = static_cast<int>(T.Views.size());
    V.Pose.Name = withoutDot(Path->get<std::string>());
    View = "frame " + printable(V.Pose.Name);
    V.Optics = readLens(Frame);
    if (const auto Mask = Frame.find("mask_path");
        Mask != Frame.end() && !Mask->is_null()) {
      if (Mask->is_string())
        V.Mask = Mask->get<std::string>();
      else
        fail("key mask_path is invalid, expected a file name");
    }
    if (auto Unsupported = unsupportedIn(Frame))
      fail(*Unsupported);
    readPose(Frame, V);
    readCamera(Frame, V);
    T.Views.push_back(std::move(V));
  }
  View.clear();
  readSplit(T);
  if (const auto It = Document.find("ply_file_path"); It != Document.end()) {
    if (It->is_string())
      T.Points = It->get<std::string>();
    else
      fail("key ply_file_path is invalid, expected a file name");
  }
  if (Problem)
    return *Problem;
  return T;
}

} // namespace

Expected<TransformsFile> parseTransforms(const std::string &Where, Bytes File) {
  const auto Document =
      parseJson<Json>(asText(File), Where, "an object with frames");
  if (!Document)
    return Document.error();
  return TransformsReader(Where, *Document).read();
}

static uint8_t colourByte(double Value) {
  return static_cast<uint8_t>(
      std::lround(255 * std::clamp(std::isnan(Value) ? 0 : Value, 0.0, 1.0)));
}

/// The colours of points, three bytes each: of bytes, words, or floats of 0 to
/// 1 (or to 255, if one is above 1), of Gaussians, or grey.
static Expected<std::vector<uint8_t>> coloursOf(const std::string &Where,
                                                const PlyFile &File,
                                                const PlyElement &Vertex) {
  constexpr uint8_t Grey = 128;
  const std::vector<std::string> Known[] = {
      {"red", "green", "blue"},
      {"diffuse_red", "diffuse_green", "diffuse_blue"},
      {"r", "g", "b"},
      {"f_dc_0", "f_dc_1", "f_dc_2"}};
  std::vector<uint8_t> Colours(3 * Vertex.Count, Grey);
  const auto Names = std::ranges::find_if(
      Known, [&](const auto &Of) { return Vertex.find(Of[0]); });
  if (Names == std::end(Known))
    return Colours;
  const auto Fill = [&](auto At) {
    for (std::size_t I = 0; I < Colours.size(); ++I)
      Colours[I] = At(File.row(Vertex, I / 3), I % 3);
    return Colours;
  };
  const PlyType Type = Vertex.find(Names->front())->Type;
  if (Type == PlyType::UChar || Type == PlyType::UShort) {
    const auto At = Vertex.offsets(Where, *Names, Type);
    if (!At)
      return At.error();
    return Fill([&](Bytes Row, std::size_t C) {
      return Type == PlyType::UChar
                 ? load<uint8_t>(Row, (*At)[C])
                 : colourByte(load<uint16_t>(Row, (*At)[C]) / 65535.0);
    });
  }
  const auto At = Vertex.reals(Where, *Names);
  if (!At)
    return At.error();
  if (Names->front() == "f_dc_0")
    return Fill([&](Bytes Row, std::size_t C) {
      return colourByte(0.5 + ShC0 * loadReal(Row, (*At)[C]));
    });
  double Most = 0;
  Fill([&](Bytes Row, std::size_t C) {
    Most = std::max(Most, loadReal(Row, (*At)[C]));
    return Grey;
  });
  const double Unit = Most > 1 ? 255 : 1;
  return Fill([&](Bytes Row, std::size_t C) {
    return colourByte(loadReal(Row, (*At)[C]) / Unit);
  });
}

Expected<CapturePoints> parsePointCloud(const std::string &Where, Bytes File) {
  const auto Read = readPly(Where, File);
  if (!Read)
    return Read.error();
  const PlyElement *Vertex = Read->header().find("vertex");
  if (!Vertex || Vertex->HasLists)
    return Error{
        Where, "no element vertex with scalar properties, expected the points"};
  const auto Position = Vertex->reals(Where, {"x", "y", "z"});
  if (!Position)
    return Position.error();
  auto Colours = coloursOf(Where, *Read, *Vertex);
  if (!Colours)
    return Colours.error();
  CapturePoints P;
  P.Colours = std::move(*Colours);
  for (std::size_t I = 0; I < Vertex->Count; ++I) {
    const Bytes Row = Read->row(*Vertex, I);
    for (const PlyReal At : *Position)
      if (!std::isfinite(
              static_cast<float>(P.Positions.emplace_back(loadReal(Row, At)))))
        return Error{Where, fmt::format("point {} has a NaN or an infinity, "
                                        "expected finite coordinates",
                                        I)};
  }
  return P;
}

} // namespace vorion::splat
