// Niantic's `.spz`, versions 2 to 4.
// https://github.com/nianticlabs/spz
//
// A 16-byte header and one array for each parameter: positions of 24-bit fixed
// point, opacities, colours, log scales in sixteenths, rotations (version 2: 8
// bits for each of x, y, z; from version 3 on: the three smallest components,
// 10 bits each), harmonics of 8 bits. Versions 2 and 3 are one gzip stream (or
// what is in one). Version 4 is 16 bytes more of header, which say where a
// table of the arrays is, and a zstd frame for each of them; what lies between
// header and table are extensions, which are skipped. Refused: version 1,
// degree 4, extensions of versions 2 and 3.
#include "io/Gzip.h"
#include "io/Zstd.h"
#include "scene/formats/Dequantize.h"
#include "scene/formats/Formats.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/Letters.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <numeric>
#include <vector>

namespace vorion::splat {
namespace {

constexpr uint32_t Magic = 0x5053474e; // "NGSP"
constexpr std::size_t HeaderSize = 16;
constexpr std::size_t HeaderSize4 = 32; // of version 4
constexpr unsigned AntialiasedFlag = 1, ExtensionsFlag = 2;
/// Steps of a colour byte for each unit of the constant coefficient: wider
/// than a colour from 0 to 1 needs, as the other coefficients may bring it
/// back into range.
constexpr double ColorScale = 0.15;

struct Header {
  int Version = 0;
  std::size_t Count = 0;
  int ShDegree = 0;
  int FractionalBits = 0;
  bool Antialiased = false;

