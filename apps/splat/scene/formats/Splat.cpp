// `.splat`: 32 bytes a Gaussian and nothing else.
// https://github.com/antimatter15/splat
//
// Records of three floats of position, three of scale (not its
// logarithm), four bytes r, g, b, opacity, and four bytes of a quaternion w,
// x, y, z, where 128 is zero. Degree 0. The format has no mark by which to
// know it, so positions and scales beyond 1e9 and negative scales, which no
// scene has but other files soon do, are errors. So are files of which most
// rotations are not 1 long, and whatever ForeignFile.h knows. Rotations of
// spheres have no effect, and converters of point clouds write 255, 0, 0, 0. A
// scale of zero becomes the smallest normal float, whose logarithm is finite.
#include "scene/ForeignFile.h"
#include "scene/SceneFile.h"
#include "scene/formats/Dequantize.h"
#include "scene/formats/Formats.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace vorion::splat {
namespace {

constexpr std::size_t RecordSize = 32;
constexpr float Plausible = 1e9F;

/// Whether a rotation has the length that every writer gives it, or is zero.
/// Rounding or cutting moves each of its four parts by up to 1/128, and so the
/// length by up to 2/128. A file's rotations of the real scenes at hand are
/// all from 0.986 to 1.015 long, and one in eight of random bytes is from 0.95
/// to 1.05.
bool isUnit(const float *Quat) {
  double Square = 0;
  for (std::size_t K = 0; K < 4; ++K)
    Square += double{Quat[K]} * double{Quat[K]};
  return Square == 0 || std::abs(std::sqrt(Square) - 1) <= 0.05;
}

/// Whether the scales of \p Record are equal and not zero.
bool isSphere(Bytes Record) {
  const auto First = load<float>(Record, 12);
  return First > 0 && First == load<float>(Record, 16) &&
         First == load<float>(Record, 20);
}

} // namespace

bool isSplat(Bytes /*File*/) { return false; }

Expected<SceneFile> parseSplat(const std::string &Where, Bytes File,
                               const ReadOptions &Options) {
  if (const std::size_t Left = File.size() % RecordSize; Left != 0)
    return Where.ends_with(".splat")
               ? Error{Where,
                       fmt::format(
                           "{} bytes, {} after the last complete Gaussian, "
                           "expected a .splat of {} bytes per Gaussian",
                           File.size(), Left, RecordSize)}
               : unknownFile(Where);
  const std::size_t Count = File.size() / RecordSize;
  SceneFile Result;
  Result.Format = SceneFormat::Splat;
  Scene &S = Result.Gaussians = Scene::sized(Count, 0);
  const auto &Logits = byteOpacityLogits();
  std::size_t Units = 0;
  for (std::size_t I = 0; I < Count; ++I) {
    const Bytes Record = File.subspan(I * RecordSize, RecordSize);
    for (std::size_t A = 0; A < 3; ++A) {
      const auto Position = load<float>(Record, 4 * A);
      const auto Scale = load<float>(Record, 12 + 4 * A);
      const bool Dropped = Options.DropNonFinite &&
                           (!std::isfinite(Position) || !std::isfinite(Scale));
      // Written so that a NaN fails too.
      if (!Dropped && (!(std::abs(Position) <= Plausible) ||
                       !(Scale >= 0 && Scale <= Plausible)))
        return Error{Where,
                     fmt::format("record {} has position {} and scale {} on "
                                 "axis {}, expected a .splat file (numbers "
                                 "up to 1e9, scales not negative)",
                                 I, Position, Scale, A)};
      S.Means[3 * I + A] = Position;
      S.LogScales[3 * I + A] =
          Dropped
              ? std::numeric_limits<float>::quiet_NaN()
              : std::log(std::max(Scale, std::numeric_limits<float>::min()));
      S.Sh[3 * I + A] = shOfColor(byteAt(Record, 24 + A) / 255.0);
    }
    S.OpacityLogits[I] = Logits[byteAt(Record, 27)];
    for (std::size_t K = 0; K < 4; ++K)
      S.Quats[4 * I + K] =
          (static_cast<float>(byteAt(Record, 28 + K)) - 128) / 128;
    Units += isUnit(&S.Quats[4 * I]) || isSphere(Record);
  }
  // Other files of numbers get here, too.
  if (2 * Units < Count)
    return Error{
        Where,
        fmt::format("{} of {} records have a rotation that is not normalized, "
                    "expected a .splat file, where these are rare",
                    Count - Units, Count)};
  return Result;
}

} // namespace vorion::splat
