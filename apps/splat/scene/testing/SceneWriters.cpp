#include "scene/testing/SceneWriters.h"

#include "io/Zip.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <webp/encode.h>
#include <zlib.h>

namespace vorion::splat::testing {
namespace {

constexpr double C0 = 0.28209479177387814;

template <typename T> void put(std::string &Out, T Value) {
  Out.append(reinterpret_cast<const char *>(&Value), sizeof(Value));
}

void putByte(std::string &Out, double Value) {
  Out += static_cast<char>(static_cast<uint8_t>(std::clamp(Value, 0.0, 255.0)));
}

double sigmoid(double X) { return 1 / (1 + std::exp(-X)); }

/// Rounded steps of \p Bits bits for \p Value from \p Low to \p High.
uint32_t steps(double Value, double Low, double High, int Bits) {
  const double Largest = std::ldexp(1.0, Bits) - 1;
  const double T = High - Low < 1e-5 ? 0 : (Value - Low) / (High - Low);
  return static_cast<uint32_t>(
      std::clamp(std::floor(T * Largest + 0.5), 0.0, Largest));
}

/// Unit quaternion of a Gaussian, and which component is largest.
struct Quat {
  std::array<double, 4> Q{};
  std::size_t Largest = 0;

  Quat(const Scene &S, std::size_t I, std::array<std::size_t, 4> Order) {
    double Squares = 0;
    for (std::size_t K = 0; K < 4; ++K) {
      Q[K] = S.Quats[4 * I + Order[K]];
      Squares += Q[K] * Q[K];
      if (std::abs(Q[K]) > std::abs(Q[Largest]))
        Largest = K;
    }
    const double Scale = (Q[Largest] < 0 ? -1 : 1) / std::sqrt(Squares);
    for (double &V : Q)
      V *= Scale;
  }

