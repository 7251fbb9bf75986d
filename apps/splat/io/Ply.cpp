#include "Ply.h"

#include "vorion/support/File.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <vector>

static_assert(std::endian::native == std::endian::little,
              "floats are copied between file and memory as they are");

namespace vorion::splat {
namespace {

/// A scalar vertex property: where it lies in a vertex.
struct Property {
  std::string Name;
  std::size_t Offset = 0;
  bool IsFloat = false;
};

struct Header {
  std::size_t Vertices = 0;
  std::size_t Stride = 0; ///< bytes of a vertex
  std::size_t Bytes = 0;  ///< of the header
  std::vector<Property> Properties;

  const Property *find(std::string_view Name) const {
    const auto It =
        std::find_if(Properties.begin(), Properties.end(),
                     [&](const Property &P) { return P.Name == Name; });
    return It == Properties.end() ? nullptr : &*It;
  }
};

/// Bytes of a scalar PLY type in either of its two spellings; 0 if unknown.
std::size_t scalarSize(std::string_view Type) {
  if (Type == "char" || Type == "uchar" || Type == "int8" || Type == "uint8")
    return 1;
  if (Type == "short" || Type == "ushort" || Type == "int16" ||
      Type == "uint16")
    return 2;
  if (Type == "int" || Type == "uint" || Type == "int32" || Type == "uint32" ||
      Type == "float" || Type == "float32")
    return 4;
  if (Type == "double" || Type == "float64")
    return 8;
  return 0;
}

/// The words of \p Line, separated by blanks.
std::vector<std::string_view> words(std::string_view Line) {
  std::vector<std::string_view> Result;
  while (true) {
    const std::size_t Start = Line.find_first_not_of(" \t");
    if (Start == std::string_view::npos)
      return Result;
    const std::size_t End =
        std::min(Line.find_first_of(" \t", Start), Line.size());
    Result.push_back(Line.substr(Start, End - Start));
    Line.remove_prefix(End);
  }
}

/// Reads header lines one by one and collects what they declare.
class HeaderReader {
public:
  HeaderReader(const std::string &Path, std::string_view Text)
      : Path(Path), Text(Text) {}

  Expected<Header> read() {
    const auto First = nextLine();
    if (!First || *First != "ply")
      return error("not a PLY file, expected `ply` on the first line");
    while (true) {
      const auto Line = nextLine();
      if (!Line)
        return error("header ends early, expected `end_header`");
      const auto W = words(*Line);
      if (W.empty() || W[0] == "comment" || W[0] == "obj_info")
        continue;
      if (W[0] == "end_header")
        break;
      if (auto Problem = declare(W))
        return error(*Problem);
    }
    if (!HasFormat)
      return error("header has no format line, expected `format "
                   "binary_little_endian 1.0`");
    if (Elements == 0)
      return error("header has no vertex element");
    Result.Bytes = At;
    return Result;
  }

private:
  Error error(std::string What) const {
    return Error{fmt::format("{}:{}", Path, LineNumber), std::move(What)};
  }

  /// The next line without its end; nothing if the text ends before one.
  std::optional<std::string_view> nextLine() {
    ++LineNumber;
    const std::size_t End = Text.find('\n', At);
    if (End == std::string_view::npos)
      return std::nullopt;
    std::string_view Line = Text.substr(At, End - At);
    At = End + 1;
    if (Line.ends_with('\r'))
      Line.remove_suffix(1);
    return Line;
  }

  /// Takes one declaration; gives what is wrong with it.
  std::optional<std::string> declare(const std::vector<std::string_view> &W) {
    if (W[0] == "format")
      return declareFormat(W);
    if (W[0] == "element")
      return declareElement(W);
    if (W[0] == "property")
      return declareProperty(W);
    return fmt::format("unknown header keyword `{}`, expected format, element, "
                       "property, comment or end_header",
                       W[0].substr(0, 40));
  }

