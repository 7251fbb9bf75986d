#include "capture/ColmapRecords.h"

#include "vorion/support/Letters.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <optional>

namespace vorion::splat {
namespace {

/// The lines of a file with their numbers.
class LineReader {
public:
  explicit LineReader(const ColmapFile &F)
      : Where(F.Where), Rest(asText(F.Content)) {
    // Some editors mark UTF-8.
    if (constexpr std::string_view Mark = "\xef\xbb\xbf";
        Rest.starts_with(Mark))
      Rest.remove_prefix(Mark.size());
  }

  /// The next line without the white space around it, as COLMAP has it, or
  /// nothing at the end.
  std::optional<std::string_view> next() {
    if (Rest.empty())
      return std::nullopt;
    ++Number;
    const std::size_t End = std::min(Rest.find('\n'), Rest.size());
    const std::string_view Line = Rest.substr(0, End);
    Rest.remove_prefix(std::min(End + 1, Rest.size()));
    return trimmed(Line, " \t\r\v\f");
  }
  /// The next one that is neither empty nor a comment.
  std::optional<std::string_view> nextRecord() {
    while (auto Line = next())
      if (!Line->empty() && Line->front() != '#')
        return Line;
    return std::nullopt;
  }
  std::string where() const { return fmt::format("{}:{}", Where, Number); }

private:
  const std::string &Where;
  std::string_view Rest;
  std::size_t Number = 0;
};

/// The words of a line, with what is wrong remembered.
class Words {
public:
  explicit Words(std::string_view Line) : Rest(Line) {}

  std::string_view next() {
    Rest.remove_prefix(std::min(Rest.find_first_not_of(" \t"), Rest.size()));
    const std::string_view Word =
        Rest.substr(0, std::min(Rest.find_first_of(" \t"), Rest.size()));
    Rest.remove_prefix(Word.size());
    return Word;
  }
  template <typename T> T number() {
    const std::string_view Word = next();
    T Value{};
    const auto [End, Status] =
        std::from_chars(Word.data(), Word.data() + Word.size(), Value);
    Good = Good && Status == std::errc() && End == Word.data() + Word.size() &&
           !Word.empty();
    return Value;
  }
  template <std::size_t N> std::array<double, N> numbers() {
    std::array<double, N> Values{};
    for (double &V : Values)
      V = number<double>();
    return Values;
  }
  /// What is left, which may have blanks in it.
  std::string_view rest() {
    Rest.remove_prefix(std::min(Rest.find_first_not_of(" \t"), Rest.size()));
    return Rest;
  }
  bool good() const { return Good; }

private:
  std::string_view Rest;
  bool Good = true;
};

Error badLine(const LineReader &R, std::string_view Wanted) {
  return Error{R.where(), fmt::format("malformed line, expected {}", Wanted)};
}

Expected<Success> readCameraLines(const ColmapFile &F, ColmapBuilder &B) {
  LineReader R(F);
  while (const auto Line = R.nextRecord()) {
    Words W(*Line);
    const auto Id = W.number<int64_t>();
    const std::string_view Name = W.next();
    const auto Models = colmapCameraModels();
    const auto Model =
        std::ranges::find(Models, Name, &ColmapCameraModel::Name);
    if (!W.good() || Name.empty())
      return badLine(R, "CAMERA_ID MODEL WIDTH HEIGHT PARAMETERS");
    if (Model == Models.end())
      return Error{R.where(),
                   fmt::format("camera {} has model {}, expected one of {}", Id,
                               printable(Name), knownColmapModels())};
    if (auto Pinhole = ColmapBuilder::checkModel(R.where(), Id, *Model);
        !Pinhole)
      return Pinhole;
    const auto Size = W.numbers<2>();
    std::vector<double> Parameters(Model->parameters());
    for (double &P : Parameters)
      P = W.number<double>();
    if (!W.good() || !W.rest().empty())
      return badLine(R, fmt::format("CAMERA_ID {} WIDTH HEIGHT and {} "
                                    "parameters",
                                    Name, Model->parameters()));
    if (auto Added =
            B.addCamera(R.where(), Id, *Model, Size[0], Size[1], Parameters);
        !Added)
      return Added;
  }
  return Success{};
}

/// The line behind an image's, which says where it sees points. It is there if
/// there are none, too: else every second image would be taken for it.
Expected<Success> checkSights(LineReader &R) {
  const auto Line = R.next();
  Words W(Line.value_or(""));
  while (W.good() && !W.rest().empty()) {
    W.numbers<2>();
    W.number<int64_t>(); // -1: of no point
  }
  return W.good() ? Expected<Success>(Success{})
                  : badLine(R, "X Y POINT3D_ID for each point observed by the "
                               "image above, or an empty line");
}

Expected<Success> readImageLines(const ColmapFile &F, ColmapBuilder &B) {
  LineReader R(F);
  while (const auto Line = R.nextRecord()) {
    Words W(*Line);
    ColmapImage I;
    I.Id = W.number<int64_t>();
    I.Quaternion = W.numbers<4>();
    I.Translation = W.numbers<3>();
    I.Camera = W.number<int64_t>();
    I.Name = W.rest();
    if (!W.good() || I.Name.empty())
      return badLine(R, "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME");
    if (auto Added = B.addImage(R.where(), I); !Added)
      return Added;
    if (auto Sees = checkSights(R); !Sees)
      return Sees;
  }
  return Success{};
}

Expected<Success> readPointLines(const ColmapFile &F, ColmapBuilder &B) {
  LineReader R(F);
  while (const auto Line = R.nextRecord()) {
    Words W(*Line);
    W.number<uint64_t>(); // its own number
    const auto Position = W.numbers<3>();
    std::array<uint8_t, 3> Colour{};
    for (uint8_t &C : Colour)
      C = W.number<uint8_t>();
    W.next(); // reprojection error
    // The images that see it, and which of their points.
    std::vector<int64_t> Track;
    while (W.good() && !W.rest().empty()) {
      Track.push_back(W.number<int64_t>());
      W.number<int64_t>();
    }
    if (!W.good())
      return badLine(R, "POINT3D_ID X Y Z R G B ERROR and a track of pairs "
                        "IMAGE_ID POINT2D_IDX");
    if (auto Added = B.addPoint(R.where(), Position, Colour, Track); !Added)
      return Added;
  }
  return Success{};
}

} // namespace

Expected<ColmapModel> parseColmapText(const ColmapFiles &Files) {
  ColmapBuilder Builder;
  if (auto Read = readCameraLines(Files.Cameras, Builder); !Read)
    return Read.error();
  if (auto Read = readImageLines(Files.Images, Builder); !Read)
    return Read.error();
  if (!Files.PosesOnly)
    if (auto Read = readPointLines(Files.Points, Builder); !Read)
      return Read.error();
  return Builder.finish(Files);
}

} // namespace vorion::splat
