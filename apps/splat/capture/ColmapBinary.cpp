#include "capture/ColmapRecords.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace vorion::splat {
namespace {

/// Takes values off the front; what is beyond the end is 0 and remembered.
class ByteReader {
public:
  explicit ByteReader(const ColmapFile &F) : Where(F.Where), Rest(F.Content) {}

  template <typename T> T take() {
    if (Rest.size() < sizeof(T)) {
      Short = true;
      return {};
    }
    const T Value = load<T>(Rest, 0);
    Rest = Rest.subspan(sizeof(T));
    return Value;
  }
  template <typename T, std::size_t N> std::array<T, N> takeArray() {
    std::array<T, N> Values{};
    for (T &V : Values)
      V = take<T>();
    return Values;
  }
  std::string takeName() {
    const std::string_view Text = asText(Rest);
    const std::size_t End = Text.find('\0');
    if (End == std::string_view::npos) {
      Short = true;
      return {};
    }
    Rest = Rest.subspan(End + 1);
    return std::string(Text.substr(0, End));
  }
  /// Skips \p Count records of \p Each bytes.
  void skip(uint64_t Count, std::size_t Each) {
    if (Count > Rest.size() / Each) {
      Short = true;
      return;
    }
    Rest = Rest.subspan(static_cast<std::size_t>(Count) * Each);
  }

  bool good() const { return !Short; }
  /// That the file went on to the end of the record, of \p Count of a kind.
  std::optional<Error> shortOf(std::string_view Kind, uint64_t Index,
                               uint64_t Count) const {
    if (!Short)
      return std::nullopt;
    return Error{
        Where,
        fmt::format("truncated: the file ends in {} {}, expected {} of them",
                    Kind, Index, Count)};
  }
  std::optional<Error> leftOver() const {
    if (Rest.empty())
      return std::nullopt;
    return Error{
        Where,
        fmt::format("{} after the last record, expected the end of the file",
                    counted(Rest.size(), "byte"))};
  }

private:
  const std::string &Where;
  Bytes Rest;
  bool Short = false;
};

/// Reads a count and so many records with \p One, which gives an Error or not.
template <typename Function>
std::optional<Error> readRecords(const ColmapFile &F, std::string_view Kind,
                                 Function One) {
  ByteReader R(F);
  const auto Count = R.take<uint64_t>();
  if (auto Short = R.shortOf("the number of", 0, Count))
    return Error{F.Where, fmt::format("{} bytes, expected the number of {}s "
                                      "first",
                                      F.Content.size(), Kind)};
  for (uint64_t I = 0; I < Count; ++I)
    if (auto Bad = One(R, I, Count))
      return Bad;
  return R.leftOver();
}

/// The same, but of a file of another kind the error says which. COLMAP's files
/// have no mark, and may begin as another kind does: a count of 26,443 is the
/// mark of a .splatv. So what can be read is never asked.
template <typename Function>
std::optional<Error> eachRecord(const ColmapFile &F, std::string_view Kind,
                                Function One) {
  auto Bad = readRecords(F, Kind, One);
  if (!Bad)
    return std::nullopt;
  switch (fileKindOf(F.Content)) {
  case FileKind::Unknown:
  case FileKind::Empty:
  case FileKind::ColmapCameras:
  case FileKind::ColmapImages:
  case FileKind::ColmapPoints:
    return Bad;
  default:
    return otherKind(F.Where, F.Content,
                     fmt::format("the {}s of COLMAP in binary", Kind), "");
  }
}

template <typename T> std::optional<Error> errorOf(const Expected<T> &E) {
  if (E)
    return std::nullopt;
  return E.error();
}

} // namespace

Expected<ColmapModel> parseColmapBinary(const ColmapFiles &Files) {
  ColmapBuilder Builder;
  auto Failed = eachRecord(
      Files.Cameras, "camera",
      [&](ByteReader &R, uint64_t I, uint64_t Count) -> std::optional<Error> {
        const auto Id = R.take<int32_t>();
        const auto Model = R.take<int32_t>();
        const auto Width = R.take<uint64_t>();
        const auto Height = R.take<uint64_t>();
        if (auto Short = R.shortOf("camera", I, Count))
          return Short;
        const auto Models = colmapCameraModels();
        const auto Known =
            std::ranges::find(Models, Model, &ColmapCameraModel::Id);
        if (Known == Models.end())
          return Error{Files.Cameras.Where,
                       fmt::format("camera {} has model number {}, expected "
                                   "the number of one of {}",
                                   Id, Model, knownColmapModels())};
        if (auto Bad =
                errorOf(Builder.checkModel(Files.Cameras.Where, Id, *Known)))
          return Bad;
        std::vector<double> Parameters(Known->parameters());
        for (double &P : Parameters)
          P = R.take<double>();
        if (auto Short = R.shortOf("camera", I, Count))
          return Short;
        return errorOf(Builder.addCamera(
            Files.Cameras.Where, Id, *Known, static_cast<double>(Width),
            static_cast<double>(Height), Parameters));
      });
  if (!Failed)
    Failed = eachRecord(
        Files.Images, "image",
        [&](ByteReader &R, uint64_t I, uint64_t Count) -> std::optional<Error> {
          ColmapImage Image;
          Image.Id = R.take<int32_t>();
          Image.Quaternion = R.takeArray<double, 4>();
          Image.Translation = R.takeArray<double, 3>();
          Image.Camera = R.take<int32_t>();
          Image.Name = R.takeName();
          // Where it sees points: x, y and the point's number.
          R.skip(R.take<uint64_t>(), 24);
          if (auto Short = R.shortOf("image", I, Count))
            return Short;
          return errorOf(Builder.addImage(Files.Images.Where, Image));
        });
  if (!Failed && !Files.PosesOnly)
    Failed = eachRecord(
        Files.Points, "point",
        [&](ByteReader &R, uint64_t I, uint64_t Count) -> std::optional<Error> {
          R.take<uint64_t>(); // its own number
          const auto Position = R.takeArray<double, 3>();
          const auto Colour = R.takeArray<uint8_t, 3>();
          R.take<double>(); // reprojection error
          // The images that see it, and which of their points.
          std::vector<int64_t> Track;
          for (auto Left = R.take<uint64_t>(); Left != 0 && R.good(); --Left) {
            Track.push_back(R.take<int32_t>());
            R.take<int32_t>();
          }
          if (auto Short = R.shortOf("point", I, Count))
            return Short;
          return errorOf(
              Builder.addPoint(Files.Points.Where, Position, Colour, Track));
        });
  if (Failed)
    return *Failed;
  return Builder.finish(Files);
}

} // namespace vorion::splat
