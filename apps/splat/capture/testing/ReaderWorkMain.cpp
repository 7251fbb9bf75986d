// splat-reader-work: has every reader read something of one size and of ten
// times the size, each in a readOnce() of its own number.
// test/render/Inputs/linear.py counts the instructions of these.
#include "capture/Colmap.h"
#include "capture/Transforms.h"
#include "capture/testing/CaptureWriters.h"
#include "io/Npz.h"
#include "scene/formats/Formats.h"
#include "scene/formats/Ply.h"
#include "scene/formats/SogFolder.h"
#include "scene/testing/SceneWriters.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/TemporaryFolder.h"

#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;
using Json = nlohmann::json;

/// Whether what was read is right; asked so that nothing is left out.
using Reading = std::function<bool()>;

/// Each call under a name of its own, by which its work is counted.
template <std::size_t Call>
[[gnu::noinline]] bool readOnce(const Reading &Read) {
  return Read();
}

namespace {

constexpr std::size_t MostCalls = 40;

/// Calls the readOnce() of number \p Call.
template <std::size_t... Calls>
bool readNumbered(std::size_t Call, const Reading &Read,
                  std::index_sequence<Calls...> /*All*/) {
  return ((Calls == Call && readOnce<Calls>(Read)) || ...);
}

/// One reader, and how to make what takes it \p Size of work.
struct Reader {
  const char *Name;
  std::size_t Size;
  std::function<Reading(std::size_t Size)> Prepare;
};

Bytes bytesOf(const std::string &Text) {
  return std::as_bytes(std::span(Text));
}

Reading scene(std::string File) {
  return [File = std::move(File)] {
    return static_cast<bool>(parseScene("file", bytesOf(File)));
  };
}

/// \p Ply with \p Lines in front of its first element.
std::string withHeader(std::string Ply, const std::string &Lines) {
  return Ply.insert(Ply.find("element"), Lines);
}

/// So many times what \p Line makes of a number.
std::string repeated(std::size_t Count,
                     const std::function<std::string(std::size_t)> &Line) {
  std::string Lines;
  for (std::size_t I = 0; I < Count; ++I)
    Lines += Line(I);
  return Lines;
}

Reading plyProperties(std::size_t Size) {
  // A vertex of one row has a byte for each property.
  const std::string Ply = formatPly(randomScene(1, 0, 1));
  return scene(std::string(Ply).insert(
                   Ply.find("end_header"),
                   repeated(Size,
                            [](std::size_t I) {
                              return fmt::format("property uchar p{}\n", I);
                            })) +
               std::string(Size, '\0'));
}

Reading plyElements(std::size_t Size) {
  const std::string File =
      "ply\nformat binary_little_endian 1.0\n" +
      repeated(Size,
               [](std::size_t I) {
                 return fmt::format("element e{} 0\nproperty uchar p\n", I);
               }) +
      "end_header\n";
  // Of a scene that many elements are one error, at the header's end.
  return [File] { return !parsePly("file", bytesOf(File), {}); };
}

Reading sog(std::size_t Size) {
  return scene(zipOf(sogOf(randomScene(Size, 1, 1))));
}

Reading glb(std::size_t Size) {
  return scene(glbOf(gltfOf(randomScene(Size, 1, 1))));
}

/// One chunk in so many runs.
Reading streamedSog(std::size_t Size) {
  Folder Files;
  for (auto &[Name, Content] : sogOf(randomScene(Size, 0, 1)))
    Files["c/" + Name] = std::move(Content);
  Json Leaves = Json::array();
  for (std::size_t I = 0; I < Size; ++I)
    Leaves.push_back(
        {{"lods", {{"0", {{"file", 0}, {"offset", I}, {"count", 1}}}}}});
  const std::string Index = Json{
      {"version", 1},
      {"lodLevels", 1},
      {"filenames", {"c/meta.json"}},
      {"tree",
       {{"children", Leaves}}}}.dump();
  return [Files, Index] {
    const auto Read = parseStreamedSog(
        "scene", bytesOf(Index),
        [&](const std::string &Name,
            std::size_t /*Most*/) -> Expected<std::vector<std::byte>> {
          const Bytes B = bytesOf(Files.at(Name));
          return std::vector<std::byte>(B.begin(), B.end());
        },
        {});
    return static_cast<bool>(Read);
  };
}

Reading cameras(std::size_t Size, const std::string &Folder) {
  std::vector<Camera> All(Size, Camera::ahead(64, 48, 50));
  for (std::size_t I = 0; I < Size; ++I)
    All[I].Name = fmt::format("view{}", I);
  const std::string Path = fmt::format("{}/{}.json", Folder, Size);
  if (!writeCameras(Path, All))
    return [] { return false; };
  return [Path, Last = All.back().Name] {
    return static_cast<bool>(readCamera(Path, Last));
  };
}

SampleCapture captureOf(std::size_t Size) {
  SampleCapture C = sampleCapture(Size);
  C.Points.resize(Size, C.Points.front());
  return C;
}

Reading colmap(std::size_t Size, bool Text) {
  const SampleCapture C = captureOf(Size);
  const Folder Files = Text ? colmapTextOf(C) : colmapBinaryOf(C);
  return [Files, Text] {
    const std::string Ending = Text ? ".txt" : ".bin";
    const ColmapFiles F{
        {"cameras", bytesOf(Files.at("sparse/0/cameras" + Ending))},
        {"images", bytesOf(Files.at("sparse/0/images" + Ending))},
        {"points", bytesOf(Files.at("sparse/0/points3D" + Ending))}};
    return static_cast<bool>(Text ? parseColmapText(F) : parseColmapBinary(F));
  };
}

Reading transforms(std::size_t Size) {
  const std::string File = transformsOf(captureOf(Size)).at("transforms.json");
  return [File] {
    return static_cast<bool>(parseTransforms("file", bytesOf(File)));
  };
}

Reading pointCloud(std::size_t Size) {
  const std::string File = pointCloudOf(captureOf(Size));
  return [File] {
    return static_cast<bool>(parsePointCloud("file", bytesOf(File)));
  };
}

/// An array of so many axes in Fortran's order, each element of which takes a
/// step for every axis. Beyond what NumPy has it is an error.
Reading npyAxes(std::size_t Size) {
  std::string Header = "{'descr': '|u1', 'fortran_order': True, 'shape': (";
  for (std::size_t I = 0; I < Size; ++I)
    Header += "1,";
  Header += fmt::format("{}), }}\n", Size);
  std::string File("\x93NUMPY\2\0", 8);
  const auto Length = static_cast<uint32_t>(Header.size());
  File.append(reinterpret_cast<const char *>(&Length), sizeof(Length));
  File += Header + std::string(Size, '\1');
  const Bytes B = bytesOf(File);
  return [Content = std::vector<std::byte>(B.begin(), B.end())] {
    return !parseNpy("file", Content);
  };
}

Reading npzEntries(std::size_t Size, const std::string &Folder) {
  Npz Arrays;
  for (std::size_t I = 0; I < Size; ++I)
    Arrays[fmt::format("array{}", I)] =
        NpyArray::of({1}, std::vector<float>{1});
  const std::string Path = fmt::format("{}/{}.npz", Folder, Size);
  if (!writeNpz(Path, Arrays))
    return [] { return false; };
  return [Path] { return static_cast<bool>(readNpz(Path)); };
}

std::vector<Reader> readers(const std::string &Folder) {
  return {
      {"ply-properties", 300, plyProperties},
      {"ply-elements", 300, plyElements},
      {"ply-comments", 300,
       [](std::size_t Size) {
         return scene(withHeader(
             formatPly(randomScene(1, 0, 1)), repeated(Size, [](std::size_t I) {
               return fmt::format("comment antialiased {}\n", I % 2);
             })));
       }},
      {"ply-vertices", 300,
       [](std::size_t Size) {
         return scene(formatPly(randomScene(Size, 3, 1)));
       }},
      {"compressed-ply", 300,
       [](std::size_t Size) {
         return scene(compressedPlyOf(randomScene(Size, 1, 1)));
       }},
      {"splat", 300,
       [](std::size_t Size) {
         return scene(splatOf(randomScene(Size, 0, 1)));
       }},
      {"spz", 300,
       [](std::size_t Size) {
         return scene(gzipOf(spzBodyOf(randomScene(Size, 3, 1), 3)));
       }},
      {"glb", 300, glb},
      {"sog", 300, sog},
      {"streamed-sog", 300, streamedSog},
      {"cameras", 30,
       [Folder](std::size_t Size) { return cameras(Size, Folder); }},
      {"colmap-text", 30, [](std::size_t Size) { return colmap(Size, true); }},
      {"colmap-binary", 30,
       [](std::size_t Size) { return colmap(Size, false); }},
      {"transforms", 30, transforms},
      {"point-cloud", 300, pointCloud},
      {"npy-axes", 300, npyAxes},
      {"npz-entries", 30,
       [Folder](std::size_t Size) { return npzEntries(Size, Folder); }}};
}

Expected<Success> run() {
  const auto Folder = TemporaryFolder::make("splat-reader-work");
  if (!Folder)
    return Folder.error();
  std::size_t Call = 0;
  for (const Reader &R : readers(Folder->path()))
    for (const std::size_t Times : {1, 10}) {
      const Reading Read = R.Prepare(Times * R.Size);
      if (!readNumbered(Call++, Read, std::make_index_sequence<MostCalls>()))
        return Error{R.Name, "not read as it should be", ExitCode::Internal};
      fmt::print("{} {}\n", R.Name, Times * R.Size);
    }
  return Success{};
}

} // namespace

int main() {
  const auto Done = run();
  return Done ? 0 : reportError("splat-reader-work", Done.error());
}
