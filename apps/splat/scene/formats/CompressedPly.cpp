// PlayCanvas's compressed PLY: chunks of 256 Gaussians, each with its bounds,
// and four 32-bit words a Gaussian.
// https://github.com/playcanvas/splat-transform (compressed PLY)
//
// The elements chunk, vertex and, from degree 1, sh. Between a
// chunk's bounds, positions and log scales have 11, 10 and 11 bits, colours 8;
// rotations have 10 bits for each of the three components that are not the
// largest, opacity 8, harmonics 8 for -4 to 4. Older files have no bounds of
// the colour, which then goes from 0 to 1.
#include "io/PlyFile.h"
#include "scene/UpDirection.h"
#include "scene/formats/Dequantize.h"
#include "scene/formats/Formats.h"
#include "scene/formats/Ply.h"

#include <array>
#include <fmt/format.h>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace vorion::splat {
namespace {

constexpr std::size_t ChunkSize = 256;

using Offsets = std::vector<std::size_t>;

/// Where the smaller and the larger bounds of three values lie in a chunk.
struct Bounds {
  Offsets Low, High;

  double at(Bytes Chunk, std::size_t Axis, double T) const {
    return lerp(load<float>(Chunk, Low[Axis]), load<float>(Chunk, High[Axis]),
                T);
  }
};

Expected<Bounds> boundsOf(const std::string &Where, const PlyElement &Chunk,
                          const std::array<std::string, 3> &Names) {
  Bounds B;
  for (auto &[To, Prefix] :
       {std::pair<Offsets &, const char *>{B.Low, "min_"}, {B.High, "max_"}}) {
    auto Found = Chunk.offsets(
        Where, {Prefix + Names[0], Prefix + Names[1], Prefix + Names[2]},
        PlyType::Float);
    if (!Found)
      return Found.error();
    To = std::move(*Found);
  }
  return B;
}

/// Three numbers from 0 to 1 of 11, 10 and 11 bits, from the top.
std::array<double, 3> unpack111011(uint32_t Word) {
  return {unorm(Word >> 21, 11), unorm(Word >> 11, 10), unorm(Word, 11)};
}

/// Two bits for the component that is missing, then the others in order,
/// 10 bits each for -1/sqrt(2) to 1/sqrt(2).
std::array<double, 4> unpackQuat(uint32_t Word) {
  std::array<double, 3> Others{};
  for (int I = 0; I < 3; ++I)
    Others[static_cast<std::size_t>(I)] =
        (unorm(Word >> (20 - 10 * I), 10) - 0.5) * std::numbers::sqrt2;
  return completeQuat(Word >> 30, Others);
}

/// A byte of the sh element: the middle of one of 256 steps from -4 to 4, but
/// the ends for the first and the last.
double unpackSh(unsigned Byte) {
  const double T = Byte == 0 ? 0 : Byte == 255 ? 1 : (Byte + 0.5) / 256;
  return (T - 0.5) * 8;
}

/// The element sh and its properties in the scene's order.
struct Harmonics {
  const PlyElement *Element = nullptr;
  int Degree = 0;
  Offsets Rest;
};

Expected<Harmonics> harmonicsOf(const std::string &Where, const PlyHeader &H,
                                std::size_t Count) {
  Harmonics Result;
  Result.Element = H.find("sh");
  if (!Result.Element)
    return Result;
  const std::size_t Properties = Result.Element->Properties.size();
  Result.Degree = Properties % 3 == 0 ? shDegreeOf(Properties / 3) : -1;
  if (Result.Degree < 1)
    return Error{Where, fmt::format("element sh has {} properties, expected 9, "
                                    "24, 45 or 72 (degree 1 to 4)",
                                    Properties)};
  if (Result.Element->Count != Count)
    return Error{Where,
                 fmt::format("element sh has {} rows, expected one for each of "
                             "{} vertices",
                             Result.Element->Count, Count)};
  auto Found = Result.Element->offsets(Where, plyRestNames(Result.Degree),
                                       PlyType::UChar);
  if (!Found)
    return Found.error();
  Result.Rest = std::move(*Found);
  return Result;
}

} // namespace

