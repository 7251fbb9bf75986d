#include "io/WebP.h"
#include "io/Zip.h"
#include "scene/formats/Codebook.h"
#include "scene/formats/Quantize.h"
#include "scene/formats/Writers.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

/// Entries of the palette in a row of its plane, and at most.
constexpr std::size_t PaletteRow = 64, MostEntries = std::size_t(1) << 16;

double logOf(double X) { return std::copysign(std::log1p(std::abs(X)), X); }

/// Collects the files of a data set; keeps the first thing that fails.
class SogWriter {
public:
  SogWriter(const Scene &S, const Drawing &D) : S(S), D(D) {
    // In blocks of four, as other writers have it.
    const auto Side = std::sqrt(static_cast<double>(S.size()));
    Width = 4 * static_cast<std::size_t>(std::ceil(Side / 4));
    Height = (S.size() + 4 * Width - 1) / (4 * Width) * 4;
  }

  Expected<std::map<std::string, std::string>> write() {
    Meta = {{"version", 2}, {"count", S.size()}};
    if (D.Antialiased)
      Meta["model"] = "antialiased";
    addMeans();
    addScales();
    addQuats();
    addColours();
    if (S.ShDegree > 0)
      addHarmonics();
    if (Problem)
      return *Problem;
    Files["meta.json"] = jsonText(Meta);
    return std::move(Files);
  }

private:
  /// Adds a picture of \p Rgba, of which the last rows may be missing.
  void add(const std::string &Name, std::size_t W, std::size_t H,
           const std::string &Rgba) {
    Plane P{W, H, std::vector<std::byte>(4 * W * H)};
    const Bytes From = std::as_bytes(std::span(Rgba));
    std::copy(From.begin(), From.end(), P.Rgba.begin());
    auto File = encodeWebP(P);
    if (!File && !Problem)
      Problem = File.error();
    if (File)
      Files[Name] = std::move(*File);
  }

  void addMeans() {
    Range Bounds[3];
    Json Mins, Maxs;
    for (std::size_t A = 0; A < 3; ++A) {
      std::vector<double> Values;
      Values.reserve(S.size());
      for (std::size_t I = 0; I < S.size(); ++I)
        Values.push_back(logOf(S.roundedMean(3 * I + A)));
      Bounds[A] = rangeOf(Values);
      Mins.push_back(Bounds[A].Low);
      Maxs.push_back(Bounds[A].High);
    }
    std::string Low, High;
    for (std::size_t I = 0; I < S.size(); ++I) {
      for (std::size_t A = 0; A < 3; ++A) {
        const uint32_t V =
            stepOf(logOf(S.roundedMean(3 * I + A)), Bounds[A], 16);
        putByte(Low, V & 0xFF);
        putByte(High, V >> 8);
      }
      putByte(Low, 255);
      putByte(High, 255);
    }
    add("means_l.webp", Width, Height, Low);
    add("means_u.webp", Width, Height, High);
    Meta["means"] = {{"mins", Mins},
                     {"maxs", Maxs},
                     {"files", {"means_l.webp", "means_u.webp"}}};
  }

  void addScales() {
    const auto Book = codebookOf(S.LogScales);
    std::string Rgba;
    for (std::size_t I = 0; I < S.size(); ++I) {
      for (std::size_t A = 0; A < 3; ++A)
        putByte(Rgba, nearestIn(Book, S.LogScales[3 * I + A]));
      putByte(Rgba, 255);
    }
    add("scales.webp", Width, Height, Rgba);
    Meta["scales"] = {{"codebook", Book}, {"files", {"scales.webp"}}};
  }

  void addQuats() {
    std::string Rgba;
    for (std::size_t I = 0; I < S.size(); ++I) {
      const UnitQuat Q(S, I, Wxyz);
      for (const double V : Q.others())
        putByte(Rgba, std::round((V * std::numbers::sqrt2 + 1) * 127.5));
      putByte(Rgba, 252 + static_cast<double>(Q.Largest));
    }
    add("quats.webp", Width, Height, Rgba);
    Meta["quats"] = {{"files", {"quats.webp"}}};
  }

  void addColours() {
    const std::size_t Each = 3 * S.coefficients();
    std::vector<float> Constant;
    for (std::size_t I = 0; I < S.size(); ++I)
      Constant.insert(Constant.end(), &S.Sh[Each * I], &S.Sh[Each * I] + 3);
    const auto Book = codebookOf(Constant);
    std::string Rgba;
    for (std::size_t I = 0; I < S.size(); ++I) {
      for (std::size_t C = 0; C < 3; ++C)
        putByte(Rgba, nearestIn(Book, Constant[3 * I + C]));
      putByte(Rgba, std::round(255 * opacityOf(S, I)));
    }
    add("sh0.webp", Width, Height, Rgba);
    Meta["sh0"] = {{"codebook", Book}, {"files", {"sh0.webp"}}};
  }

  void addHarmonics() {
    const std::size_t Each = 3 * S.coefficients(), Later = Each - 3;
    std::vector<float> Vectors;
    Vectors.reserve(Later * S.size());
    for (std::size_t I = 0; I < S.size(); ++I)
      Vectors.insert(Vectors.end(), &S.Sh[Each * I] + 3,
                     &S.Sh[Each * I] + Each);
    const VectorPalette P = paletteOf(Vectors, Later, MostEntries);
    const std::size_t Entries = P.Entries.size() / Later;
    const auto Book = codebookOf(P.Entries);
    std::string Centroids, Labels;
    for (std::size_t I = 0; I < P.Entries.size(); ++I) {
      putByte(Centroids, nearestIn(Book, P.Entries[I]));
      if (I % 3 == 2)
        putByte(Centroids, 255);
    }
    for (const uint32_t Label : P.Labels) {
      putByte(Labels, Label & 0xFF);
      putByte(Labels, Label >> 8);
      putByte(Labels, 0);
      putByte(Labels, 255);
    }
    add("shN_centroids.webp", PaletteRow * Later / 3,
        (Entries + PaletteRow - 1) / PaletteRow, Centroids);
    add("shN_labels.webp", Width, Height, Labels);
    Meta["shN"] = {{"count", Entries},
                   {"bands", S.ShDegree},
                   {"codebook", Book},
                   {"files", {"shN_centroids.webp", "shN_labels.webp"}}};
  }

  const Scene &S;
  const Drawing &D;
  std::size_t Width = 0, Height = 0;
  Json Meta;
  std::map<std::string, std::string> Files;
  std::optional<Error> Problem;
};

} // namespace

Expected<std::map<std::string, std::string>> sogFilesOf(const Scene &S,
                                                        const Drawing &D) {
  return SogWriter(S, D).write();
}

Expected<std::string> sogArchiveOf(const Scene &S, const Drawing &D) {
  const auto Files = sogFilesOf(S, D);
  return Files ? makeZip("", *Files) : Expected<std::string>(Files.error());
}

} // namespace vorion::splat
