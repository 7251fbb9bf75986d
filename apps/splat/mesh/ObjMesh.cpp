// Wavefront OBJ: vertices, which may have colours, polygons, texture
// coordinates, normals, and of materials the diffuse colours and textures.
#include "mesh/Mesh.h"
#include "vorion/support/File.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <unordered_map>

namespace vorion::splat {
namespace {

/// The words of a text file, line by line; a backslash at a line's end joins
/// the next one.
class Lines {
public:
  Lines(const std::string &Where, std::string_view Text)
      : Where(Where), Text(Text) {}

  /// Reads the next line that has words; false at the end.
  bool next() {
    while (At < Text.size()) {
      Words.clear();
      Number += Joined;
      Joined = 0;
      bool Continues = true;
      while (Continues && At < Text.size()) {
        const std::size_t End = std::min(Text.find('\n', At), Text.size());
        std::string_view Line = Text.substr(At, End - At);
        At = End + 1;
        ++Joined;
        while (!Line.empty() && (Line.back() == '\r' || Line.back() == ' '))
          Line.remove_suffix(1);
        Continues = Line.ends_with('\\');
        if (Continues)
          Line.remove_suffix(1);
        split(Line);
      }
      if (!Words.empty())
        return true;
    }
    return false;
  }

  std::vector<std::string_view> Words;

  /// The line from word \p First on, which may be a name with blanks.
  std::string rest(std::size_t First) const {
    const char *Begin = Words[First].data();
    return {Begin, Words.back().data() + Words.back().size()};
  }
  std::string place() const { return fmt::format("{}:{}", Where, Number); }
  Error wrong(std::string What) const { return {place(), std::move(What)}; }
  /// Words \p First on as numbers, all finite.
  Expected<std::vector<double>> numbers(std::size_t First) const {
    std::vector<double> All;
    for (std::size_t I = First; I < Words.size(); ++I) {
      std::string_view Word = Words[I];
      if (Word.starts_with('+'))
        Word.remove_prefix(1);
      double Value = 0;
      const auto [End, Status] =
          std::from_chars(Word.begin(), Word.end(), Value);
      if (End != Word.end() || Status != std::errc() ||
          !std::isfinite(static_cast<float>(Value)))
        return wrong(
            fmt::format("`{}`, expected a finite number", printable(Words[I])));
      All.push_back(Value);
    }
    return All;
  }

private:
  void split(std::string_view Line) {
    constexpr std::string_view Blanks = " \t\v\f";
    Line = Line.substr(0, Line.find('#'));
    for (std::size_t Begin = Line.find_first_not_of(Blanks);
         Begin != Line.npos;) {
      const std::size_t End =
          std::min(Line.find_first_of(Blanks, Begin), Line.size());
      Words.push_back(Line.substr(Begin, End - Begin));
      Begin = Line.find_first_not_of(Blanks, End);
    }
  }

  const std::string &Where;
  std::string_view Text;
  std::size_t At = 0, Number = 1, Joined = 0;
};

Expected<std::array<float, 3>> colorOf(const Lines &L, std::size_t First) {
  const auto Numbers = L.numbers(First);
  if (!Numbers)
    return Numbers.error();
  if (Numbers->size() < 3)
    return L.wrong("a colour of less than three numbers, expected red, green "
                   "and blue");
  std::array<float, 3> Color{};
  for (std::size_t C = 0; C < 3; ++C) {
    if (!((*Numbers)[C] >= 0 && (*Numbers)[C] <= 1))
      return L.wrong(
          fmt::format("a colour of {}, expected 0 to 1", (*Numbers)[C]));
    Color[C] = static_cast<float>((*Numbers)[C]);
  }
  return Color;
}

/// A material of a library.
struct ObjMaterial {
  std::array<float, 3> Color{1, 1, 1};
  float Alpha = 1;
  std::array<double, 2> Scale{1, 1}, Offset{}; ///< of texture coordinates
  uint32_t Look = 0;                           ///< of the mesh
  /// Of vertices that have none: white, or grey where the material is missing,
  /// as in trimesh.
  std::array<float, 3> VertexColor{1, 1, 1};
};

/// The materials of a file's libraries.
class Library {
public:
  Library(const std::string &ObjFile, Mesh &To)
      : Folder(std::filesystem::path(ObjFile).parent_path()), To(To) {}

  /// Reads the libraries of a line `mtllib`. One that is missing is a warning.
  Expected<Success> read(const Lines &Obj);
  /// The material of a line `usemtl`; grey with a warning if there is none.
  const ObjMaterial &use(const Lines &Obj);

private:
  Expected<Success> readFile(const std::string &Path);
  Expected<Success> statement(const Lines &L, const std::string &Path,
                              ObjMaterial &M);
  Expected<Success> picture(const Lines &L, const std::string &Path,
                            ObjMaterial &M);
  void warn(const Lines &L, std::string What) {
    To.Warnings.push_back({L.place(), std::move(What)});
  }

