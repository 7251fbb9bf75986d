#include "train/run/Checkpoint.h"

#include "io/Bytes.h"
#include "io/Hash.h"
#include "picture/Layout.h"
#include "vorion/support/File.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace vorion::splat {
namespace {

using Json = nlohmann::json;

/// The first line is "Magic VERSION HASH", the hash of all that follows: a
/// line of JSON with the sizes, then the arrays.
constexpr std::string_view Magic = "vorion-checkpoint";
constexpr int Version = 2;

/// How long the arrays are.
struct Sizes {
  std::size_t Gaussians = 0;
  int ShDegree = 0;
  std::size_t Losses = 0;
  std::size_t Exposures = 0, Poses = 0; ///< floats

  std::size_t geometry() const { return GEOMETRY_PLANES * Gaussians; }
  std::size_t sh() const { return 3 * shCoefficients(ShDegree) * Gaussians; }
};

/// Calls \p Visit with every array of \p C, in the file's order, with its name
/// and with its length by \p S.
template <typename Kind, typename Function>
void forArrays(Kind &C, const Sizes &S, Function Visit) {
  Visit(C.Geometry, "geometry", S.geometry());
  Visit(C.Sh, "colours", S.sh());
  Visit(C.FirstGeometry, "geometry's first moments", S.geometry());
  Visit(C.FirstSh, "colours' first moments", S.sh());
  Visit(C.SecondGeometry, "geometry's second moments", S.geometry());
  Visit(C.SecondSh, "colours' second moments", S.sh());
  Visit(C.Identities, "identities", S.Gaussians);
  Visit(C.Notes.GradientSums, "sums of gradients", S.Gaussians);
  Visit(C.Notes.Views, "counts of views", S.Gaussians);
  Visit(C.Notes.Radii, "radii", S.Gaussians);
  Visit(C.Losses, "losses", S.Losses);
  Visit(C.Exposures, "exposures", S.Exposures);
  Visit(C.Poses, "poses", S.Poses);
}

Sizes sizesOf(const Checkpoint &C) {
  return {C.gaussians(), C.ShDegree, C.Losses.size(), C.Exposures.size(),
          C.Poses.size()};
}

/// The first value of a run that is no finite number: nothing can be trained
/// from it, and nothing that comes of it can be told from a result.
Expected<Success> checkFinite(const std::string &Path, const Checkpoint &C) {
  Expected<Success> Found = Success{};
  forArrays(C, sizesOf(C),
            [&]<typename Value>(const std::vector<Value> &A, const char *Name,
                                std::size_t /*Size*/) {
              if constexpr (std::is_floating_point_v<Value>) {
                const auto Bad = std::ranges::find_if_not(
                    A, [](float V) { return std::isfinite(V); });
                if (Found && Bad != A.end())
                  Found = Error{Path, fmt::format("{} after iteration {}: "
                                                  "value {} is {}, expected "
                                                  "finite numbers",
                                                  Name, C.Iteration,
                                                  Bad - A.begin(), *Bad)};
              }
            });
  return Found;
}

/// The second line of a file.
struct Header {
  std::string Run;
  Sizes Lengths;
};

/// Refused: what is no such line, with its reason.
Expected<Header> readHeader(std::string_view Text, const std::string &Path) {
  // writeCheckpoint()'s is a twentieth of that.
  JsonLimits Limits;
  Limits.Bytes = std::size_t{1} << 16;
  const auto Read = parseJson<Json>(Text, Path, "a checkpoint's sizes", Limits);
  if (!Read)
    return Read.error();
  // Sums of these sizes do not overflow.
  constexpr uint64_t Most = std::numeric_limits<uint32_t>::max();
  const JsonShape Shape =
      JsonShape::object({{"run", JsonShape::text()},
                         {"iteration", JsonShape::whole(0, Most)},
                         {"sh_degree", JsonShape::whole(0, MaxShDegree)},
                         {"gaussians", JsonShape::whole(0, Most)}});
  if (auto Ok = Shape.check(*Read, Path); !Ok)
    return Ok.error();
  std::size_t Exposures = 0, Poses = 0;
  for (const auto &[Name, To] :
       {std::pair("exposures", &Exposures), {"poses", &Poses}})
    if (Read->contains(Name)) {
      if (auto Ok = JsonShape::object({{Name, JsonShape::whole(0, Most)}})
                        .check(*Read, Path);
          !Ok)
        return Ok.error();
      *To = (*Read)[Name].get<std::size_t>();
    }
  return Header{(*Read)["run"].get<std::string>(),
                {(*Read)["gaussians"].get<std::size_t>(),
                 (*Read)["sh_degree"].get<int>(),
                 (*Read)["iteration"].get<std::size_t>(), Exposures, Poses}};
}

Error damaged(const std::string &Path) {
  return {Path, "damaged checkpoint: its hash does not match, expected an "
                "unmodified file"};
}

} // namespace

