#include "scene/formats/SogFolder.h"

#include "io/Inside.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

namespace vorion::splat {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr const char *IndexName = "lod-meta.json";
constexpr const char *MetaName = "meta.json";

/// Reads files below \p Folder, and none outside that a description names.
FileSource filesOf(const fs::path &Folder) {
  return [Folder](const std::string &Name,
                  std::size_t Most) -> Expected<std::vector<std::byte>> {
    if (!staysInside(Name))
      return Error{
          Folder.string(),
          fmt::format(
              "refers to the file `{}`, expected a file inside the folder",
              printable(Name))};
    return readRegularFile((Folder / Name).string(), Most);
  };
}

/// The same, but no file twice: of a scene that says the same thing again and
/// again, memory would follow what it says and not its size.
FileSource withoutRepeats(const std::string &Where, const FileSource &Read) {
  return [&Where, &Read, Names = std::set<std::string>()](
             const std::string &Name,
             std::size_t Most) mutable -> Expected<std::vector<std::byte>> {
    if (!Names.insert(fs::path(Name).lexically_normal().string()).second)
      return Error{
          Where,
          fmt::format(
              "refers to the file `{}` twice, expected one reference per file",
              printable(Name))};
    return Read(Name, Most);
  };
}

/// The data set whose description is \p Meta, a path from where \p Read starts.
Expected<SogData> openDataSet(const std::string &Where, const std::string &Meta,
                              const FileSource &Read) {
  const auto Content = Read(Meta, JsonLimits().Bytes);
  if (!Content)
    return Content.error();
  const fs::path Folder = fs::path(Meta).parent_path();
  const std::string Inside =
      Folder.empty() ? Where : Where + "/" + printable(Folder.string());
  return SogData::open(Inside, Inside + ": " + MetaName, *Content,
                       [&](const std::string &Name, std::size_t Most) {
                         return Read((Folder / Name).string(), Most);
                       });
}

/// Gaussians \p Offset to \p Offset + \p Count of a data set.
struct Run {
  uint64_t Offset = 0, Count = 0;
};

/// Joins data sets of one scene. Their Gaussians are written when all are
/// known, each to its place: a scene of many megabytes is in memory once.
class Joiner {
public:
  explicit Joiner(const ReadOptions &Options) : Options(Options) {}

  /// Takes \p Runs of \p Data.
  Expected<Success> add(const std::string &Where, SogData Data,
                        std::vector<Run> Runs) {
    const SceneFile &Head = Data.head();
    if (Parts.empty()) {
      Result.Version = Head.Version;
      Result.Gaussians.ShDegree = Head.Gaussians.ShDegree;
      Result.DrawnAs = Head.DrawnAs;
    }
    if (!Options.Drawn.Antialiased && !Head.DrawnAs.drawsAs(Result.DrawnAs))
      return Error{
          Where, fmt::format("{}, expected {} as in the first chunk, or "
                             "--antialiased or --no-antialiased to decide",
                             sourceOf(Head.DrawnAs), sourceOf(Result.DrawnAs))};
    if (Result.Gaussians.ShDegree != Head.Gaussians.ShDegree)
      return Error{Where, fmt::format("SH degree {}, expected {} as in the "
                                      "first chunk",
                                      Head.Gaussians.ShDegree,
                                      Result.Gaussians.ShDegree)};
    std::ranges::sort(Runs, {}, &Run::Offset);
    const uint64_t Size = Data.size();
    uint64_t End = 0, Count = 0;
    for (const Run &R : Runs) {
      if (R.Offset < End || R.Offset > Size || R.Count > Size - R.Offset)
        return Error{Where,
                     fmt::format("Gaussians {} to {} + {} of {} are listed, "
                                 "expected disjoint ranges inside the chunk",
                                 R.Offset, R.Offset, R.Count, Size)};
      End = R.Offset + R.Count;
      Count += R.Count;
    }
    Total += Count;
    Parts.push_back({std::move(Data), std::move(Runs), Count});
    return Success{};
  }

  /// Takes all of \p Data.
  Expected<Success> add(const std::string &Where, SogData Data) {
    const uint64_t Size = Data.size();
    return add(Where, std::move(Data), {{0, Size}});
  }

  /// The scene.
  Expected<SceneFile> join() {
    Scene &S = Result.Gaussians;
    S = Scene::sized(Total, S.ShDegree);
    Result.Files = Parts.size();
    std::size_t At = 0;
    for (; !Parts.empty(); Parts.pop_front()) {
      Part &P = Parts.front();
      if (auto Placed = place(P, At); !Placed)
        return Placed.error();
      At += P.Count;
    }
    return std::move(Result);
  }

private:
  struct Part {
    SogData Data;
    std::vector<Run> Runs; ///< by their offsets
    uint64_t Count;        ///< Gaussians of all of them
  };