  /// \p Pack of the components that are not the largest, in order.
  void others(const std::function<void(double)> &Pack) const {
    for (std::size_t K = 0; K < 4; ++K)
      if (K != Largest)
        Pack(Q[K]);
  }
};

constexpr std::array<std::size_t, 4> Wxyz = {0, 1, 2, 3}, Xyzw = {1, 2, 3, 0};

struct Range {
  double Low, High;
};

Range rangeOf(const std::vector<double> &Values) {
  const auto [Low, High] = std::minmax_element(Values.begin(), Values.end());
  return {*Low, *High};
}

} // namespace

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

std::string compressedPlyOf(const Scene &S, bool ColorBounds) {
  constexpr std::size_t ChunkSize = 256;
  const std::size_t Chunks = (S.size() + ChunkSize - 1) / ChunkSize;
  const std::size_t Later = S.coefficients() - 1, ShEach = 3 * S.coefficients();
  std::string Out = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement chunk {}\n", Chunks);
  for (const char *Axes : {"x y z", "scale_x scale_y scale_z", "r g b"}) {
    if (Axes[0] == 'r' && !ColorBounds)
      continue;
    for (const char *End : {"min", "max"})
      for (const auto *At = Axes; At;) {
        const char *Blank = std::char_traits<char>::find(
            At, std::char_traits<char>::length(At), ' ');
        Out += fmt::format("property float {}_{}\n", End,
                           Blank ? std::string(At, Blank) : std::string(At));
        At = Blank ? Blank + 1 : nullptr;
      }
  }
  Out += fmt::format("element vertex {}\n", S.size());
  for (const char *Word : {"position", "rotation", "scale", "color"})
    Out += fmt::format("property uint packed_{}\n", Word);
  if (Later > 0) {
    Out += fmt::format("element sh {}\n", S.size());
    for (std::size_t K = 0; K < 3 * Later; ++K)
      Out += fmt::format("property uchar f_rest_{}\n", K);
  }
  Out += "end_header\n";

  // The kinds of value that have bounds: number of Gaussian and axis give one.
  const std::function<double(std::size_t, std::size_t)> Kinds[3] = {
      [&](std::size_t I, std::size_t A) { return S.Means[3 * I + A]; },
      [&](std::size_t I, std::size_t A) { return S.LogScales[3 * I + A]; },
      [&](std::size_t I, std::size_t A) {
        return 0.5 + C0 * S.Sh[ShEach * I + A];
      }};
  std::string Vertices;
  for (std::size_t First = 0; First < S.size(); First += ChunkSize) {
    const std::size_t End = std::min(First + ChunkSize, S.size());
    Range Bounds[3][3];
    for (int Kind = 0; Kind < 3; ++Kind) {
      for (std::size_t A = 0; A < 3; ++A) {
        std::vector<double> Values;
        for (std::size_t I = First; I < End; ++I)
          Values.push_back(Kinds[Kind](I, A));
        // The bounds as the file has them: a reader knows no others.
        Bounds[Kind][A] = rangeOf(Values);
        Bounds[Kind][A] = {float(Bounds[Kind][A].Low),
                           float(Bounds[Kind][A].High)};
        if (Kind == 2 && !ColorBounds)
          Bounds[Kind][A] = {0, 1};
      }
      if (Kind < 2 || ColorBounds) {
        for (const Range &B : Bounds[Kind])
          put(Out, static_cast<float>(B.Low));
        for (const Range &B : Bounds[Kind])
          put(Out, static_cast<float>(B.High));
      }
    }
    for (std::size_t I = First; I < End; ++I) {
      const auto Step = [&](int Kind, std::size_t A, int Bits) {
        return steps(Kinds[Kind](I, A), Bounds[Kind][A].Low,
                     Bounds[Kind][A].High, Bits);
      };
      const Quat Q(S, I, Wxyz);
      auto Rotation = static_cast<uint32_t>(Q.Largest);
      Q.others([&](double V) {
        Rotation =
            Rotation << 10 | steps(V, -std::sqrt(0.5), std::sqrt(0.5), 10);
      });
      put(Vertices,
          Step(0, 0, 11) << 21 | Step(0, 1, 10) << 11 | Step(0, 2, 11));
      put(Vertices, Rotation);
      put(Vertices,
          Step(1, 0, 11) << 21 | Step(1, 1, 10) << 11 | Step(1, 2, 11));
      put(Vertices, Step(2, 0, 8) << 24 | Step(2, 1, 8) << 16 |
                        Step(2, 2, 8) << 8 |
                        steps(sigmoid(S.OpacityLogits[I]), 0, 1, 8));
    }
  }
  Out += Vertices;
  for (std::size_t I = 0; I < S.size(); ++I)
    for (std::size_t C = 0; C < 3; ++C)
      for (std::size_t K = 1; K <= Later; ++K)
        putByte(Out, (S.Sh[ShEach * I + 3 * K + C] / 8 + 0.5) * 256);
  return Out;
}

std::string splatOf(const Scene &S) {
  std::string Out;
  const std::size_t ShEach = 3 * S.coefficients();
  for (std::size_t I = 0; I < S.size(); ++I) {
    for (std::size_t A = 0; A < 3; ++A)
      put(Out, S.Means[3 * I + A]);
    for (std::size_t A = 0; A < 3; ++A)
      put(Out, std::exp(S.LogScales[3 * I + A]));
    for (std::size_t C = 0; C < 3; ++C)
      putByte(Out, 255 * (0.5 + C0 * S.Sh[ShEach * I + C]));
    putByte(Out, 255 * sigmoid(S.OpacityLogits[I]));
    for (std::size_t K = 0; K < 4; ++K)
      putByte(Out, S.Quats[4 * I + K] * 128 + 128);
  }
  return Out;
}

std::string spzBodyOf(const Scene &S, int Version) {
  std::string Out;
  put(Out, uint32_t(0x5053474e));
  put(Out, static_cast<uint32_t>(Version));
  put(Out, static_cast<uint32_t>(S.size()));
  constexpr int FractionalBits = 12;
  for (const int Byte : {S.ShDegree, FractionalBits, 0, 0})
    putByte(Out, Byte);
  for (const float V : S.Means) {
    const auto Fixed =
        static_cast<int32_t>(std::lround(std::ldexp(V, FractionalBits)));
    for (const int Shift : {0, 8, 16})
      Out += static_cast<char>(Fixed >> Shift & 0xFF);
  }
  for (const float V : S.OpacityLogits)
    putByte(Out, std::round(255 * sigmoid(V)));
  const std::size_t ShEach = 3 * S.coefficients();
  for (std::size_t I = 0; I < S.size(); ++I)
    for (std::size_t C = 0; C < 3; ++C)
      putByte(Out, std::round(255 * (0.5 + 0.15 * S.Sh[ShEach * I + C])));
  for (const float V : S.LogScales)
    putByte(Out, std::round((V + 10) * 16));
  for (std::size_t I = 0; I < S.size(); ++I) {
    if (Version == 2) {
      const double Sign = S.Quats[4 * I] < 0 ? -1 : 1;
      for (std::size_t K = 1; K < 4; ++K)
        putByte(Out, std::round(127.5 + 127.5 * Sign * S.Quats[4 * I + K]));
      continue;
    }
    const Quat Q(S, I, Xyzw);
    auto Word = static_cast<uint32_t>(Q.Largest);
    Q.others([&](double V) {
      Word = Word << 10 | (V < 0 ? 0x200U : 0U) |
             static_cast<uint32_t>(
                 std::floor(511 * std::abs(V) / std::sqrt(0.5) + 0.5));
    });
    put(Out, Word);
  }
  for (std::size_t I = 0; I < S.size(); ++I)
    for (std::size_t K = 3; K < ShEach; ++K) {
      // Buckets of 8 for degree 1, of 16 above, so that zero is a middle.
      const int Bucket = K < 12 ? 8 : 16;
      const auto Fine =
          static_cast<int>(std::round(S.Sh[ShEach * I + K] * 128)) + 128;
      const int Middle = (Fine + Bucket / 2) / Bucket * Bucket;
      putByte(Out, Middle);
    }
  return Out;
}

std::string gzipOf(const std::string &Content) {
  z_stream Stream{};
  [[maybe_unused]] int Status =
      deflateInit2(&Stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + 16,
                   8, Z_DEFAULT_STRATEGY);
  std::string Out(deflateBound(&Stream, Content.size()), '\0');
  std::string In = Content; // zlib's interface is not const
  Stream.next_in = reinterpret_cast<Bytef *>(In.data());
  Stream.avail_in = static_cast<uInt>(In.size());
  Stream.next_out = reinterpret_cast<Bytef *>(Out.data());
  Stream.avail_out = static_cast<uInt>(Out.size());
  Status = deflate(&Stream, Z_FINISH);
  assert(Status == Z_STREAM_END);
  Out.resize(Stream.total_out);
  deflateEnd(&Stream);
  return Out;
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

Folder sogOf(const Scene &S) {
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

  std::string Low, High, Quats, ScalePlane, ColorPlane;
  for (std::size_t I = 0; I < S.size(); ++I) {
    for (std::size_t A = 0; A < 3; ++A) {
      const auto V =
          steps(LogOf(S.Means[3 * I + A]), Bounds[A].Low, Bounds[A].High, 16);
      putByte(Low, V & 0xFF);
      putByte(High, V >> 8);
      putByte(ScalePlane,
              steps(S.LogScales[3 * I + A], Scales.Low, Scales.High, 8));
      putByte(ColorPlane,
              steps(S.Sh[ShEach * I + A], Colors.Low, Colors.High, 8));
    }
    for (std::string *P : {&Low, &High, &ScalePlane})
      putByte(*P, 255);
    putByte(ColorPlane, std::round(255 * sigmoid(S.OpacityLogits[I])));
    const Quat Q(S, I, Wxyz);
    Q.others([&](double V) {
      putByte(Quats, std::round((V * std::sqrt(2) + 1) * 127.5));
    });
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
          putByte(Centroids,
                  steps(S.Sh[ShEach * I + 3 * K + C], Rest.Low, Rest.High, 8));
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
  Files["meta.json"] = Meta.dump();
  return Files;
}

std::string zipOf(const Folder &Files) {
  auto Archive = makeZip("test archive", Files);
  assert(Archive);
  return std::move(*Archive);
}

} // namespace vorion::splat::testing