Expected<Success> writeCheckpoint(const std::string &Path,
                                  const Checkpoint &C) {
  if (auto Checked = checkFinite(Path, C); !Checked)
    return Error{Path, fmt::format("not written: {}", Checked.error().What),
                 ExitCode::GuestFailed};
  Json Header{{"run", C.Run},
              {"iteration", C.Iteration},
              {"sh_degree", C.ShDegree},
              {"gaussians", C.gaussians()}};
  if (!C.Exposures.empty())
    Header["exposures"] = C.Exposures.size();
  if (!C.Poses.empty())
    Header["poses"] = C.Poses.size();
  std::string Body = jsonText(Header) + "\n";
  forArrays(C, sizesOf(C), [&](const auto &A, const char *, std::size_t) {
    Body.append(reinterpret_cast<const char *>(A.data()), 4 * A.size());
  });
  return writeFileAtomically(
      Path, fmt::format("{} {} {}\n", Magic, Version, fnv1a64(Body)) + Body);
}

Expected<Checkpoint> readCheckpoint(const std::string &Path) {
  const auto File = readFile(Path);
  return File ? parseCheckpoint(Path, *File) : File.error();
}

Expected<Checkpoint> parseCheckpoint(const std::string &Path, Bytes File) {
  std::string_view Text = asText(File);
  if (!Text.starts_with(Magic))
    return otherKind(Path, File, "a checkpoint of splat train",
                     "not a checkpoint");
  const auto Line = [&Text] {
    const std::size_t End = std::min(Text.find('\n'), Text.size());
    const std::string_view L = Text.substr(0, End);
    Text.remove_prefix(std::min(End + 1, Text.size()));
    return L;
  };
  const std::string_view First = Line();
  if (!First.starts_with(fmt::format("{} {} ", Magic, Version)))
    return Error{Path,
                 fmt::format("{}: unsupported checkpoint version, expected {}",
                             printable(First), Version)};
  if (First != fmt::format("{} {} {}", Magic, Version, fnv1a64(Text)))
    return damaged(Path);
  const std::string_view HeaderText = Line();
  const auto Header = readHeader(HeaderText, Path);
  if (!Header)
    return Header.error();
  // Nothing is allocated before the file is known to have it.
  Checkpoint C;
  std::size_t Words = 0;
  forArrays(
      C, Header->Lengths,
      [&](const auto &, const char *, std::size_t Size) { Words += Size; });
  if (4 * Words != Text.size())
    return damaged(Path);
  C.Run = Header->Run;
  C.Iteration = static_cast<unsigned>(Header->Lengths.Losses);
  C.ShDegree = Header->Lengths.ShDegree;
  const char *From = Text.data();
  forArrays(C, Header->Lengths, [&](auto &A, const char *, std::size_t Size) {
    A.resize(Size);
    std::copy_n(From, 4 * Size, reinterpret_cast<char *>(A.data()));
    From += 4 * Size;
  });
  if (auto Checked = checkFinite(Path, C); !Checked)
    return Checked.error();
  return C;
}

} // namespace vorion::splat
