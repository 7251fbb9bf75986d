#include "scene/testing/Damage.h"

#include "scene/formats/Ply.h"

#include <cassert>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

namespace vorion::splat::testing {
namespace {

using Json = nlohmann::json;

/// So few that a test can try every byte, yet with all kinds of property.
constexpr std::size_t Count = 5;

Scene sample(int ShDegree) { return randomScene(Count, ShDegree, 1); }

std::string replaced(std::string Text, const std::string &What,
                     const std::string &With) {
  const std::size_t At = Text.find(What);
  assert(At != std::string::npos);
  return Text.replace(At, What.size(), With);
}

/// \p Text with the bytes of \p Value at \p At, from the end if negative.
template <typename T>
std::string patched(std::string Text, std::ptrdiff_t At, T Value) {
  const auto Start = static_cast<std::size_t>(
      At < 0 ? static_cast<std::ptrdiff_t>(Text.size()) + At : At);
  std::memcpy(Text.data() + Start, &Value, sizeof(Value));
  return Text;
}

std::string cut(const std::string &Text, std::size_t Bytes) {
  return Text.substr(0, Text.size() - Bytes);
}

constexpr float NaN = std::numeric_limits<float>::quiet_NaN();
constexpr float Infinity = std::numeric_limits<float>::infinity();

void addPlyDamage(std::vector<DamagedFile> &Out) {
  const std::string Ply = formatPly(sample(1));
  Out.push_back({"ascii.ply", replaced(Ply, "binary_little_endian", "ascii"),
                 "in row 0 of element vertex, expected property x"});
  Out.push_back({"no-format.ply",
                 replaced(Ply, "format binary_little_endian 1.0\n", ""),
                 "no format line"});
  Out.push_back({"huge-count.ply",
                 replaced(Ply, "vertex 5", "vertex 18446744073709551615"),
                 "expected 18446744073709551615 rows"});
  Out.push_back({"no-count.ply", replaced(Ply, "vertex 5", "vertex -5"),
                 "vertex count `-5` is not a number"});
  Out.push_back({"no-opacity.ply", replaced(Ply, "opacity", "opaquity"),
                 "property opacity of element vertex is missing"});
  Out.push_back({"seven-rest.ply",
                 replaced(Ply, "property float nx", "property float f_rest_9"),
                 "10 f_rest properties"});
  Out.push_back({"list.ply", replaced(Ply, "float nx", "list uchar float nx"),
                 "truncated in row 1 of element vertex, expected 5 rows"});
  Out.push_back({"no-end.ply", replaced(Ply, "end_header", "ent_header"),
                 "unknown header keyword `ent_header`"});
  Out.push_back({"short.ply", cut(Ply, 1), "bytes left for element vertex"});
  Out.push_back({"long.ply", Ply + "x", "1 byte after the last element"});
  Out.push_back({"nan.ply", patched(Ply, -4, NaN),
                 "Gaussian 4 has a NaN or an infinity"});
  Out.push_back({"infinite.ply", patched(Ply, -4, Infinity),
                 "Gaussian 4 has a NaN or an infinity"});
  Out.push_back(
      {"empty-scene.ply", formatPly(Scene::sized(0, 0)), "no Gaussian"});
}

void addCompressedPlyDamage(std::vector<DamagedFile> &Out) {
  const std::string Ply = compressedPlyOf(sample(1));
  const std::size_t Body = Ply.find("end_header\n") + 11;
  Out.push_back({"chunks.compressed.ply",
                 replaced(Ply, "element chunk 1", "element chunk 0"),
                 "bytes after the last element"});
  Out.push_back({"no-vertex.compressed.ply",
                 replaced(Ply, "element vertex", "element vertices"),
                 "without element vertex"});
  Out.push_back({"no-bound.compressed.ply",
                 replaced(Ply, "max_scale_z", "mox_scale_z"),
                 "property max_scale_z of element chunk is missing"});
  Out.push_back({"word-type.compressed.ply",
                 replaced(Ply, "uint packed_color", "float packed_color"),
                 "property packed_color of element vertex has another type"});
  Out.push_back({"nan-bound.compressed.ply",
                 patched(Ply, static_cast<std::ptrdiff_t>(Body), NaN),
                 "Gaussian 0 has a NaN"});
  Out.push_back({"rest.compressed.ply",
                 replaced(Ply, "property uchar f_rest_8\n", ""),
                 "bytes after the last element"});
  Out.push_back({"rest-name.compressed.ply",
                 replaced(Ply, "f_rest_8", "f_rust_8"),
                 "property f_rest_8 of element sh is missing"});
  Out.push_back(
      {"short.compressed.ply", cut(Ply, 1), "bytes left for element sh"});
}

void addSplatDamage(std::vector<DamagedFile> &Out) {
  const std::string Splat = splatOf(sample(0));
  Out.push_back(
      {"short.splat", cut(Splat, 1), "not a scene in a known format"});
  Out.push_back(
      {"nan.splat", patched(Splat, 36, NaN), "record 1 has position nan"});
  Out.push_back({"infinite.splat", patched(Splat, 12, Infinity),
                 "record 0 has position"});
  Out.push_back({"negative-scale.splat", patched(Splat, 16, -1.0F),
                 "scale -1 on axis 1"});
  Out.push_back({"empty.splat", "", "an empty file"});
  Out.push_back({"text.splat",
                 "this text has sixty-four bytes, so it could be two "
                 "records......",
                 "not a scene in a known format"});
}

void addSpzDamage(std::vector<DamagedFile> &Out) {
  const std::string K = ksplatOf(sample(1), 1);
  Out.push_back({"compression.ksplat", patched(K, 20, uint16_t(3)),
                 "compression 3, expected 0, 1 or 2"});
  Out.push_back({"sections.ksplat", patched(K, 4, uint32_t(-1)),
                 "4294967295 sections, expected a file with"});
  Out.push_back({"degree.ksplat", patched(K, 4096 + 40, uint16_t(4)),
                 "section 0 has degree 4"});
  Out.push_back({"room.ksplat", patched(K, 4096, uint32_t(9)),
                 "section 0 has 9 Gaussians, expected at most"});
  Out.push_back({"record.ksplat", patched(K, 4096 + 20, uint16_t(16)),
                 "section 0 has buckets of 16 bytes, expected 12"});
  Out.push_back({"huge.ksplat", patched(K, 4096 + 4, uint32_t(-1)),
                 "expected an end inside the file"});
  Out.push_back({"buckets.ksplat", patched(K, 4096 + 32, uint32_t(7)),
                 "section 0 has 7 full and 1 other buckets"});
  Out.push_back({"bucket.ksplat", patched(K, 4096 + 2 * 1024, uint32_t(1)),
                 "Gaussian 1 is in no bucket"});
  Out.push_back({"longer.ksplat", K + "x", "expected 5 and"});
  Out.push_back(
      {"count.ksplat", patched(K, 16, uint32_t(6)), "expected 6 and"});

  const std::string Body = spzBodyOf(sample(1), 3);
  const std::string Spz = gzipOf(Body);
  const auto Add = [&](const char *Name, const std::string &Content,
                       const char *Message) {
    Out.push_back({Name, gzipOf(Content), Message});
  };
  Add("magic.spz", patched(Body, 0, uint8_t('X')),
      "a gzip-packed file of another kind");
  Add("version1.spz", patched(Body, 4, uint32_t(1)), "SPZ version 1");
  Add("version4.spz", patched(Body, 4, uint32_t(4)),
      "SPZ version 4 in a gzip stream, expected 2 or 3");
  Add("version5.spz", patched(Body, 4, uint32_t(5)),
      "SPZ version 5, expected 2 to 4");
  const std::string Four = spz4Of(sample(1));
  Out.push_back({"arrays.v4.spz", patched(Four, 15, uint8_t(5)),
                 "a header of 5 arrays, expected 6"});
  Out.push_back({"table.v4.spz", patched(Four, 16, uint32_t(8)),
                 "a table of 6 arrays at byte 8, expected it after"});
  Out.push_back({"packed.v4.spz", patched(Four, 32, uint64_t(1) << 60),
                 "array 0 has 45 bytes, packed 1152921504606846976"});
  Out.push_back({"size.v4.spz", patched(Four, 40, uint64_t(1) << 60),
                 "array 0 has 1152921504606846976 bytes"});
  Out.push_back({"frame.v4.spz", patched(Four, 32 + 6 * 16, uint32_t(7)),
                 "damaged zstd frame"});
  Out.push_back({"longer.v4.spz", Four + "x", "1 byte after the last array"});
  Out.push_back(
      {"count.v4.spz", patched(Four, 8, uint32_t(-1)), "array 0 has 45 bytes"});
  Add("huge-count.spz", patched(Body, 8, uint32_t(-1)),
      "expected 4294967295 Gaussians");
  Add("degree.spz", patched(Body, 12, uint8_t(5)), "SH degree 5");
  Add("fraction.spz", patched(Body, 13, uint8_t(25)), "25 fractional bits");
  Add("extensions.spz", patched(Body, 14, uint8_t(2)), "flags 0x02");
  Add("reserved.spz", patched(Body, 15, uint8_t(1)), "reserved byte 0x01");
  Add("short-body.spz", cut(Body, 1), "expected 5 Gaussians of 29 bytes");
  Add("no-header.spz", Body.substr(0, 15), "not an SPZ file");
  Add("empty-scene.spz", patched(Body.substr(0, 16), 8, uint32_t(0)),
      "no Gaussian");
  Out.push_back({"short.spz", cut(Spz, 9), "damaged gzip stream"});
  Out.push_back(
      {"checksum.spz", patched(Spz, -8, uint32_t(0)), "damaged gzip stream"});
  Out.push_back({"long.spz", Spz + "x", "1 byte after the gzip stream"});
}

/// Damage to files of a data set; both for zip archives and for folders.
std::vector<DamagedFolder> sogDamage() {
  const Folder Whole = sogOf(sample(1));
  std::vector<DamagedFolder> Out;
  const auto Meta = [&](const char *Name, const char *Message,
                        const std::function<void(Json &)> &Change) {
    Folder F = Whole;
    Json M = Json::parse(F["meta.json"]);
    Change(M);
    F["meta.json"] = M.dump();
    Out.push_back({Name, std::move(F), Message});
  };
  const auto File = [&](const char *Name, const char *Changed,
                        const std::string &Content, const char *Message) {
    Folder F = Whole;
    F[Changed] = Content;
    Out.push_back({Name, std::move(F), Message});
  };
  Meta("no-version", "no version, and means.shape[0] of version 1",
       [](Json &M) { M.erase("version"); });
  Meta("first-book", "scales.mins: expected 3 finite numbers", [](Json &M) {
    M.erase("version");
    M["means"]["shape"] = {5, 3};
  });
  Meta("version3", "unsupported version", [](Json &M) { M["version"] = 3; });
  Meta("count-text", "count is not a whole number",
       [](Json &M) { M["count"] = "5"; });
  Meta("count-huge", "expected one pixel for each of 18446744073709551615",
       [](Json &M) { M["count"] = uint64_t(-1); });
  Meta("count-zero", "no Gaussian", [](Json &M) { M["count"] = 0; });
  Meta("no-means", "means.files: expected the name",
       [](Json &M) { M.erase("means"); });
  Meta("mins-short", "means.mins: expected 3 finite numbers",
       [](Json &M) { M["means"]["mins"].erase(0); });
  Meta("codebook-null", "has a NaN or an infinity in its scales",
       [](Json &M) { M["scales"]["codebook"] = Json::array_t(256); });
  Meta("codebook-short", "sh0.codebook: expected 256 finite numbers",
       [](Json &M) { M["sh0"]["codebook"].erase(0); });
  Meta("codebook-huge", "has a NaN or an infinity", [](Json &M) {
    for (Json &V : M["scales"]["codebook"])
      V = 1e200;
  });
  Meta("means-huge", "has a NaN or an infinity",
       [](Json &M) { M["means"]["maxs"] = {1e9, 1e9, 1e9}; });
  Meta("bands", "shN.bands: expected 1 to 4",
       [](Json &M) { M["shN"]["bands"] = 5; });
  Meta("other-bands", "palette entries of degree 2",
       [](Json &M) { M["shN"]["bands"] = 2; });
  Meta("palette-small", "has palette entry 2, expected less than 2",
       [](Json &M) { M["shN"]["count"] = 2; });
  Meta("palette-large", "for 65 palette entries",
       [](Json &M) { M["shN"]["count"] = 65; });
  File("meta-text", "meta.json", "no JSON", "not JSON: invalid literal");
  File("plane-text", "quats.webp", "no picture",
       "a text, expected a lossless WebP");
  File("plane-short", "quats.webp", cut(Whole.at("quats.webp"), 8),
       "damaged WebP picture");
  File("plane-small", "quats.webp", webpOf(2, 2, std::string(16, '\xff')),
       "2x2 pixels, expected one pixel for each of 5 Gaussians");
  // Each has room for all, but a Gaussian has one place.
  for (const char *Plane :
       {"means_u.webp", "scales.webp", "sh0.webp", "shN_labels.webp"})
    File("plane-shape", Plane, webpOf(2, 3, std::string(24, '\xff')),
         "2x3 pixels, expected 3x2 as in ");
  // A picture of one colour packs into almost nothing.
  File("plane-bomb", "quats.webp",
       webpOf(4096, 4096, std::string(std::size_t(4) << 24, '\xff')),
       "4096x4096 pixels in a file of");
  File("rotation-mark", "quats.webp", webpOf(3, 2, std::string(24, '\x10')),
       "rotation 0 has the mode 16, expected 252 to 255");
  return Out;
}

} // namespace

Folder streamedSogOf(const Scene &Fine, const Scene &Coarse,
                     const Scene &Environment) {
  Folder Files;
  const auto Add = [&Files](const std::string &Name, const Scene &S) {
    for (auto &[File, Content] : sogOf(S))
      Files[fmt::format("{}/{}", Name, File)] = Content;
  };
  const std::size_t Half = Fine.size() / 2;
  for (const bool Second : {false, true}) {
    Scene Part = Scene::sized(0, Fine.ShDegree);
    append(Part, Fine, Second ? Half : 0, Second ? Fine.size() - Half : Half);
    Add(Second ? "0_1" : "0_0", Part);
  }
  Add("1_0", Coarse);
  Add("env", Environment);
  const Json Box{{"min", {-50, -50, -50}}, {"max", {50, 50, 50}}};
  const auto RunOf = [](int File, std::size_t Offset, std::size_t Size) {
    return Json{{"file", File}, {"offset", Offset}, {"count", Size}};
  };
  // The first chunk in two runs, listed from the back.
  const Json Tree{
      {"bound", Box},
      {"children",
       {{{"bound", Box},
         {"lods",
          {{"0", RunOf(0, 1, Half - 1)}, {"1", RunOf(2, 0, Coarse.size())}}}},
        {{"bound", Box},
         {"children",
          {{{"bound", Box}, {"lods", {{"0", RunOf(0, 0, 1)}}}},
           {{"bound", Box},
            {"lods", {{"0", RunOf(1, 0, Fine.size() - Half)}}}}}}}}}};
  Files["lod-meta.json"] = Json{
      {"version", 1},
      {"lodLevels", 2},
      {"environment", "env/meta.json"},
      {"filenames", {"0_0/meta.json", "0_1/meta.json", "1_0/meta.json"}},
      {"tree", Tree}}.dump();
  return Files;
}

std::vector<SampleFile> sampleFiles() {
  return {{"degree0.ply", formatPly(sample(0))},
          {"degree1.ply", formatPly(sample(1))},
          {"degree0.compressed.ply", compressedPlyOf(sample(0), {}, false)},
          {"degree1.compressed.ply", compressedPlyOf(sample(1))},
          {"degree0.splat", splatOf(sample(0))},
          {"degree1.ksplat", ksplatOf(sample(1), 1)},
          {"degree0.v2.spz", gzipOf(spzBodyOf(sample(0), 2))},
          {"degree1.v3.spz", gzipOf(spzBodyOf(sample(1), 3))},
          {"unpacked.v3.spz", spzBodyOf(sample(1), 3)},
          {"degree1.v4.spz", spz4Of(sample(1))},
          {"degree1.glb", glbOf(gltfOf(sample(1)))},
          {"degree0.sog", zipOf(sogOf(sample(0)))},
          {"degree1.sog", zipOf(sogOf(sample(1)))}};
}

std::vector<DamagedFile> damagedFiles() {
  std::vector<DamagedFile> Out;
  addPlyDamage(Out);
  addCompressedPlyDamage(Out);
  addSplatDamage(Out);
  addSpzDamage(Out);
  for (const DamagedFolder &F : sogDamage())
    Out.push_back({F.Name + ".sog", zipOf(F.Files), F.Message});
  Folder Missing = sogOf(sample(0));
  Missing.erase("meta.json");
  Out.push_back(
      {"no-meta.sog", zipOf(Missing), "without the meta.json of SOG"});
  Out.push_back(
      {"short.sog", cut(zipOf(sogOf(sample(0))), 1), "expected a SOG archive"});
  return Out;
}

std::vector<DamagedFolder> damagedFolders() {
  std::vector<DamagedFolder> Out = sogDamage();
  const Folder Whole = sogOf(sample(0));
  Folder F = Whole;
  F.erase("scales.webp");
  Out.push_back({"no-plane", F, "cannot open: No such file"});
  F = Whole;
  F["meta.json"] = replaced(F["meta.json"], "scales.webp", "../scales.webp");
  Out.push_back({"outside", F, "expected a file inside the folder"});
  Out.push_back({"nothing", {{"readme.txt", "empty"}}, "a folder without"});

  const Folder Streamed = streamedSogOf(sample(0), sample(0), sample(0));
  const auto Index = [&](const char *Name, const char *Message,
                         const std::function<void(Json &)> &Change) {
    Folder Changed = Streamed;
    Json J = Json::parse(Changed["lod-meta.json"]);
    Change(J);
    Changed["lod-meta.json"] = J.dump();
    Out.push_back({Name, std::move(Changed), Message});
  };
  Index("index-version", "unsupported version of the index",
        [](Json &J) { J["version"] = 2; });
  Index("index-levels", "lodLevels is not a whole number",
        [](Json &J) { J["lodLevels"] = 0; });
  Index("index-names", "filenames is not a list of strings",
        [](Json &J) { J["filenames"][0] = 7; });
  Index("index-tree", "no tree", [](Json &J) { J.erase("tree"); });
  Index("tree-node", "a node of the tree is not an object",
        [](Json &J) { J["tree"]["children"][0] = 7; });
  Index("tree-file", "a range of the tree is incomplete",
        [](Json &J) { J["tree"]["children"][0]["lods"]["0"]["file"] = 3; });
  Index("tree-overlap", "expected disjoint ranges",
        [](Json &J) { J["tree"]["children"][0]["lods"]["0"]["offset"] = 0; });
  Index("tree-long", "expected disjoint ranges", [](Json &J) {
    J["tree"]["children"][0]["lods"]["0"]["count"] = uint64_t(-1);
  });
  F = Streamed;
  F.erase("lod-meta.json");
  Out.push_back({"no-index", F, "chunks of 2 levels of detail"});
  F = streamedSogOf(sample(0), sample(0), sample(1));
  Out.push_back({"degrees", F, "SH degree 1, expected 0"});
  return Out;
}

} // namespace vorion::splat::testing