  std::size_t rotationSize() const { return Version == 2 ? 3 : 4; }
  std::size_t laterHarmonics() const {
    return 3 * (shCoefficients(ShDegree) - 1);
  }
  /// Bytes of a Gaussian in each of the arrays.
  std::array<std::size_t, 6> sizes() const {
    return {9, 1, 3, 3, rotationSize(), laterHarmonics()};
  }
  /// Bytes of a Gaussian.
  std::size_t each() const {
    const auto Sizes = sizes();
    return std::accumulate(Sizes.begin(), Sizes.end(), std::size_t(0));
  }
  /// Of all Gaussians; a count of 32 bits times that fits.
  std::size_t bodySize() const { return Count * each(); }
};

/// Of the first bytes of \p File, whatever follows them.
Expected<Header> readHeader(const std::string &Where, Bytes File) {
  if (File.size() < HeaderSize || load<uint32_t>(File, 0) != Magic)
    return Error{Where, "not an SPZ file, expected `NGSP` and a header of 16 "
                        "bytes"};
  const auto Version = load<uint32_t>(File, 4);
  if (Version < 2 || Version > 4)
    return Error{Where, fmt::format("SPZ version {}, expected 2 to 4; export "
                                    "the scene as one of those, or as .ply",
                                    Version)};
  Header H;
  H.Version = static_cast<int>(Version);
  H.Count = load<uint32_t>(File, 8);
  H.ShDegree = static_cast<int>(byteAt(File, 12));
  H.FractionalBits = static_cast<int>(byteAt(File, 13));
  const unsigned Flags = byteAt(File, 14);
  H.Antialiased = (Flags & AntialiasedFlag) != 0;
  if (H.ShDegree > MaxStoredShDegree)
    return Error{Where, fmt::format("SH degree {}, expected 0 to {}",
                                    H.ShDegree, MaxStoredShDegree)};
  if (H.FractionalBits > 24)
    return Error{Where, fmt::format("{} fractional bits of 24-bit positions, "
                                    "expected 0 to 24",
                                    H.FractionalBits)};
  // Where versions 2 and 3 have their extensions depends on the writer. Version
  // 4 has the number of its arrays where they have a reserved byte.
  const unsigned Known = AntialiasedFlag | (Version == 4 ? ExtensionsFlag : 0);
  if ((Flags & ~Known) != 0 || (Version < 4 && byteAt(File, 15) != 0))
    return Error{Where, fmt::format("flags {:#04x} and reserved byte {:#04x}, "
                                    "expected only flag {:#04x}",
                                    Flags, byteAt(File, 15), Known)};
  return H;
}

Error wrongSize(const std::string &Where, const Header &H, std::size_t Body) {
  return {Where, fmt::format("{} bytes after the header, expected {} Gaussians "
                             "of {} bytes",
                             Body, H.Count, H.each())};
}

/// A little-endian signed number of 24 bits.
int32_t signed24(Bytes B, std::size_t At) {
  const uint32_t Word =
      byteAt(B, At) | byteAt(B, At + 1) << 8 | byteAt(B, At + 2) << 16;
  return static_cast<int32_t>(Word ^ 0x800000) - 0x800000;
}

/// x, y, z from a byte each; w is the positive root. Gives w, x, y, z.
std::array<double, 4> unpackQuat2(Bytes B, std::size_t At) {
  return completeQuat(0,
                      {byteAt(B, At) / 127.5 - 1, byteAt(B, At + 1) / 127.5 - 1,
                       byteAt(B, At + 2) / 127.5 - 1});
}

/// Two bits for which of x, y, z, w is missing, then the others in that order:
/// a sign and nine bits of magnitude up to 1/sqrt(2). Gives w, x, y, z.
std::array<double, 4> unpackQuat3(Bytes B, std::size_t At) {
  const auto Word = load<uint32_t>(B, At);
  std::array<double, 3> Others{};
  for (int I = 0; I < 3; ++I) {
    const uint32_t Field = Word >> (20 - 10 * I);
    const double Magnitude = unorm(Field, 9) / std::numbers::sqrt2;
    Others[static_cast<std::size_t>(I)] =
        (Field & 0x200) != 0 ? -Magnitude : Magnitude;
  }
  const auto Xyzw = completeQuat(Word >> 30, Others);
  return {Xyzw[3], Xyzw[0], Xyzw[1], Xyzw[2]};
}

/// \p Rest has as many bytes as \p H says.
SceneFile decode(const Header &H, Bytes Rest) {
  SceneFile Result;
  Result.Format = SceneFormat::Spz;
  Result.Version = H.Version;
  if (H.Antialiased)
    Result.DrawnAs = {true, std::nullopt, "flag 0x01 of the SPZ header"};
  const std::size_t Count = H.Count;
  Scene &S = Result.Gaussians = Scene::sized(Count, H.ShDegree);

  const auto Take = [&Rest](std::size_t Size) {
    const Bytes Array = Rest.first(Size);
    Rest = Rest.subspan(Size);
    return Array;
  };
  const Bytes Positions = Take(9 * Count), Opacities = Take(Count),
              Colors = Take(3 * Count), Scales = Take(3 * Count),
              Rotations = Take(H.rotationSize() * Count),
              Harmonics = Take(H.laterHarmonics() * Count);
  const double Step = std::ldexp(1.0, -H.FractionalBits);
  for (std::size_t I = 0; I < 3 * Count; ++I) {
    S.Means[I] = static_cast<float>(signed24(Positions, 3 * I) * Step);
    S.LogScales[I] = static_cast<float>(byteAt(Scales, I)) / 16 - 10;
  }
  const auto &Logits = byteOpacityLogits();
  const std::size_t Later = H.laterHarmonics(), ShEach = Later + 3;
  for (std::size_t I = 0; I < Count; ++I) {
    S.OpacityLogits[I] = Logits[byteAt(Opacities, I)];
    const auto Quat = H.Version == 2 ? unpackQuat2(Rotations, 3 * I)
                                     : unpackQuat3(Rotations, 4 * I);
    for (std::size_t K = 0; K < 4; ++K)
      S.Quats[4 * I + K] = static_cast<float>(Quat[K]);
    for (std::size_t C = 0; C < 3; ++C)
      S.Sh[ShEach * I + C] = static_cast<float>(
          (byteAt(Colors, 3 * I + C) / 255.0 - 0.5) / ColorScale);
    for (std::size_t K = 0; K < Later; ++K)
      S.Sh[ShEach * I + 3 + K] =
          (static_cast<float>(byteAt(Harmonics, Later * I + K)) - 128) / 128;
  }
  return Result;
}

Expected<SceneFile> unpackAndDecode(const std::string &Where, Bytes File) {
  auto Stream = GzipReader::open(Where, File);
  if (!Stream)
    return Stream.error();
  const auto Start = Stream->read(HeaderSize);
  if (!Start)
    return Start.error();
  if (!hasMark(FileKind::Spz, *Start))
    return Error{Where, "a gzip-packed file of another kind, expected SPZ; "
                        "unpack it with `gunzip`, and name the scene in it"};
  const auto H = readHeader(Where, *Start);
  if (!H)
    return H.error();
  if (H->Version == 4)
    return Error{Where, "SPZ version 4 in a gzip stream, expected 2 or 3"};
  const auto Body = Stream->read(H->bodySize());
  if (!Body)
    return Body.error();
  if (Body->size() != H->bodySize())
    return wrongSize(Where, *H, Body->size());
  if (auto Whole = Stream->finish(); !Whole)
    return Whole.error();
  return decode(*H, *Body);
}

/// Version 4: the arrays, unpacked, one behind the other.
Expected<SceneFile> unpackArrays(const std::string &Where, const Header &H,
                                 Bytes File) {
  const std::size_t Arrays = H.ShDegree == 0 ? 5 : 6, Entry = 16;
  if (File.size() < HeaderSize4 || byteAt(File, 15) != Arrays)
    return Error{Where, fmt::format("a header of {} arrays, expected {} and "
                                    "32 bytes of header",
                                    byteAt(File, 15), Arrays)};
  const std::size_t Table = load<uint32_t>(File, 16);
  if (Table < HeaderSize4 || Table + Arrays * Entry > File.size())
    return Error{Where, fmt::format("a table of {} arrays at byte {}, expected "
                                    "it after the header and in the file",
                                    Arrays, Table)};
  std::vector<std::byte> Body;
  std::size_t At = Table + Arrays * Entry;
  for (std::size_t I = 0; I < Arrays; ++I) {
    const auto Packed = load<uint64_t>(File, Table + I * Entry),
               Size = load<uint64_t>(File, Table + I * Entry + 8);
    const std::size_t Needed = H.Count * H.sizes()[I];
    if (Packed > File.size() - At || Size != Needed)
      return Error{
          Where,
          fmt::format(
              "array {} has {} bytes, packed {}, expected {} inside the file",
              I, Size, Packed, Needed)};
    const auto Array = unpackZstd(Where, File.subspan(At, Packed), Needed);
    if (!Array)
      return Array.error();
    Body.insert(Body.end(), Array->begin(), Array->end());
    At += Packed;
  }
  if (At != File.size())
    return Error{
        Where,
        fmt::format("{} after the last array, expected the end of the file",
                    counted(File.size() - At, "byte"))};
  SceneFile Result = decode(H, Body);
  if (Table > HeaderSize4)
    Result.Skipped.push_back("extensions");
  return Result;
}

} // namespace

bool isSpz(Bytes File) { return isGzip(File) || hasMark(FileKind::Spz, File); }

Expected<SceneFile> parseSpz(const std::string &Where, Bytes File,
                             const ReadOptions & /*Options*/) {
  if (isGzip(File))
    return unpackAndDecode(Where, File);
  const auto H = readHeader(Where, File);
  if (!H)
    return H.error();
  if (H->Version == 4)
    return unpackArrays(Where, *H, File);
  const Bytes Body = File.subspan(HeaderSize);
  if (Body.size() != H->bodySize())
    return wrongSize(Where, *H, Body.size());
  return decode(*H, Body);
}

} // namespace vorion::splat
