#include "scene/ForeignFile.h"

#include "scene/SceneFile.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {
namespace {

/// How a kind of file is known.
enum class By {
  Mark,  ///< the file has the bytes \c What, at \c At
  Line,  ///< a text; its first line, or the first that is no comment, begins so
  Entry, ///< an archive that has a name with this ending
  Key    ///< an object in JSON that has this key
};

struct ForeignKind {
  By Known;
  std::string_view What;
  std::string_view Name; ///< "a picture"
  std::string_view Todo; ///< what the user may do
  std::size_t At = 0;
};

using namespace std::string_view_literals;

constexpr std::string_view Export =
    "export it as .ply with the program that trained it (nerfstudio: ns-export "
    "gaussian-splat)";
constexpr std::string_view Convert =
    "if Gaussians are in it, export them as .ply with the program that wrote "
    "it";
constexpr std::string_view Train =
    "`splat train` makes a scene from photographs whose cameras are known";
constexpr std::string_view Unpack = "unpack it, and name the scene in it";
constexpr std::string_view Folder = "unpack it, and name the folder";
constexpr std::string_view Cameras =
    "name it with --cameras, and the scene beside it";

/// The first that fits decides. A mark has at least three bytes, so that no
/// `.splat` has it by chance.
constexpr ForeignKind Kinds[] = {
    {By::Mark, "\x80\x02\x8a\x0a\x6c\xfc\x9c\x46"sv, "a checkpoint of PyTorch",
     Export},
    {By::Mark, "\x80\x02}"sv, "a pickle of Python", Export},
    {By::Mark, "\x80\x03}"sv, "a pickle of Python", Export},
    {By::Mark, "\x80\x04\x95"sv, "a pickle of Python", Export},
    {By::Mark, "\x80\x05\x95"sv, "a pickle of Python", Export},
    {By::Mark, "\x93NUMPY"sv, "an array of NumPy", Export},
    {By::Mark, "\x89HDF\r\n\x1a\n"sv, "an HDF5 file", Export},
    {By::Mark, "\x4b\x67\x00\x00"sv, "a .splatv, whose Gaussians move",
     "export one moment of it as .ply"},
    {By::Mark, "PXR-USDC"sv, "a USD file", Convert},
    {By::Mark, "Kaydara FBX Binary"sv, "an FBX file", Convert},
    {By::Mark, "BLENDER"sv, "a file of Blender", Convert},
    {By::Mark, "LASF"sv, "a point cloud (LAS or LAZ)", Train},
    {By::Mark, "ASTM-E57"sv, "a point cloud (E57)", Train},
    {By::Mark, "DRACO"sv, "a mesh or point cloud of Draco", Train},
    {By::Mark, "\x89PNG\r\n\x1a\n"sv, "a picture (PNG)", Train},
    {By::Mark, "\xff\xd8\xff"sv, "a picture (JPEG)", Train},
    {By::Mark, "\x76\x2f\x31\x01"sv, "a picture (EXR)", Train},
    {By::Mark, "WEBP"sv, "a picture (WebP)",
     "name SOG's meta.json if this is one of its pictures", 8},
    {By::Mark, "ftyp"sv, "a video (MP4 or MOV)", Train, 4},
    {By::Mark, "ustar"sv, "a tar archive", Unpack, 257},
    {By::Mark, "7z\xbc\xaf\x27\x1c"sv, "a 7z archive", Unpack},
    {By::Mark, "\x28\xb5\x2f\xfd"sv, "a file packed by zstd", Unpack},

    {By::Line, "# .PCD"sv, "a point cloud (PCD)", Train},
    {By::Line, "VERSION "sv, "a point cloud (PCD)", Train},
    {By::Line, "mtllib "sv, "a mesh (OBJ)", Train},
    {By::Line, "o "sv, "a mesh (OBJ)", Train},
    {By::Line, "g "sv, "a mesh (OBJ)", Train},
    {By::Line, "v "sv, "a mesh (OBJ)", Train},
    {By::Line, "solid "sv, "a mesh (STL)", Train},
    {By::Line, "; FBX"sv, "an FBX file", Convert},
    {By::Line, "#usda"sv, "a USD file", Convert},
    {By::Line, "version https://git-lfs"sv, "a pointer of Git LFS",
     "fetch the file itself with `git lfs pull`"},
    {By::Line, "<"sv, "a web page or other XML",
     "fetch the file itself, perhaps by another link"},
    {By::Line, "["sv, "a list in JSON, as cameras.json is", Cameras},

    {By::Entry, "data.pkl"sv, "a checkpoint of PyTorch", Export},
    {By::Entry, ".npy"sv, "arrays of NumPy (.npz)", Export},
    {By::Entry, ".usdc"sv, "a USD file (USDZ)", Convert},
    {By::Entry, ".usda"sv, "a USD file (USDZ)", Convert},
    {By::Entry, ".usd"sv, "a USD file (USDZ)", Convert},
    {By::Entry, "lod-meta.json"sv, "a zip archive of a streamed SOG", Folder},
    {By::Entry, "/meta.json"sv, "a zip archive of a folder with SOG", Folder},
    {By::Entry, ""sv, "a zip archive without the meta.json of SOG", Unpack},

    {By::Key, "frames"sv, "a list of cameras, as transforms.json is", Cameras},
    {By::Key, "camera_path"sv, "a camera path of nerfstudio", Cameras},
    {By::Key, "keyframes"sv, "a camera path of nerfstudio", Cameras},
    {By::Key, ""sv, "JSON that describes no scene",
     "SOG has a meta.json or lod-meta.json, glTF has the key asset"},
};

/// The error of the first kind that is known \p Known and \p Fits.
template <typename Predicate>
std::optional<Error> firstOf(const std::string &Where, By Known,
                             Predicate Fits) {
  for (const ForeignKind &K : Kinds)
    if (K.Known == Known && Fits(K))
      return Error{Where, fmt::format("{}, expected a scene of Gaussians; {}",
                                      K.Name, K.Todo)};
  return std::nullopt;
}

/// As much of \p File as is looked at.
std::string_view beginningOf(Bytes File) {
  return asText(File).substr(0, 4096);
}

/// The first line of \p Text that is not empty and, if so wanted, no comment.
std::string_view firstLine(std::string_view Text, bool SkipComments) {
  while (!Text.empty()) {
    const std::size_t End = std::min(Text.find('\n'), Text.size());
    const std::string_view Line = trimmed(Text.substr(0, End), " \t\r\f");
    if (!Line.empty() && !(SkipComments && Line.starts_with('#')))
      return Line;
    Text.remove_prefix(std::min(End + 1, Text.size()));
  }
  return {};
}

} // namespace

