#include "commands/Commands.h"
#include "commands/InputFiles.h"
#include "commands/MeshArguments.h"
#include "commands/OutputFile.h"
#include "commands/SceneArguments.h"
#include "commands/SceneEdits.h"
#include "io/Hash.h"
#include "io/ReportHead.h"
#include "scene/Edit.h"
#include "scene/LocalFrame.h"
#include "scene/SceneWriter.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"

#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

namespace {

using Json = nlohmann::ordered_json;

struct ConvertArguments {
  SceneArguments Scene;
  std::vector<std::string> More;
  std::string Output, JsonFile;
  SceneEdits Edits;
};

/// What the file does not have of the scene that was read.
void printLoss(const std::string &Path, const WrittenScene &W, const Scene &S,
               const Drawing &D) {
  if (!W.KeepsDrawing)
    printDiagnostic(
        "splat", "warning", Path,
        fmt::format("the format does not record the rendering "
                    "mode, expected {}{}{} when rendering it",
                    D.Renderer == RendererKind::Splat
                        ? ""
                        : fmt::format("--renderer {}", name(D.Renderer)),
                    D.Antialiased ? "--antialiased" : "",
                    D.Dilation ? fmt::format(" --dilation {}", *D.Dilation)
                               : ""));
  if (needsDoubles(S)) {
    if (W.Lost.Position > 0)
      printDiagnostic("splat", "warning", Path,
                      fmt::format("the format has too few digits for these "
                                  "coordinates, and moves Gaussians by up to "
                                  "{:.2g}, expected .ply, or --translate to "
                                  "the origin",
                                  W.Lost.Position));
    else
      printOut("positions are doubles: fp32 has too few digits for these "
               "coordinates\n");
  }
  const struct {
    const char *Name;
    double Most;
  } Parts[] = {{"position", W.Lost.Position}, {"log scale", W.Lost.LogScale},
               {"rotation", W.Lost.Rotation}, {"opacity", W.Lost.Opacity},
               {"colour", W.Lost.Color},      {"harmonics", W.Lost.Harmonics}};
  std::vector<std::string> Lost;
  for (const auto &[Name, Most] : Parts)
    if (Most > 0)
      Lost.push_back(fmt::format("{} {:.2g}", Name, Most));
  if (W.ShDegree < S.ShDegree)
    Lost.push_back(fmt::format(
        "spherical harmonics above degree {} are dropped", W.ShDegree));
  printOut("{}\n", Lost.empty() ? "nothing is lost"
                                : fmt::format("lost at most: {}",
                                              fmt::join(Lost, ", ")));
}

/// The triangles of a file, for a `.glb`, in the axes of \p First.
Expected<Success> joinMesh(const SceneArguments &First, const std::string &Path,
                           std::optional<Mesh> &To) {
  auto Read = loadMesh(Path);
  if (!Read)
    return Read.error();
  const auto Change = axesChangeOf(First);
  if (!Change)
    return Change.error();
  changeAxes(*Read, *Change);
  if (To)
    To->append(std::move(*Read));
  else
    To = std::move(*Read);
  return Success{};
}

/// Joins the scenes \p More with \p To, each read as the first was. With
/// \p Meshes a file may be a mesh, which is joined with that.
Expected<Success> joinOthers(const SceneArguments &First,
                             const std::vector<std::string> &More,
                             SceneFile &To, std::optional<Mesh> *Meshes) {
  for (const std::string &Path : More) {
    if (Meshes && !std::filesystem::is_directory(Path)) {
      const auto Content = readFile(Path);
      if (!Content)
        return Content.error();
      if (isMeshFile(*Content)) {
        if (auto Joined = joinMesh(First, Path, *Meshes); !Joined)
          return Joined;
        continue;
      }
    }
    SceneArguments Other = First;
    Other.Path = Path;
    auto Read = loadScene(Other);
    if (!Read)
      return Read.error();
    if (!Read->DrawnAs.drawsAs(To.DrawnAs))
      return Error{Path, "has another rendering mode than the preceding scenes "
                         "(antialiased, dilation, renderer), expected "
                         "--antialiased or --no-antialiased, and --dilation, "
                         "for all"};
    To.Dropped += Read->Dropped;
    if (Meshes && Read->Meshes > 0)
      if (auto Joined = joinMesh(First, Path, *Meshes); !Joined)
        return Joined;
    join(To.Gaussians, std::move(Read->Gaussians));
  }
  return Success{};
}

/// The scenes that are read, with their hashes: asked for before any is
/// written.
Expected<Json> inputsOf(const ConvertArguments &A) {
  std::vector<std::string> Paths{A.Scene.Path};
  Paths.insert(Paths.end(), A.More.begin(), A.More.end());
  Json Inputs = Json::array();
  for (const std::string &Path : Paths) {
    auto Hash = hashScene(Path);
    if (!Hash)
      return Hash.error();
    Inputs.push_back({{"file", Path}, {"fnv1a64", *Hash}});
  }
  return Inputs;
}

std::string jsonReport(Json Inputs, const SceneFile &F, std::size_t Read,
                       const SceneChanges &Changes, const WrittenScene &W) {
  Json LeftOut = Json::array();
  for (const auto &[Text, Rule, Gaussians] : Changes.Left)
    LeftOut.push_back({{"rule", Rule}, {"gaussians", Gaussians}});
  Json Lost = Json::object();
  for (const auto &[Name, Most] : byName(W.Lost))
    Lost[std::string(Name)] = Most;
  Json Report = reportHead("splat-convert");
  Report.update(
      {{"scenes", std::move(Inputs)},
       {"gaussians_read", Read},
       {"dropped_nonfinite", F.Dropped},
       {"left_out", std::move(LeftOut)},
       {"reordered", Changes.Reordered ? Json(*Changes.Reordered) : Json()},
       {"gaussians", F.Gaussians.size()},
       {"sh_degree", W.ShDegree},
       {"antialiased", F.DrawnAs.Antialiased},
       {"dilation", F.DrawnAs.Dilation ? Json(*F.DrawnAs.Dilation) : Json()},
       {"keeps_drawing", W.KeepsDrawing},
       {"lost", std::move(Lost)},
       {"result_fnv1a64", W.Hash}});
  return jsonText(Report, 2) + "\n";
}

Expected<Success> run(const ConvertArguments &A) {
  if (auto Checked = checkEnding("-o", A.Output, writtenEndings()); !Checked)
    return Checked;
  if (auto Checked = checkJsonName(A.JsonFile); !Checked)
    return Checked;
  // A folder of chunks would be another scene with such a file.
  const auto IndexOf = [](const std::string &Path) {
    return (std::filesystem::path(Path) / "meta.json").string();
  };
  InputFiles Inputs;
  Inputs.scene(A.Scene.Path).file("the scene", IndexOf(A.Scene.Path));
  for (const std::string &Path : A.More) {
    const std::string Name = "the scene " + escaped(Path);
    Inputs.scene(Path, Name).file(Name, IndexOf(Path));
  }
  if (auto Claimed = claimOutputs({{"-o", A.Output}, {"--json", A.JsonFile}},
                                  Inputs.named());
      !Claimed)
    return Claimed;
  Json Hashed;
  if (!A.JsonFile.empty()) {
    auto Of = inputsOf(A);
    if (!Of)
      return Of.error();
    Hashed = std::move(*Of);
  }
  // Of the formats that are written only this one has meshes.
  const bool HasMeshes = A.Output.ends_with(".glb");
  SceneArguments First = A.Scene;
  First.KeepsMeshes = HasMeshes;
  auto File = loadScene(First);
  if (!File)
    return File.error();
  std::optional<Mesh> Triangles;
  if (HasMeshes && File->Meshes > 0)
    if (auto Joined = joinMesh(First, A.Scene.Path, Triangles); !Joined)
      return Joined;
  if (auto Joined =
          joinOthers(First, A.More, *File, HasMeshes ? &Triangles : nullptr);
      !Joined)
    return Joined;
  const std::size_t Read = File->Gaussians.size();
  const auto Changes = editScene(File->Gaussians, A.Edits);
  if (!Changes)
    return Changes.error();
  if (Triangles)
    if (auto Moved = moveMesh(*Triangles, A.Edits); !Moved)
      return Moved;
  for (const auto &Left : Changes->Left)
    printOut("{}\n", Left.Text);
  if (Changes->Reordered)
    printOut("reordered {} of {} Gaussians along the Morton curve\n",
             *Changes->Reordered, File->Gaussians.size());
  const auto Written =
      writeScene(A.Output, File->Gaussians, File->DrawnAs, [&](GltfWriter &To) {
        if (Triangles)
          addMesh(To, *Triangles);
      });
  if (!Written)
    return Written.error();
  if (!A.JsonFile.empty())
    if (auto Said = writeFileAtomically(
            A.JsonFile,
            jsonReport(std::move(Hashed), *File, Read, *Changes, *Written));
        !Said)
      return Said;
  printOut("{}: {}{}, SH degree {}{}\n", escaped(A.Output),
           counted(File->Gaussians.size(), "Gaussian"),
           Triangles ? ", " + counted(Triangles->triangles(), "triangle") : "",
           Written->ShDegree,
           File->DrawnAs.Antialiased ? ", trained antialiased" : "");
  printLoss(A.Output, *Written, File->Gaussians, File->DrawnAs);
  return Success{};
}

} // namespace

Runner addConvert(CLI::App &App) {
  auto A = std::make_shared<ConvertArguments>();
  addSceneOptions(App, A->Scene);
  takesFile(App.add_option("more", A->More,
                           "Further scenes, appended to the first; for a .glb "
                           "also meshes (.obj, .ply, .glb, .gltf)"));
  writesFile(
      App.add_option(
          "-o,--output", A->Output,
          fmt::format("Scene to write; the file extension selects the format: "
                      "{} (.ply is INRIA's PLY, which is lossless; a .glb may "
                      "have meshes)",
                      fmt::join(writtenEndings(), ", "))),
      {writtenEndings().begin(), writtenEndings().end()})
      ->required();
  addEditOptions(App, A->Edits);
  writesFile(App.add_option("--json", A->JsonFile,
                            "Write a report with the edits and the losses"),
             {".json"});
  return [A](const DeviceOptions &) { return run(*A); };
}

} // namespace vorion::splat
