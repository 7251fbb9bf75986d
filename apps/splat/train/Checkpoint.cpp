#include "Checkpoint.h"

#include "../io/Bytes.h"
#include "../io/Hash.h"
#include "../render/Layout.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"

#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {
namespace {

using Json = nlohmann::json;

/// The first line is "Magic VERSION HASH", the hash of all that follows: a
/// line of JSON with the sizes, then the arrays.
constexpr std::string_view Magic = "vorion-checkpoint";
constexpr int Version = 2;

/// Calls \p Visit with every array of \p C, in the file's order.
template <typename Kind, typename Function>
void forArrays(Kind &C, Function Visit) {
  Visit(C.Geometry);
  Visit(C.Sh);
  Visit(C.FirstGeometry);
  Visit(C.FirstSh);
  Visit(C.SecondGeometry);
  Visit(C.SecondSh);
  Visit(C.Identities);
  Visit(C.Notes.GradientSums);
  Visit(C.Notes.Views);
  Visit(C.Notes.Radii);
  Visit(C.Losses);
}

/// Makes room in \p C for what its sizes say.
void resize(Checkpoint &C, std::size_t Gaussians) {
  const std::size_t Geometry = GEOMETRY_PLANES * Gaussians;
  const std::size_t Sh = 3 * shCoefficients(C.ShDegree) * Gaussians;
  for (auto *A : {&C.Geometry, &C.FirstGeometry, &C.SecondGeometry})
    A->resize(Geometry);
  for (auto *A : {&C.Sh, &C.FirstSh, &C.SecondSh})
    A->resize(Sh);
  C.Identities.resize(Gaussians);
  C.Notes.GradientSums.resize(Gaussians);
  C.Notes.Views.resize(Gaussians);
  C.Notes.Radii.resize(Gaussians);
  C.Losses.resize(C.Iteration);
}

Error damaged(const std::string &Path) {
  return {Path, "damaged checkpoint, expected the bytes that were written"};
}

} // namespace

Expected<Success> writeCheckpoint(const std::string &Path,
                                  const Checkpoint &C) {
  const Json Header{{"run", C.Run},
                    {"iteration", C.Iteration},
                    {"sh_degree", C.ShDegree},
                    {"gaussians", C.gaussians()}};
  std::string Body = jsonText(Header) + "\n";
  forArrays(C, [&](const auto &A) {
    Body.append(reinterpret_cast<const char *>(A.data()), 4 * A.size());
  });
  return writeFileAtomically(
      Path, fmt::format("{} {} {}\n", Magic, Version, fnv1a64(Body)) + Body);
}

Expected<Checkpoint> readCheckpoint(const std::string &Path) {
  const auto File = readFile(Path);
  if (!File)
    return File.error();
  std::string_view Text = asText(*File);
  if (!Text.starts_with(Magic))
    return Error{Path, "not a checkpoint, expected one of splat train"};
  const auto Line = [&Text] {
    const std::size_t End = std::min(Text.find('\n'), Text.size());
    const std::string_view L = Text.substr(0, End);
    Text.remove_prefix(std::min(End + 1, Text.size()));
    return L;
  };
  const std::string_view First = Line();
  if (!First.starts_with(fmt::format("{} {} ", Magic, Version)))
    return Error{Path, fmt::format("{}: another version of checkpoints, "
                                   "expected {}",
                                   printable(First), Version)};
  if (First != fmt::format("{} {} {}", Magic, Version, fnv1a64(Text)))
    return damaged(Path);
  const std::string_view HeaderText = Line();
  const auto Read = parseJson<Json>(HeaderText, Path, "a checkpoint's sizes");
  if (!Read)
    return Read.error();
  const Json &Header = *Read;
  // The hash says that these bytes were written, not that we wrote them.
  const JsonShape Shape =
      JsonShape::object({{"run", JsonShape::text()},
                         {"iteration", JsonShape::whole(0, Text.size())},
                         {"sh_degree", JsonShape::whole(0, MaxShDegree)},
                         {"gaussians", JsonShape::whole(0, Text.size())}});
  if (auto Ok = Shape.check(Header, Path); !Ok)
    return Ok.error();
  Checkpoint C;
  C.Run = Header["run"].get<std::string>();
  C.Iteration = Header["iteration"].get<unsigned>();
  C.ShDegree = Header["sh_degree"].get<int>();
  const auto Gaussians = Header["gaussians"].get<std::size_t>();
  resize(C, Gaussians);
  std::size_t Size = 0;
  forArrays(C, [&](const auto &A) { Size += 4 * A.size(); });
  if (Size != Text.size())
    return damaged(Path);
  std::size_t At = File->size() - Size;
  forArrays(C, [&](auto &A) {
    std::memcpy(A.data(), File->data() + At, 4 * A.size());
    At += 4 * A.size();
  });
  return C;
}

} // namespace vorion::splat