  Expected<Success> place(Part &P, std::size_t At) {
    if (P.Count == P.Data.size())
      return P.Data.unpack(Result.Gaussians, At);
    Scene Whole = Scene::sized(P.Data.size(), Result.Gaussians.ShDegree);
    if (auto Unpacked = P.Data.unpack(Whole, 0); !Unpacked)
      return Unpacked;
    for (const Run &R : P.Runs) {
      copy(Whole, R.Offset, R.Count, Result.Gaussians, At);
      At += R.Count;
    }
    return Success{};
  }

  static std::string sourceOf(const Drawing &D) {
    return D.Source.empty() ? "no model" : D.Source;
  }

  const ReadOptions &Options;
  SceneFile Result{{}, SceneFormat::StreamedSog, 0, {}, 0, {}, 0};
  std::deque<Part> Parts;
  std::size_t Total = 0;
};

/// Sub-folders of \p Path that hold a data set, by name.
std::vector<std::string> chunksOf(const fs::path &Path) {
  std::vector<std::string> Names;
  std::error_code Ignored;
  for (fs::directory_iterator It(Path, Ignored), End; It != End;
       It.increment(Ignored))
    if (fs::is_regular_file(It->path() / MetaName, Ignored))
      Names.push_back(It->path().filename().string());
  std::sort(Names.begin(), Names.end());
  return Names;
}

Expected<SceneFile> readChunks(const std::string &Path,
                               const ReadOptions &Options) {
  const auto Names = chunksOf(Path);
  if (Names.empty())
    return Error{Path, "a folder without a scene, expected a scene file, or a "
                       "folder with SOG's meta.json or lod-meta.json"};
  // Writers call a chunk LEVEL_NUMBER. Several levels would be the same scene
  // several times, and only the index says which belong together.
  std::set<std::string> Levels;
  for (const std::string &Name : Names)
    if (Name.find('_') != std::string::npos)
      Levels.insert(Name.substr(0, Name.find('_')));
  if (Levels.size() > 1)
    return Error{Path, fmt::format("chunks of {} levels of detail, expected "
                                   "one level, or {} to select one",
                                   Levels.size(), IndexName)};
  Joiner J(Options);
  const FileSource Files = filesOf(Path), Read = withoutRepeats(Path, Files);
  for (const std::string &Name : Names) {
    auto Data = openDataSet(Path, fmt::format("{}/{}", Name, MetaName), Read);
    if (!Data)
      return Data.error();
    if (auto Added = J.add(fmt::format("{}/{}", Path, Name), std::move(*Data));
        !Added)
      return Added.error();
  }
  return J.join();
}

/// The runs of one level of detail, by chunk, from the tree of an index. The
/// tree is walked without recursion: a damaged file may nest it deeply.
class TreeWalk {
public:
  TreeWalk(const Json &Index, int Level)
      : Files(Index["filenames"].size()), Level(std::to_string(Level)) {
    Pending.push_back(&Index["tree"]);
  }

  /// What is wrong with the tree, if anything.
  std::optional<std::string> walk() {
    while (!Pending.empty()) {
      const Json &Node = *Pending.back();
      Pending.pop_back();
      if (!Node.is_object())
        return "a node of the tree is not an object, expected children or lods";
      if (const auto Children = Node.find("children"); Children != Node.end())
        for (const Json &Child : *Children)
          Pending.push_back(&Child);
      if (const auto Lods = Node.find("lods"); Lods != Node.end())
        if (auto Problem = leaf(*Lods))
          return Problem;
    }
    return std::nullopt;
  }

  std::map<std::size_t, std::vector<Run>> Runs;

private:
  static std::optional<uint64_t> number(const Json &Leaf, const char *Key) {
    const auto V = Leaf.find(Key);
    if (V == Leaf.end() || !V->is_number_unsigned())
      return std::nullopt;
    return V->get<uint64_t>();
  }

  std::optional<std::string> leaf(const Json &Lods) {
    if (!Lods.is_object())
      return "lods of the tree is not an object, expected ranges by level";
    const auto Entry = Lods.find(Level);
    if (Entry == Lods.end())
      return std::nullopt; // nothing there at this level
    if (!Entry->is_object())
      return "a range of the tree is not an object, expected file, offset and "
             "count";
    const auto File = number(*Entry, "file"), Offset = number(*Entry, "offset"),
               Count = number(*Entry, "count");
    if (!File || !Offset || !Count || *File >= Files)
      return fmt::format("a range of the tree is incomplete, expected file "
                         "(below {}), offset and count",
                         Files);
    Runs[*File].push_back({*Offset, *Count});
    return std::nullopt;
  }