  std::filesystem::path Folder;
  Mesh &To;
  std::map<std::string, ObjMaterial, std::less<>> All;
  std::map<std::string, uint32_t> Pictures; ///< of files, in the mesh
};

Expected<Success> Library::read(const Lines &Obj) {
  if (Obj.Words.size() < 2)
    return Success{};
  // One name, which may have blanks, or several.
  std::vector<std::string> Names{Obj.rest(1)};
  if (!std::filesystem::exists(Folder / Names[0]))
    Names.assign(Obj.Words.begin() + 1, Obj.Words.end());
  for (const std::string &Name : Names) {
    const std::string Path = (Folder / Name).string();
    if (!std::filesystem::exists(Path))
      warn(Obj, fmt::format("no file {}: its materials are drawn grey",
                            printable(Path)));
    else if (auto Read = readFile(Path); !Read)
      return Read;
  }
  return Success{};
}

const ObjMaterial &Library::use(const Lines &Obj) {
  const std::string Name = Obj.rest(1);
  auto Found = All.find(Name);
  if (Found == All.end()) {
    warn(Obj, fmt::format("material `{}` is in no library and drawn grey",
                          printable(Name)));
    Found = All.try_emplace(Name).first;
    Found->second.VertexColor = {0.4F, 0.4F, 0.4F};
  }
  return Found->second;
}

Expected<Success> Library::readFile(const std::string &Path) {
  const auto File = readRegularFile(Path);
  if (!File)
    return File.error();
  Lines L(Path, asText(*File));
  ObjMaterial *Current = nullptr;
  while (L.next()) {
    if (L.Words[0] == "newmtl") {
      if (L.Words.size() < 2)
        return L.wrong("newmtl without a name, expected one");
      Current = &(All[L.rest(1)] = {});
      Current->Look = static_cast<uint32_t>(To.Materials.size());
      To.Materials.emplace_back();
    } else if (Current) {
      if (auto Read = statement(L, Path, *Current); !Read)
        return Read;
    }
  }
  return Success{};
}

/// Reads a line of material \p M.
Expected<Success> Library::statement(const Lines &L, const std::string &Path,
                                     ObjMaterial &M) {
  const std::string_view Key = L.Words[0];
  if (Key == "map_Kd")
    return picture(L, Path, M);
  if (Key == "map_d" || Key == "map_opacity")
    return L.wrong(fmt::format("transparency by a picture ({}) is not "
                               "supported, expected d",
                               Key));
  if (Key == "Kd") {
    if (L.Words.size() > 1 && (L.Words[1] == "spectral" || L.Words[1] == "xyz"))
      return L.wrong(fmt::format("Kd {} is not supported, expected red, green "
                                 "and blue",
                                 L.Words[1]));
    const auto Color = colorOf(L, 1);
    if (!Color)
      return Color.error();
    M.Color = *Color;
  } else if (Key == "d" || Key == "Tr") {
    const bool IsHalo = L.Words.size() > 2 && L.Words[1] == "-halo";
    const auto Value = L.numbers(IsHalo ? 2 : 1);
    if (!Value)
      return Value.error();
    if (Value->size() != 1 || !(Value->front() >= 0 && Value->front() <= 1))
      return L.wrong(fmt::format("{} of {}, expected a number from 0 to 1", Key,
                                 printable(L.rest(1))));
    // MeshLab writes Tr 1 for an opaque material, others Tr 0.
    const double Alpha = Key == "d"              ? Value->front()
                         : Value->front() == 1.0 ? 1
                                                 : 1 - Value->front();
    M.Alpha = static_cast<float>(Alpha);
    To.Materials[M.Look].Alpha =
        Alpha < 1 ? AlphaMode::Blend : AlphaMode::Opaque;
  }
  return Success{};
}

/// Reads a line `map_Kd`: options, then the name of a file.
Expected<Success> Library::picture(const Lines &L, const std::string &Path,
                                   ObjMaterial &M) {
  Material &Look = To.Materials[M.Look];
  std::size_t At = 1;
  const auto Number = [&](std::size_t Word) -> std::optional<double> {
    if (Word >= L.Words.size())
      return std::nullopt;
    double Value = 0;
    const auto [End, Status] =
        std::from_chars(L.Words[Word].begin(), L.Words[Word].end(), Value);
    return End == L.Words[Word].end() && Status == std::errc() &&
                   std::isfinite(Value)
               ? std::optional(Value)
               : std::nullopt;
  };
  while (At < L.Words.size() && L.Words[At].starts_with('-')) {
    const std::string_view Option = L.Words[At++];
    if (Option == "-o" || Option == "-s" || Option == "-t") {
      for (std::size_t A = 0; A < 3; ++A) {
        const auto Value = Number(At);
        if (!Value)
          break;
        if (A < 2 && Option != "-t")
          (Option == "-s" ? M.Scale : M.Offset)[A] = *Value;
        ++At;
      }
    } else {
      if (Option == "-clamp" && At < L.Words.size() && L.Words[At] == "on")
        Look.Sampling.Wraps = {Wrap::Clamp, Wrap::Clamp};
      At += Option == "-mm" ? 2 : 1;
    }
  }
  if (At >= L.Words.size())
    return L.wrong("map_Kd without a file, expected one");
  // Files that were made elsewhere have backslashes.
  std::string Name = L.rest(At);
  std::ranges::replace(Name, '\\', '/');
  const std::string File =
      (std::filesystem::path(Path).parent_path() / Name).string();
  if (!std::filesystem::exists(File)) {
    warn(L, fmt::format("no file {}: drawn without this texture",
                        printable(File)));
    return Success{};
  }
  const auto [Known, IsNew] =
      Pictures.try_emplace(File, static_cast<uint32_t>(To.Textures.size()));
  if (IsNew) {
    const auto Content = readRegularFile(File);
    if (!Content)
      return Content.error();
    auto Decoded = decodeTexture(File, *Content);
    if (!Decoded)
      return Decoded.error();
    To.Textures.push_back(std::move(*Decoded));
  }
  Look.Picture = Known->second;
  return Success{};
}

class Reader {
public:
  Reader(const std::string &Where, Bytes File)
      : L(Where, asText(File)), Known(Where, Result) {
    Result.Materials.emplace_back(); // of faces without one
  }