bool isText(Bytes File) {
  const std::string_view Start = beginningOf(File);
  std::size_t Others = 0;
  for (const char C : Start) {
    const auto Byte = static_cast<unsigned char>(C);
    if (Byte == 0x7f ||
        (Byte < ' ' && "\t\n\r\f"sv.find(C) == std::string_view::npos))
      return false;
    Others += Byte > 0x7f;
  }
  return !Start.empty() && 8 * Others <= Start.size();
}

std::optional<Error> foreignFile(const std::string &Where, Bytes File) {
  const std::string_view Start = beginningOf(File);
  if (auto Marked = firstOf(Where, By::Mark, [&](const ForeignKind &K) {
        return Start.size() > K.At && Start.substr(K.At).starts_with(K.What);
      }))
    return Marked;
  if (!isText(File))
    return std::nullopt;
  const std::string_view First = firstLine(Start, false),
                         Later = firstLine(Start, true);
  if (auto Known = firstOf(Where, By::Line, [&](const ForeignKind &K) {
        return First.starts_with(K.What) || Later.starts_with(K.What);
      }))
    return Known;
  return unknownFile(Where);
}

Error foreignArchive(const std::string &Where,
                     const std::vector<std::string> &Names) {
  return *firstOf(Where, By::Entry, [&](const ForeignKind &K) {
    return K.What.empty() ||
           std::ranges::any_of(Names, [&](const std::string &Name) {
             return Name.ends_with(K.What);
           });
  });
}

Error foreignJson(const std::string &Where, const nlohmann::json &Root) {
  return *firstOf(Where, By::Key, [&](const ForeignKind &K) {
    return K.What.empty() || Root.contains(K.What);
  });
}

Error unknownFile(const std::string &Where) {
  std::string Endings;
  for (const SceneFormatRecord &F : sceneFormats())
    if (F.Format != SceneFormat::Splat && !F.Ending.empty())
      Endings += std::string(F.Ending) + ", ";
  return {Where,
          fmt::format("not a scene of a known format, expected {}or .splat of "
                      "32 bytes a Gaussian",
                      Endings)};
}

} // namespace vorion::splat