  std::size_t Files;
  std::string Level;
  std::vector<const Json *> Pending;
};

Expected<Success> checkIndex(const std::string &Where, const Json &Index,
                             const ReadOptions &Options) {
  if (!Index.is_object())
    return Error{Where, "not a JSON object, expected the index of a streamed "
                        "SOG scene"};
  // Files from before the format had versions have none.
  if (const auto V = Index.find("version"); V != Index.end() && *V != 1)
    return Error{Where, "unsupported version of the index, expected 1"};
  const auto Levels = Index.find("lodLevels");
  if (Levels == Index.end() || !Levels->is_number_unsigned() || *Levels == 0)
    return Error{Where, "lodLevels is not a whole number, expected 1 or more"};
  if (*Levels <= Options.LevelOfDetail)
    return Error{Where,
                 fmt::format("no level of detail {}, expected less than {}",
                             Options.LevelOfDetail, Levels->get<uint64_t>()),
                 ExitCode::Usage};
  const auto Files = Index.find("filenames");
  if (Files == Index.end() || !Files->is_array() ||
      !std::all_of(Files->begin(), Files->end(),
                   [](const Json &F) { return F.is_string(); }))
    return Error{Where,
                 "filenames is not a list of strings, expected the chunks"};
  if (!Index.contains("tree"))
    return Error{Where, "no tree, expected the bounds of chunks"};
  return Success{};
}

} // namespace

Expected<SceneFile> parseStreamedSog(const std::string &Where, Bytes Content,
                                     const FileSource &Files,
                                     const ReadOptions &Options) {
  const std::string IndexWhere = Where + ": " + IndexName;
  const auto Parsed = parseJson<Json>(asText(Content), IndexWhere,
                                      "the index of a streamed SOG scene");
  if (!Parsed)
    return Parsed.error();
  const Json &Index = *Parsed;
  if (auto Checked = checkIndex(IndexWhere, Index, Options); !Checked)
    return Checked.error();
  TreeWalk Tree(Index, Options.LevelOfDetail);
  if (auto Problem = Tree.walk())
    return Error{IndexWhere, *Problem};

  const FileSource Read = withoutRepeats(IndexWhere, Files);
  Joiner J(Options);
  for (auto &[File, Runs] : Tree.Runs) {
    const auto Name = Index["filenames"][File].get<std::string>();
    auto Data = openDataSet(Where, Name, Read);
    if (!Data)
      return Data.error();
    if (auto Added = J.add(Where + ": " + printable(Name), std::move(*Data),
                           std::move(Runs));
        !Added)
      return Added.error();
  }
  if (const auto E = Index.find("environment");
      E != Index.end() && E->is_string()) {
    auto Data = openDataSet(Where, E->get<std::string>(), Read);
    if (!Data)
      return Data.error();
    if (auto Added = J.add(Where + ": environment", std::move(*Data)); !Added)
      return Added.error();
  }
  return J.join();
}

Expected<SceneFile> readSogFolder(const std::string &Path,
                                  const ReadOptions &Options) {
  std::error_code Ignored;
  for (const char *Name : {IndexName, MetaName})
    if (const fs::path File = fs::path(Path) / Name;
        fs::exists(File, Ignored)) {
      const auto Content = readRegularFile(File.string(), JsonLimits().Bytes);
      if (!Content)
        return Content.error();
      return readSogJson(File.string(), *Content, Options);
    }
  return readChunks(Path, Options);
}

/// The keys of an index, and of a description.
static constexpr const char *IndexKeys[] = {"tree", "lodLevels"};
static constexpr const char *MeansKey = "means";

bool isSogJson(Bytes File) {
  const std::string_view Text = asText(File);
  const auto IsNamed = [&](const char *Key) {
    return Text.find(fmt::format("\"{}\"", Key)) != std::string_view::npos;
  };
  // Most files of glTF are not parsed for this.
  if (!IsNamed(MeansKey) && std::ranges::none_of(IndexKeys, IsNamed))
    return false;
  const auto Root = parseJson<Json>(Text, "", "a description of a scene");
  if (!Root || !Root->is_object())
    return false;
  return Root->contains(MeansKey) ||
         std::ranges::any_of(
             IndexKeys, [&](const char *Key) { return Root->contains(Key); });
}

Expected<SceneFile> readSogJson(const std::string &Path, Bytes File,
                                const ReadOptions &Options) {
  fs::path Folder = fs::path(Path).parent_path();
  if (Folder.empty())
    Folder = ".";
  const auto Root =
      parseJson<Json>(asText(File), Path, "SOG's description or an index");
  if (!Root)
    return Root.error();
  if (std::ranges::any_of(IndexKeys,
                          [&](const char *Key) { return Root->contains(Key); }))
    return parseStreamedSog(Folder.string(), File, filesOf(Folder), Options);
  return parseSogData(Folder.string(), Path, File, filesOf(Folder));
}

} // namespace vorion::splat