  Expected<Mesh> read() {
    while (L.next())
      if (auto Read = line(); !Read)
        return Read.error();
    return std::move(Result);
  }

private:
  Expected<Success> line() {
    // What neither changes a triangle nor a colour.
    static constexpr std::array<std::string_view, 29> Ignored{
        "vp",    "l",        "p",        "g",         "s",         "mg",
        "lod",   "bevel",    "usemap",   "maplib",    "deg",       "bmat",
        "step",  "cstype",   "curv",     "curv2",     "surf",      "parm",
        "trim",  "hole",     "scrv",     "sp",        "end",       "con",
        "stech", "c_interp", "d_interp", "trace_obj", "shadow_obj"};
    const std::string_view Key = L.Words[0];
    if (Key == "v")
      return vertex();
    if (Key == "vt" || Key == "vn") {
      vector(Key == "vt" ? TextureCoordinates : Normals);
      return Success{};
    }
    if (Key == "f" || Key == "fo")
      return face();
    if (Key == "usemtl") {
      // Rhino writes one without a name.
      Current = L.Words.size() < 2 ? ObjMaterial{} : Known.use(L);
      Made.clear();
      return Success{};
    }
    if (Key == "o") {
      Result.beginPart(L.Words.size() < 2 ? "" : L.rest(1));
      return Success{};
    }
    if (Key == "mtllib")
      return Known.read(L);
    if (std::ranges::find(Ignored, Key) == Ignored.end())
      return L.wrong(fmt::format("`{}` is no statement of an OBJ file, "
                                 "expected v, f or another one",
                                 printable(Key)));
    return Success{};
  }

  Expected<Success> vertex() {
    const auto Numbers = L.numbers(1);
    if (!Numbers)
      return Numbers.error();
    const std::size_t N = Numbers->size();
    if (N != 3 && N != 4 && N != 6 && N != 7)
      return L.wrong(fmt::format("a vertex of {} numbers, expected x, y, z, "
                                 "and perhaps red, green, blue",
                                 N));
    for (std::size_t A = 0; A < 3; ++A)
      Positions.push_back(static_cast<float>((*Numbers)[A]));
    Colors.emplace_back();
    if (N >= 6) {
      const auto Own = colorOf(L, N - 2);
      if (!Own)
        return Own.error();
      Colors.back() = *Own;
    }
    return Success{};
  }

  /// Reads a texture coordinate or a normal. Exporters write NaNs for triangles
  /// without area; one that is used is an error.
  void vector(std::vector<std::array<double, 3>> &All) {
    const auto Numbers = L.numbers(1);
    std::array<double, 3> &Vector = All.emplace_back();
    if (Numbers)
      std::copy_n(Numbers->begin(), std::min<std::size_t>(Numbers->size(), 3),
                  Vector.begin());
    else
      Vector.fill(std::numeric_limits<double>::quiet_NaN());
  }

