// PLY: the elements `vertex`, with or without colours and normals, and `face`.
#include "io/PlyFile.h"
#include "mesh/Mesh.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace vorion::splat {
namespace {

/// A number of a vertex, and what its type has for 1.
struct Channel {
  const PlyProperty *From = nullptr;
  double One = 1;
};

Expected<Channel> channelOf(const std::string &Where, const PlyElement &Vertex,
                            const char *Name) {
  Channel C{Vertex.find(Name)};
  if (!C.From)
    return C;
  switch (C.From->Type) {
  case PlyType::UChar:
    C.One = 255;
    return C;
  case PlyType::UShort:
    C.One = 65535;
    return C;
  case PlyType::Float:
  case PlyType::Double:
    return C;
  default:
    return Error{Where, fmt::format("property {} of element vertex is a signed "
                                    "or 32-bit integer, expected uchar, ushort "
                                    "or float",
                                    Name)};
  }
}

} // namespace

Expected<Mesh> readPlyMesh(const std::string &Where, Bytes Content) {
  const auto File = readPly(Where, Content);
  if (!File)
    return File.error();
  const PlyElement *Vertex = File->header().find("vertex");
  const PlyElement *Face = File->header().find("face");
  if (!Vertex || Vertex->HasLists)
    return Error{Where, "no element vertex without lists, expected one"};
  if (!Face)
    return Error{Where, "no element face, expected a mesh: a file without "
                        "faces may be a scene"};
  const auto Reals = Vertex->reals(Where, {"x", "y", "z"});
  if (!Reals)
    return Reals.error();
  Channel Rgb[3];
  for (int C = 0; C < 3; ++C) {
    constexpr const char *Names[] = {"red", "green", "blue"};
    const auto Found = channelOf(Where, *Vertex, Names[C]);
    if (!Found)
      return Found.error();
    Rgb[C] = *Found;
  }
  const PlyProperty *Normal[3] = {Vertex->find("nx"), Vertex->find("ny"),
                                  Vertex->find("nz")};
  Mesh M;
  M.Materials.emplace_back();
  // As MeshLab names pictures.
  constexpr std::string_view Picture = "TextureFile ";
  for (const std::string &Comment : File->header().Comments)
    if (const std::string_view Text = trimmed(Comment);
        Text.starts_with(Picture))
      M.Warnings.push_back(
          {Where, fmt::format("drawn without the texture {}, expected an OBJ "
                              "or glTF file with it",
                              printable(Text.substr(Picture.size())))});
  for (std::size_t I = 0; I < Vertex->Count; ++I) {
    const Bytes Row = File->row(*Vertex, I);
    std::array<float, 3> Position{};
    std::array<float, 4> Color{1, 1, 1, 1};
    for (std::size_t A = 0; A < 3; ++A) {
      Position[A] = static_cast<float>(loadReal(Row, (*Reals)[A]));
      if (!std::isfinite(Position[A]))
        return Error{Where, fmt::format("vertex {} is at {}, expected finite "
                                        "coordinates",
                                        I, Position[A])};
      if (!Rgb[A].From)
        continue;
      const double Value =
          loadNumber(Row, Rgb[A].From->Offset, Rgb[A].From->Type) / Rgb[A].One;
      if (!(Value >= 0 && Value <= 1))
        return Error{Where, fmt::format("vertex {} has a colour of {}, "
                                        "expected 0 to 1",
                                        I, Value)};
      Color[A] = static_cast<float>(Value);
    }
    M.addVertex(Position, Color);
  }
  PlyListRows Rows(*File, *Face);
  std::vector<double> Numbers;
  std::vector<MeshCorner> Corners;
  for (std::size_t I = 0; I < Face->Count; ++I) {
    Numbers.clear();
    for (const PlyProperty &P : Face->Properties)
      Rows.next(P, P.CountType && (P.Name == "vertex_indices" ||
                                   P.Name == "vertex_index")
                       ? &Numbers
                       : nullptr);
    if (Numbers.size() < 3)
      return Error{Where,
                   fmt::format("face {} has {} corners (list vertex_indices), "
                               "expected at least 3",
                               I, Numbers.size())};
    Corners.clear();
    for (const double N : Numbers) {
      if (!(N >= 0 && N < static_cast<double>(Vertex->Count)))
        return Error{Where,
                     fmt::format("face {} has vertex {}, expected 0 to "
                                 "{}",
                                 I, N, static_cast<double>(Vertex->Count) - 1)};
      MeshCorner &C = Corners.emplace_back();
      C.Vertex = static_cast<uint32_t>(N);
      for (std::size_t A = 0; A < 3; ++A)
        if (Normal[0] && Normal[1] && Normal[2])
          C.Normal[A] = static_cast<float>(
              loadNumber(File->row(*Vertex, C.Vertex), Normal[A]->Offset,
                         Normal[A]->Type));
      if (!std::isfinite(C.Normal[0] + C.Normal[1] + C.Normal[2]))
        C.Normal = {};
    }
    M.addPolygon(Corners, 0);
  }
  return M;
}

} // namespace vorion::splat