  std::optional<std::string>
  declareFormat(const std::vector<std::string_view> &W) {
    if (W.size() != 3 || W[1] != "binary_little_endian" || W[2] != "1.0")
      return fmt::format("format is `{}`, expected `binary_little_endian 1.0`",
                         W.size() > 1 ? W[1].substr(0, 40) : "");
    HasFormat = true;
    return std::nullopt;
  }

  std::optional<std::string>
  declareElement(const std::vector<std::string_view> &W) {
    if (W.size() != 3 || W[1] != "vertex" || Elements != 0)
      return "expected one element, `element vertex <count>`; compressed or "
             "multi-element files are another format";
    const auto [End, Status] = std::from_chars(
        W[2].data(), W[2].data() + W[2].size(), Result.Vertices);
    if (Status != std::errc() || End != W[2].data() + W[2].size())
      return fmt::format("vertex count `{}` is no number", W[2].substr(0, 40));
    ++Elements;
    return std::nullopt;
  }

  std::optional<std::string>
  declareProperty(const std::vector<std::string_view> &W) {
    if (Elements == 0)
      return "property before `element vertex`";
    if (W.size() != 3 || scalarSize(W[1]) == 0)
      return "expected `property <scalar type> <name>`";
    if (Result.find(W[2]))
      return fmt::format("property {} appears twice", W[2].substr(0, 40));
    Result.Properties.push_back({std::string(W[2]), Result.Stride,
                                 W[1] == "float" || W[1] == "float32"});
    Result.Stride += scalarSize(W[1]);
    return std::nullopt;
  }

