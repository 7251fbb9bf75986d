#include "scene/testing/SceneWriters.h"

#include "io/Zip.h"
#include "io/Zstd.h"
#include "scene/Activation.h"
#include "scene/formats/Quantize.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <utility>
#include <webp/encode.h>

namespace vorion::splat::testing {
Scene numberedScene(std::size_t Count, int ShDegree) {
  Scene S;
  S.ShDegree = ShDegree;
  float Next = 0;
  const auto Fill = [&](std::vector<float> &Values, std::size_t Each) {
    for (std::size_t I = 0; I < Count * Each; ++I)
      Values.push_back(std::sin(Next += 0.37F));
  };
  Fill(S.Means, 3);
  Fill(S.LogScales, 3);
  Fill(S.Quats, 4);
  Fill(S.OpacityLogits, 1);
  Fill(S.Sh, 3 * S.coefficients());
  return S;
}

Scene randomScene(std::size_t Count, int ShDegree, unsigned Seed) {
  std::mt19937 Engine(Seed); // whose numbers the standard fixes
  const auto Next = [&](double Low, double High) {
    return static_cast<float>(Low + (High - Low) * Engine() / 4294967295.0);
  };
  Scene S = Scene::sized(Count, ShDegree);
  for (std::size_t I = 0; I < Count; ++I) {
    double Squares = 0;
    for (std::size_t K = 0; K < 4; ++K) {
      S.Quats[4 * I + K] = Next(-1, 1);
      Squares += double(S.Quats[4 * I + K]) * S.Quats[4 * I + K];
    }
    for (std::size_t K = 0; K < 4; ++K)
      S.Quats[4 * I + K] /= static_cast<float>(std::sqrt(Squares));
    for (std::size_t A = 0; A < 3; ++A) {
      S.Means[3 * I + A] = Next(-50, 50);
      S.LogScales[3 * I + A] = Next(-8, 0);
    }
    S.OpacityLogits[I] = Next(-5, 5);
  }
  for (float &V : S.Sh)
    V = Next(-0.9, 0.9);
  return S;
}

std::string spz4Of(const Scene &S, const std::string &Extensions) {
  const std::string Body = spzBodyOf(S, 3);
  std::string Header = Body.substr(0, 16);
  Header[4] = 4;
  if (!Extensions.empty())
    Header[14] = 2;
  Header[15] = S.ShDegree == 0 ? 5 : 6;
  put(Header, static_cast<uint32_t>(32 + Extensions.size()));
  Header.resize(32);
  std::string Table, Frames;
  std::size_t At = 16;
  for (const std::size_t Each :
       {std::size_t(9), std::size_t(1), std::size_t(3), std::size_t(3),
        std::size_t(4), 3 * (S.coefficients() - 1)}) {
    if (Each == 0)
      continue;
    const std::string Frame = zstdOf(Body.substr(At, Each * S.size()));
    put(Table, uint64_t(Frame.size()));
    put(Table, uint64_t(Each * S.size()));
    Frames += Frame;
    At += Each * S.size();
  }
  return Header + Extensions + Table + Frames;
}

GltfParts gltfOf(const Scene &S, const std::string &Uri,
                 const std::string &Node) {
  using Json = nlohmann::json;
  const Activated<double> A = activate<double>(S);
  GltfParts P;
  Json Views = Json::array(), Accessors = Json::array(),
       Attributes = Json::object();
  const auto Add =
      [&](const std::string &Name, std::size_t Width,
          const std::function<double(std::size_t, std::size_t)> &Value) {
        Attributes[Name] = Accessors.size();
        Accessors.push_back({{"bufferView", Views.size()},
                             {"componentType", 5126},
                             {"count", S.size()},
                             {"type", Width == 1   ? "SCALAR"
                                      : Width == 3 ? "VEC3"
                                                   : "VEC4"}});
        Views.push_back({{"buffer", 0},
                         {"byteOffset", P.Buffer.size()},
                         {"byteLength", 4 * Width * S.size()}});
        for (std::size_t I = 0; I < S.size(); ++I)
          for (std::size_t K = 0; K < Width; ++K)
            put(P.Buffer, static_cast<float>(Value(I, K)));
      };
  const std::string Prefix = "KHR_gaussian_splatting:";
  Add("POSITION", 3,
      [&](std::size_t I, std::size_t K) { return S.Means[3 * I + K]; });
  Add(Prefix + "ROTATION", 4, [&](std::size_t I, std::size_t K) {
    return A.Quats[4 * I + (K + 1) % 4];
  });
  Add(Prefix + "SCALE", 3,
      [&](std::size_t I, std::size_t K) { return A.Scales[3 * I + K]; });
  Add(Prefix + "OPACITY", 1,
      [&](std::size_t I, std::size_t /*K*/) { return A.Opacities[I]; });
  std::size_t Term = 0;
  for (int Band = 0; Band <= S.ShDegree; ++Band)
    for (int M = 0; M < 2 * Band + 1; ++M, ++Term)
      Add(fmt::format("{}SH_DEGREE_{}_COEF_{}", Prefix, Band, M), 3,
          [&](std::size_t I, std::size_t K) {
            return S.Sh[3 * (S.coefficients() * I + Term) + K];
          });
  Json Buffer{{"byteLength", P.Buffer.size()}};
  if (!Uri.empty())
    Buffer["uri"] = Uri;
  Json Placed = Node.empty() ? Json::object() : Json::parse(Node);
  Placed["mesh"] = 0;
  P.Text = Json{{"asset", {{"version", "2.0"}}},
                {"extensionsUsed", {"KHR_gaussian_splatting"}},
                {"scene", 0},
                {"scenes", {{{"nodes", {0}}}}},
                {"nodes", {Placed}},
                {"meshes",
                 {{{"primitives",
                    {{{"mode", 0},
                      {"attributes", Attributes},
                      {"extensions",
                       {{"KHR_gaussian_splatting",
                         {{"kernel", "ellipse"},
                          {"colorSpace", "srgb_rec709_display"}}}}}}}}}}},
                {"accessors", Accessors},
                {"bufferViews", Views},
                {"buffers", {Buffer}}}
               .dump();
  return P;
}

std::string glbOf(const GltfParts &P) {
  std::string Text = P.Text, Buffer = P.Buffer;
  Text.resize((Text.size() + 3) / 4 * 4, ' ');
  Buffer.resize((Buffer.size() + 3) / 4 * 4, '\0');
  std::string Out;
  put(Out, uint32_t(0x46546C67));
  put(Out, uint32_t(2));
  put(Out, static_cast<uint32_t>(28 + Text.size() + Buffer.size()));
  put(Out, static_cast<uint32_t>(Text.size()));
  put(Out, uint32_t(0x4E4F534A));
  Out += Text;
  put(Out, static_cast<uint32_t>(Buffer.size()));
  put(Out, uint32_t(0x004E4942));
  return Out + Buffer;
}

GltfParts gltfOfSpz(const std::string &Spz) {
  using Json = nlohmann::json;
  const char *Name = "KHR_gaussian_splatting_compression_spz_2";
  return {
      Json{{"asset", {{"version", "2.0"}}},
           {"extensionsRequired", {"KHR_gaussian_splatting", Name}},
           {"nodes", {{{"mesh", 0}}}},
           {"meshes",
            {{{"primitives",
               {{{"extensions",
                  {{"KHR_gaussian_splatting",
                    {{"kernel", "ellipse"},
                     {"colorSpace", "srgb_rec709_display"},
                     {"extensions", {{Name, {{"bufferView", 0}}}}}}}}}}}}}}},
           {"bufferViews", {{{"buffer", 0}, {"byteLength", Spz.size()}}}},
           {"buffers", {{{"byteLength", Spz.size()}}}}}
          .dump(),
      Spz};
}

namespace {

template <typename T> void patch(std::string &In, std::size_t At, T Value) {
  In.replace(At, sizeof(Value), reinterpret_cast<const char *>(&Value),
             sizeof(Value));
}

/// The nearest half of a number that has a normal one.
uint16_t halfOf(double Value) {
  if (Value == 0)
    return 0;
  int Exponent;
  const double Fraction = std::frexp(std::abs(Value), &Exponent);
  const auto Steps = static_cast<unsigned>(std::lround(Fraction * 2048));
  return static_cast<uint16_t>((Value < 0 ? 0x8000U : 0U) +
                               (static_cast<unsigned>(Exponent + 14) << 10) +
                               (Steps - 1024));
}

constexpr std::size_t KSplatBucket = 8;
constexpr double LeastHarmonic = -1, GreatestHarmonic = 1;

/// The header and the data of a section of the Gaussians from \p First on.
std::pair<std::string, std::string> ksplatSection(const Scene &S,
                                                  std::size_t First,
                                                  std::size_t Count,
                                                  int Compression) {
  constexpr double Range = 32767, Block = 200;
  const std::size_t Full = Count / KSplatBucket,
                    Part = Count % KSplatBucket != 0 ? 1 : 0;
  std::string Header(1024, '\0'), Data, Records;
  patch(Header, 0, static_cast<uint32_t>(Count));
  patch(Header, 4, static_cast<uint32_t>(Count + 1)); // room for one more
  patch(Header, 40, static_cast<uint16_t>(S.ShDegree));
  if (Compression > 0) {
    patch(Header, 8, static_cast<uint32_t>(KSplatBucket));
    patch(Header, 12, static_cast<uint32_t>(Full + Part));
    patch(Header, 16, static_cast<float>(Block));
    patch(Header, 20, uint16_t(12));
    patch(Header, 24, static_cast<uint32_t>(Range));
    patch(Header, 32, static_cast<uint32_t>(Full));
    patch(Header, 36, static_cast<uint32_t>(Part));
    if (Part > 0)
      put(Data, static_cast<uint32_t>(Count % KSplatBucket));
    for (std::size_t B = 0; B < Full + Part; ++B)
      for (std::size_t A = 0; A < 3; ++A)
        put(Data, S.Means[3 * (First + B * KSplatBucket) + A]);
  }
  const auto Number = [&](float Value) {
    if (Compression == 0)
      put(Records, Value);
    else
      put(Records, halfOf(Value));
  };
  const std::size_t ShEach = 3 * S.coefficients();
  for (std::size_t I = First; I < First + Count; ++I) {
    const std::size_t Centre =
        First + (I - First) / KSplatBucket * KSplatBucket;
    for (std::size_t A = 0; A < 3; ++A)
      if (Compression == 0)
        put(Records, S.Means[3 * I + A]);
      else
        put(Records,
            static_cast<uint16_t>(std::lround(
                (double(S.Means[3 * I + A]) - S.Means[3 * Centre + A]) /
                    (Block / 2 / Range) +
                Range)));
    for (std::size_t A = 0; A < 3; ++A)
      Number(std::exp(S.LogScales[3 * I + A]));
    for (std::size_t K = 0; K < 4; ++K)
      Number(S.Quats[4 * I + K]);
    for (std::size_t C = 0; C < 3; ++C)
      putByte(Records, std::round(255 * (0.5 + ShC0 * S.Sh[ShEach * I + C])));
    putByte(Records, std::round(255 * opacityOf(S, I)));
    for (int D = 1; D <= S.ShDegree; ++D)
      for (std::size_t C = 0; C < 3; ++C)
        for (std::size_t K = shCoefficients(D - 1); K < shCoefficients(D); ++K)
          if (const float V = S.Sh[ShEach * I + 3 * K + C]; Compression == 2)
            putByte(Records, stepOf(V, {LeastHarmonic, GreatestHarmonic}, 8));
          else
            Number(V);
  }
  Records.resize(Records.size() / Count * (Count + 1));
  return {Header, Data + Records};
}

} // namespace

std::string ksplatOf(const Scene &S, int Compression) {
  std::string Header(4096, '\0');
  Header[1] = 1;
  patch(Header, 4, uint32_t(2));
  patch(Header, 8, uint32_t(2));
  patch(Header, 16, static_cast<uint32_t>(S.size()));
  patch(Header, 20, static_cast<uint16_t>(Compression));
  patch(Header, 36, static_cast<float>(LeastHarmonic));
  patch(Header, 40, static_cast<float>(GreatestHarmonic));
  const std::size_t Half = S.size() / 2;
  const auto First = ksplatSection(S, 0, Half, Compression),
             Second = ksplatSection(S, Half, S.size() - Half, Compression);
  return Header + First.first + Second.first + First.second + Second.second;
}

std::string webpOf(int Width, int Height, const std::string &Rgba) {
  // Not WebPEncodeLosslessRGBA, which clears the colour under zero alpha.
  WebPConfig Config;
  WebPPicture Picture;
  WebPMemoryWriter Writer;
  [[maybe_unused]] bool Ok =
      WebPConfigInit(&Config) != 0 && WebPPictureInit(&Picture) != 0;
  WebPMemoryWriterInit(&Writer);
  Config.lossless = 1;
  Config.exact = 1;
  Config.method = 0;
  Picture.use_argb = 1;
  Picture.width = Width;
  Picture.height = Height;
  Picture.writer = WebPMemoryWrite;
  Picture.custom_ptr = &Writer;
  Ok = Ok &&
       WebPPictureImportRGBA(&Picture,
                             reinterpret_cast<const uint8_t *>(Rgba.data()),
                             4 * Width) != 0 &&
       WebPEncode(&Config, &Picture) != 0;
  assert(Ok);
  std::string Out(reinterpret_cast<const char *>(Writer.mem), Writer.size);
  WebPMemoryWriterClear(&Writer);
  WebPPictureFree(&Picture);
  return Out;
}

Folder sogOf(const Scene &S, int Version) {
  using Json = nlohmann::json;
  const auto Width = static_cast<std::size_t>(
      std::ceil(std::sqrt(static_cast<double>(S.size()))));
  const std::size_t Height = (S.size() + Width - 1) / Width;
  const std::size_t ShEach = 3 * S.coefficients(), Later = ShEach / 3 - 1;
  Folder Files;
  const auto AddPlane = [&](const std::string &Name, std::size_t W,
                            std::size_t H, std::string Rgba) {
    Rgba.resize(4 * W * H);
    Files[Name] = webpOf(static_cast<int>(W), static_cast<int>(H), Rgba);
  };

  // Even steps from the least to the largest of some values.
  const auto Book = [](const Range &R) {
    std::vector<double> Steps;
    Steps.reserve(256);
    for (int I = 0; I < 256; ++I)
      Steps.push_back(R.Low + (R.High - R.Low) * I / 255);
    return Steps;
  };
  const auto LogOf = [](double X) {
    return std::copysign(std::log(std::abs(X) + 1), X);
  };
  Range Bounds[3];
  for (std::size_t A = 0; A < 3; ++A) {
    std::vector<double> Values;
    Values.reserve(S.size());
    for (std::size_t I = 0; I < S.size(); ++I)
      Values.push_back(LogOf(S.Means[3 * I + A]));
    Bounds[A] = rangeOf(Values);
  }
  const Range Scales = rangeOf({S.LogScales.begin(), S.LogScales.end()});
  std::vector<double> Constant, Other;
  for (std::size_t I = 0; I < S.Sh.size(); ++I)
    (I % ShEach < 3 ? Constant : Other).push_back(S.Sh[I]);
  const Range Colors = rangeOf(Constant);
  const Range Logits =
      rangeOf({S.OpacityLogits.begin(), S.OpacityLogits.end()});

  std::string Low, High, Quats, ScalePlane, ColorPlane;
  for (std::size_t I = 0; I < S.size(); ++I) {
    for (std::size_t A = 0; A < 3; ++A) {
      const auto V = stepOf(LogOf(S.Means[3 * I + A]), Bounds[A], 16);
      putByte(Low, V & 0xFF);
      putByte(High, V >> 8);
      putByte(ScalePlane, stepOf(S.LogScales[3 * I + A], Scales, 8));
      putByte(ColorPlane, stepOf(S.Sh[ShEach * I + A], Colors, 8));
    }
    for (std::string *P : {&Low, &High, &ScalePlane})
      putByte(*P, 255);
    putByte(ColorPlane, Version == 1 ? stepOf(S.OpacityLogits[I], Logits, 8)
                                     : std::round(255 * opacityOf(S, I)));
    const UnitQuat Q(S, I, Wxyz);
    for (const double V : Q.others())
      putByte(Quats, std::round((V * std::sqrt(2) + 1) * 127.5));
    putByte(Quats, 252 + static_cast<double>(Q.Largest));
  }
  AddPlane("means_l.webp", Width, Height, Low);
  AddPlane("means_u.webp", Width, Height, High);
  AddPlane("quats.webp", Width, Height, Quats);
  AddPlane("scales.webp", Width, Height, ScalePlane);
  AddPlane("sh0.webp", Width, Height, ColorPlane);
  Json Meta{
      {"version", 2},
      {"count", S.size()},
      {"means",
       {{"mins", {Bounds[0].Low, Bounds[1].Low, Bounds[2].Low}},
        {"maxs", {Bounds[0].High, Bounds[1].High, Bounds[2].High}},
        {"files", {"means_l.webp", "means_u.webp"}}}},
      {"scales", {{"codebook", Book(Scales)}, {"files", {"scales.webp"}}}},
      {"quats", {{"files", {"quats.webp"}}}},
      {"sh0", {{"codebook", Book(Colors)}, {"files", {"sh0.webp"}}}}};

  if (Later > 0) {
    const Range Rest = rangeOf(Other);
    constexpr std::size_t Row = 64;
    std::string Labels, Centroids;
    for (std::size_t I = 0; I < S.size(); ++I) {
      putByte(Labels, static_cast<double>(I & 0xFF));
      putByte(Labels, static_cast<double>(I >> 8));
      Labels += std::string("\0\xff", 2);
      for (std::size_t K = 1; K <= Later; ++K) {
        for (std::size_t C = 0; C < 3; ++C)
          putByte(Centroids, stepOf(S.Sh[ShEach * I + 3 * K + C], Rest, 8));
        putByte(Centroids, 255);
      }
    }
    AddPlane("shN_labels.webp", Width, Height, Labels);
    AddPlane("shN_centroids.webp", Row * Later, (S.size() + Row - 1) / Row,
             Centroids);
    Meta["shN"] = {{"count", S.size()},
                   {"bands", S.ShDegree},
                   {"codebook", Book(Rest)},
                   {"files", {"shN_centroids.webp", "shN_labels.webp"}}};
  }
  if (Version == 1) {
    Meta.erase("version");
    Meta.erase("count");
    Meta["means"]["shape"] = {S.size(), 3};
    const auto Bound = [&](const char *Group, const std::vector<Range> &Of) {
      Meta[Group].erase("codebook");
      for (const Range &R : Of) {
        Meta[Group]["mins"].push_back(R.Low);
        Meta[Group]["maxs"].push_back(R.High);
      }
    };
    Bound("scales", {Scales, Scales, Scales});
    Bound("sh0", {Colors, Colors, Colors, Logits});
    if (Later > 0) {
      const Range Rest = rangeOf(Other);
      Meta["shN"] = {{"mins", Rest.Low},
                     {"maxs", Rest.High},
                     {"files", {"shN_centroids.webp", "shN_labels.webp"}}};
    }
  }
  Files["meta.json"] = Meta.dump();
  return Files;
}

std::string zipOf(const Folder &Files) {
  auto Archive = makeZip("test archive", Files);
  assert(Archive);
  return std::move(*Archive);
}

} // namespace vorion::splat::testing