  /// The index of \p Text among \p Count things: from 1, or from -1 backwards.
  Expected<std::size_t> index(std::string_view Text, std::size_t Count,
                              const char *Of, const char *OfAll) const {
    int64_t Value = 0;
    const auto [End, Status] = std::from_chars(Text.begin(), Text.end(), Value);
    if (End != Text.end() ||
        (Status != std::errc() && Status != std::errc::result_out_of_range))
      return L.wrong(fmt::format("`{}`, expected the number of a {}",
                                 printable(Text), Of));
    const auto Most = static_cast<int64_t>(Count);
    if (Status != std::errc() || Value == 0 || Value > Most || Value < -Most)
      return L.wrong(fmt::format("{} {}, expected 1 to {}, the {} so far, or "
                                 "-{} to -1",
                                 Of, Text, Count, OfAll, Count));
    return static_cast<std::size_t>(Value > 0 ? Value - 1 : Most + Value);
  }

  /// The corner of a face's word \p Word: v, v/t, v//n or v/t/n.
  Expected<MeshCorner> corner(std::string_view Word) {
    std::array<std::string_view, 3> Parts;
    for (std::string_view &Part : Parts) {
      Part = Word.substr(0, Word.find('/'));
      Word.remove_prefix(std::min(Part.size() + 1, Word.size()));
    }
    const auto Vertex = index(Parts[0], Colors.size(), "vertex", "vertices");
    if (!Vertex)
      return Vertex.error();
    MeshCorner C;
    C.Vertex = withMaterial(*Vertex);
    // Some exporters write numbers of what the file does not have.
    if (!Parts[1].empty() && !TextureCoordinates.empty()) {
      const auto At = index(Parts[1], TextureCoordinates.size(),
                            "texture coordinate", "texture coordinates");
      if (!At)
        return At.error();
      const auto &Uv = TextureCoordinates[*At];
      // An OBJ counts from the picture's lower edge.
      C.TextureCoordinate = {
          static_cast<float>(Uv[0] * Current.Scale[0] + Current.Offset[0]),
          static_cast<float>(1 -
                             (Uv[1] * Current.Scale[1] + Current.Offset[1]))};
      if (Result.Materials[Current.Look].Picture &&
          !(std::isfinite(C.TextureCoordinate[0]) &&
            std::isfinite(C.TextureCoordinate[1])))
        return L.wrong(fmt::format("texture coordinate {} is no finite number, "
                                   "expected two",
                                   Parts[1]));
    }
    if (!Parts[2].empty() && !Normals.empty()) {
      const auto At = index(Parts[2], Normals.size(), "normal", "normals");
      if (!At)
        return At.error();
      if (std::isfinite(Normals[*At][0]))
        for (std::size_t A = 0; A < 3; ++A)
          C.Normal[A] = static_cast<float>(Normals[*At][A]);
    }
    return C;
  }

  Expected<Success> face() {
    std::vector<MeshCorner> Polygon;
    for (std::size_t I = 1; I < L.Words.size(); ++I) {
      const auto C = corner(L.Words[I]);
      if (!C)
        return C.error();
      Polygon.push_back(*C);
    }
    if (Polygon.size() < 3)
      return L.wrong(fmt::format("a face of {} corners, expected at least 3",
                                 Polygon.size()));
    Result.addPolygon(Polygon, Current.Look);
    return Success{};
  }

  /// The mesh's vertex for vertex \p V in the current material.
  uint32_t withMaterial(std::size_t V) {
    const auto [It, IsNew] = Made.try_emplace(V, 0);
    if (IsNew) {
      const auto Own = Colors[V].value_or(Current.VertexColor);
      It->second = Result.addVertex(
          {Positions[3 * V], Positions[3 * V + 1], Positions[3 * V + 2]},
          {Own[0] * Current.Color[0], Own[1] * Current.Color[1],
           Own[2] * Current.Color[2], Current.Alpha});
    }
    return It->second;
  }

  Lines L;
  std::vector<float> Positions;
  std::vector<std::optional<std::array<float, 3>>> Colors;
  std::vector<std::array<double, 3>> TextureCoordinates, Normals;
  Mesh Result;
  Library Known;
  ObjMaterial Current;
  std::unordered_map<std::size_t, uint32_t> Made; ///< in the current material
};

} // namespace

Expected<Mesh> readObjMesh(const std::string &Where, Bytes File) {
  return Reader(Where, File).read();
}

} // namespace vorion::splat