  const std::string &Path;
  std::string_view Text;
  std::size_t At = 0;
  int LineNumber = 0;
  int Elements = 0;
  bool HasFormat = false;
  Header Result;
};

/// Offsets in a vertex of what a scene needs.
struct Layout {
  int ShDegree = 0;
  std::vector<std::size_t> Means, LogScales, Quats, Opacity, Sh;
};

/// Finds the needed properties; the degree follows from the number of f_rest.
Expected<Layout> layoutOf(const std::string &Path, const Header &H) {
  Layout L;
  std::optional<Error> Problem;
  const auto Add = [&](std::vector<std::size_t> &To, const std::string &Name) {
    const Property *P = H.find(Name);
    if (P && P->IsFloat)
      To.push_back(P->Offset);
    else if (!Problem)
      Problem = Error{Path, P ? fmt::format("property {} has another type, "
                                            "expected float",
                                            Name)
                              : fmt::format("property {} is missing, expected "
                                            "INRIA's 3DGS layout",
                                            Name)};
  };
  for (const char *Name : {"x", "y", "z"})
    Add(L.Means, Name);
  for (int I = 0; I < 3; ++I)
    Add(L.LogScales, fmt::format("scale_{}", I));
  for (int I = 0; I < 4; ++I)
    Add(L.Quats, fmt::format("rot_{}", I));
  Add(L.Opacity, "opacity");

  const auto Rest = static_cast<std::size_t>(std::count_if(
      H.Properties.begin(), H.Properties.end(),
      [](const Property &P) { return P.Name.starts_with("f_rest_"); }));
  while (L.ShDegree <= MaxShDegree &&
         3 * (shCoefficients(L.ShDegree) - 1) != Rest)
    ++L.ShDegree;
  if (L.ShDegree > MaxShDegree)
    return Error{Path, fmt::format("{} f_rest properties, expected 0, 9, 24 or "
                                   "45 (degree 0 to 3)",
                                   Rest)};
  // The file holds f_rest channel by channel, the scene coefficient by
  // coefficient.
  const std::size_t Later = shCoefficients(L.ShDegree) - 1;
  for (int C = 0; C < 3; ++C)
    Add(L.Sh, fmt::format("f_dc_{}", C));
  for (std::size_t K = 0; K < Later; ++K)
    for (std::size_t C = 0; C < 3; ++C)
      Add(L.Sh, fmt::format("f_rest_{}", C * Later + K));
  if (Problem)
    return *Problem;
  return L;
}

/// Appends the floats at \p Offsets of \p Vertex; false if one is not finite.
bool take(std::vector<float> &To, const std::vector<std::size_t> &Offsets,
          const std::byte *Vertex) {
  bool Finite = true;
  for (const std::size_t Offset : Offsets) {
    float Value;
    std::memcpy(&Value, Vertex + Offset, sizeof(Value));
    Finite &= std::isfinite(Value);
    To.push_back(Value);
  }
  return Finite;
}

} // namespace

Expected<Scene> readPly(const std::string &Path) {
  const auto File = readFile(Path);
  if (!File)
    return File.error();
  const std::string_view Text(reinterpret_cast<const char *>(File->data()),
                              File->size());
  const auto H = HeaderReader(Path, Text).read();
  if (!H)
    return H.error();
  const auto L = layoutOf(Path, *H);
  if (!L)
    return L.error();
  if (H->Vertices == 0)
    return Error{Path, "no vertex, expected at least one Gaussian"};
  const std::size_t Body = File->size() - H->Bytes;
  // Division, since an absurd count times the stride need not fit.
  if (Body / H->Stride != H->Vertices || Body % H->Stride != 0)
    return Error{Path, fmt::format("{} bytes after the header, expected {} "
                                   "vertices of {} bytes",
                                   Body, H->Vertices, H->Stride)};

  Scene S;
  S.ShDegree = L->ShDegree;
  S.Means.reserve(H->Vertices * 3);
  S.LogScales.reserve(H->Vertices * 3);
  S.Quats.reserve(H->Vertices * 4);
  S.OpacityLogits.reserve(H->Vertices);
  S.Sh.reserve(H->Vertices * L->Sh.size());
  for (std::size_t I = 0; I < H->Vertices; ++I) {
    const std::byte *Vertex = File->data() + H->Bytes + I * H->Stride;
    bool Finite = take(S.Means, L->Means, Vertex);
    Finite &= take(S.LogScales, L->LogScales, Vertex);
    Finite &= take(S.Quats, L->Quats, Vertex);
    Finite &= take(S.OpacityLogits, L->Opacity, Vertex);
    Finite &= take(S.Sh, L->Sh, Vertex);
    if (!Finite)
      return Error{Path, fmt::format("vertex {} holds a NaN or an infinity, "
                                     "expected finite values",
                                     I)};
  }
  return S;
}

Expected<Success> writePly(const std::string &Path, const Scene &S) {
  const std::size_t Later = S.coefficients() - 1;
  std::string Out = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n", S.size());
  const auto Declare = [&](const std::string &Name) {
    Out += fmt::format("property float {}\n", Name);
  };
  for (const char *Name : {"x", "y", "z", "nx", "ny", "nz"})
    Declare(Name);
  for (int C = 0; C < 3; ++C)
    Declare(fmt::format("f_dc_{}", C));
  for (std::size_t K = 0; K < 3 * Later; ++K)
    Declare(fmt::format("f_rest_{}", K));
  Declare("opacity");
  for (int C = 0; C < 3; ++C)
    Declare(fmt::format("scale_{}", C));
  for (int C = 0; C < 4; ++C)
    Declare(fmt::format("rot_{}", C));
  Out += "end_header\n";

  const auto Put = [&](const float *Values, std::size_t Count) {
    Out.append(reinterpret_cast<const char *>(Values), Count * sizeof(float));
  };
  const std::array<float, 3> NoNormal{};
  for (std::size_t I = 0; I < S.size(); ++I) {
    Put(&S.Means[3 * I], 3);
    Put(NoNormal.data(), 3);
    const float *Sh = &S.Sh[3 * (Later + 1) * I];
    Put(Sh, 3);
    for (std::size_t C = 0; C < 3; ++C)
      for (std::size_t K = 1; K <= Later; ++K)
        Put(Sh + 3 * K + C, 1);
    Put(&S.OpacityLogits[I], 1);
    Put(&S.LogScales[3 * I], 3);
    Put(&S.Quats[4 * I], 4);
  }
  return writeFileAtomically(Path, Out);
}

} // namespace vorion::splat