bool isCompressedPly(Bytes File) {
  if (!isPlyFile(File))
    return false;
  const auto Header = readPlyHeader("", File);
  return Header && Header->find("chunk");
}

Expected<SceneFile> parseCompressedPly(const std::string &Where, Bytes File,
                                       const ReadOptions & /*Options*/) {
  const auto Read = readPly(Where, File);
  if (!Read)
    return Read.error();
  const PlyHeader &Header = Read->header();
  auto DrawnAs = drawingOfComments(Where, Header.Comments);
  if (!DrawnAs)
    return DrawnAs.error();
  const PlyElement *Chunk = Header.find("chunk");
  const PlyElement *Vertex = Header.find("vertex");
  if (!Chunk || !Vertex || Chunk->HasLists || Vertex->HasLists)
    return Error{Where,
                 "a compressed PLY without element vertex or with lists, "
                 "expected chunk and vertex of numbers"};
  const std::size_t Chunks = (Vertex->Count + ChunkSize - 1) / ChunkSize;
  if (Chunk->Count != Chunks)
    return Error{Where, fmt::format("{} chunks for {} vertices, expected {}",
                                    Chunk->Count, Vertex->Count, Chunks)};
  const auto Words = Vertex->offsets(
      Where,
      {"packed_position", "packed_rotation", "packed_scale", "packed_color"},
      PlyType::UInt);
  if (!Words)
    return Words.error();
  const auto Positions = boundsOf(Where, *Chunk, {"x", "y", "z"});
  if (!Positions)
    return Positions.error();
  const auto Scales =
      boundsOf(Where, *Chunk, {"scale_x", "scale_y", "scale_z"});
  if (!Scales)
    return Scales.error();
  std::optional<Bounds> Colors;
  if (Chunk->find("min_r")) {
    auto Found = boundsOf(Where, *Chunk, {"r", "g", "b"});
    if (!Found)
      return Found.error();
    Colors = std::move(*Found);
  }
  const auto Later = harmonicsOf(Where, Header, Vertex->Count);
  if (!Later)
    return Later.error();

  SceneFile Result;
  Result.Format = SceneFormat::CompressedPly;
  Result.DrawnAs = std::move(*DrawnAs);
  Result.Up = upOfComments(Header.Comments);
  Scene &S = Result.Gaussians = Scene::sized(Vertex->Count, Later->Degree);
  const auto &Logits = byteOpacityLogits();
  const std::size_t ShEach = 3 * S.coefficients();
  for (std::size_t I = 0; I < Vertex->Count; ++I) {
    const Bytes Row = Read->row(*Vertex, I);
    const Bytes Box = Read->row(*Chunk, I / ChunkSize);
    const auto Position = unpack111011(load<uint32_t>(Row, (*Words)[0]));
    const auto Quat = unpackQuat(load<uint32_t>(Row, (*Words)[1]));
    const auto Scale = unpack111011(load<uint32_t>(Row, (*Words)[2]));
    const auto Color = load<uint32_t>(Row, (*Words)[3]);
    for (std::size_t A = 0; A < 3; ++A) {
      S.Means[3 * I + A] =
          static_cast<float>(Positions->at(Box, A, Position[A]));
      S.LogScales[3 * I + A] = static_cast<float>(Scales->at(Box, A, Scale[A]));
      const double T = unorm(Color >> (24 - 8 * A), 8);
      S.Sh[ShEach * I + A] = shOfColor(Colors ? Colors->at(Box, A, T) : T);
    }
    for (std::size_t K = 0; K < 4; ++K)
      S.Quats[4 * I + K] = static_cast<float>(Quat[K]);
    S.OpacityLogits[I] = Logits[Color & 0xFF];
    for (std::size_t K = 0; K < Later->Rest.size(); ++K)
      S.Sh[ShEach * I + 3 + K] = static_cast<float>(
          unpackSh(byteAt(Read->row(*Later->Element, I), Later->Rest[K])));
  }
  return Result;
}

} // namespace vorion::splat
