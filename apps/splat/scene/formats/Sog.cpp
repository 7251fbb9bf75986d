#include "scene/formats/Sog.h"

#include "io/WebP.h"
#include "scene/ForeignFile.h"
#include "scene/formats/Dequantize.h"
#include "scene/formats/Formats.h"
#include "vorion/support/Json.h"
#include "vorion/support/Parallel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

namespace vorion::splat {

using Json = nlohmann::json;

/// A WebP's sides have 14 bits.
static constexpr std::size_t MostPixels = std::size_t(1) << 28;
/// Entries of the SH palette in a row of its plane.
static constexpr std::size_t PaletteRow = 64;
static constexpr std::size_t CodebookSize = 256;

/// Takes numbers and names out of meta.json and planes out of the data set.
/// Once something is wrong, \c Problem says what, and nothing more is done.
class SogData::Reader {
public:
  Reader(std::string Where, std::string MetaWhere, Json Meta)
      : Where(std::move(Where)), MetaWhere(std::move(MetaWhere)),
        Root(std::move(Meta)) {}

  /// Reads the description and the pictures that it names.
  Expected<Success> describe(const FileSource &Source) {
    if (!Root.is_object())
      return metaError("not a JSON object, expected SOG's description");
    if (!isDescription(Root))
      return foreignJson(MetaWhere, Root);
    // Files of version 1 do not say so.
    const auto Version = Root.find("version");
    IsFirst = Version == Root.end();
    if (!IsFirst && *Version != 2)
      return metaError(
          "unsupported version, expected 2, or none for version 1");
    const Json &Claimed = countOf();
    if (!Claimed.is_number_unsigned())
      return metaError(IsFirst ? "no version, and means.shape[0] of version 1 "
                                 "is not a whole number, expected 1 or more"
                               : "count is not a whole number, expected 1 or "
                                 "more");
    Count = Claimed.get<uint64_t>();
    auto DrawnAs = drawing();
    if (!DrawnAs)
      return DrawnAs.error();

    // Every plane is there before a scene is made, so that its size is bounded
    // by the pictures' and not by what the description says.
    Read = &Source;
    LowMeans = &plane("means", 0);
    HighMeans = &plane("means", 1);
    LeastMeans = numbers("means", "mins", 3);
    MostMeans = numbers("means", "maxs", 3);
    QuatPlane = &plane("quats", 0);
    ScalePlane = &plane("scales", 0);
    ColorPlane = &plane("sh0", 0);
    ScaleBooks = books("scales", 3);
    ColorBooks = books("sh0", IsFirst ? 4 : 3);
    if (Root.contains("shN"))
      Harmonics = palette();
    if (!Problem)
      decodePictures();
    if (Problem)
      return *Problem;
    Head.Format = SceneFormat::Sog;
    Head.Version = IsFirst ? 1 : 2;
    Head.DrawnAs = std::move(*DrawnAs);
    Head.Gaussians.ShDegree = Harmonics.Degree;
    return Success{};
  }

  /// Writes the Gaussians to \p S, the first of them as its \p At-th.
  Expected<Success> unpack(Scene &S, std::size_t At) {
    constexpr std::size_t Part = 1 << 14;
    std::vector<Expected<Success>> Parts(Count / Part + 1, Success{});
    inParallelParts(Count, Part, [&](std::size_t First, std::size_t End) {
      Parts[First / Part] = unpack(S, At, First, End);
    });
    Pictures.clear();
    for (const auto &Done : Parts)
      if (!Done)
        return Done.error();
    return Success{};
  }

  std::size_t Count = 0;
  SceneFile Head; ///< without Gaussians

private:
  /// Whether \p Root, an object, may be SOG's: it has one of the groups at
  /// least.
  static bool isDescription(const Json &Root) {
    return std::ranges::any_of(
        std::array{"means", "scales", "quats", "sh0"},
        [&](const char *Group) { return Root.contains(Group); });
  }

  /// Gaussians \p First to \p End of the data set to \p At and what follows in
  /// \p S; what is wrong with the first bad one.
  Expected<Success> unpack(Scene &S, std::size_t At, std::size_t First,
                           std::size_t End) const {
    const std::size_t ShEach = 3 * S.coefficients();
    for (std::size_t I = First; I < End; ++I) {
      const std::size_t To = At + I;
      for (std::size_t A = 0; A < 3; ++A) {
        S.Means[3 * To + A] = position(
            lerp(LeastMeans[A], MostMeans[A],
                 (LowMeans->at(I, A) | HighMeans->at(I, A) << 8) / 65535.0));
        S.LogScales[3 * To + A] =
            static_cast<float>(ScaleBooks[A][ScalePlane->at(I, A)]);
        S.Sh[ShEach * To + A] =
            static_cast<float>(ColorBooks[A][ColorPlane->at(I, A)]);
      }
      S.OpacityLogits[To] =
          IsFirst ? static_cast<float>(ColorBooks[3][ColorPlane->at(I, 3)])
                  : byteOpacityLogits()[ColorPlane->at(I, 3)];
      if (!unpackQuat(*QuatPlane, I, &S.Quats[4 * To]))
        return Error{
            file("quats", 0),
            fmt::format("rotation {} has the mode {}, expected 252 to 255", I,
                        QuatPlane->at(I, 3))};
      if (Harmonics.Degree > 0 && !Harmonics.copy(I, &S.Sh[ShEach * To + 3]))
        return Error{file("shN", 1),
                     fmt::format("Gaussian {} has palette entry {}, expected "
                                 "less than {}",
                                 I, Harmonics.label(I), Harmonics.Entries)};
    }
    return Success{};
  }

  /// What the 256 bytes stand for.
  using Book = std::vector<double>;

  /// Coefficients from degree 1 on, shared by Gaussians.
  struct Palette {
    int Degree = 0;
    std::size_t Entries = 0;
    Book Values;
    const Plane *Centroids = nullptr, *Labels = nullptr;

    std::size_t label(std::size_t Gaussian) const {
      return Labels->at(Gaussian, 0) | Labels->at(Gaussian, 1) << 8;
    }

    /// Writes the coefficients of a Gaussian; false if it has none.
    bool copy(std::size_t Gaussian, float *To) const {
      const std::size_t Label = label(Gaussian);
      if (Label >= Entries)
        return false;
      const std::size_t Later = shCoefficients(Degree) - 1;
      const std::size_t First =
          Label / PaletteRow * Centroids->Width + Label % PaletteRow * Later;
      for (std::size_t K = 0; K < Later; ++K)
        for (std::size_t C = 0; C < 3; ++C)
          To[3 * K + C] =
              static_cast<float>(Values[Centroids->at(First + K, C)]);
      return true;
    }
  };

  /// Undoes v = sign(x) ln(|x| + 1).
  static float position(double V) {
    return static_cast<float>(std::copysign(std::expm1(std::abs(V)), V));
  }

  /// Three components, of bytes for -1/sqrt(2) to 1/sqrt(2), and a mark for
  /// the one that is missing. Writes w, x, y, z; false if the mark is none.
  static bool unpackQuat(const Plane &P, std::size_t I, float *To) {
    const unsigned Mark = P.at(I, 3);
    if (Mark < 252)
      return false;
    std::array<double, 3> Others{};
    for (std::size_t C = 0; C < 3; ++C)
      Others[C] = (P.at(I, C) / 127.5 - 1) / std::numbers::sqrt2;
    const auto Quat = completeQuat(Mark - 252, Others);
    for (std::size_t K = 0; K < 4; ++K)
      To[K] = static_cast<float>(Quat[K]);
    return true;
  }

  Error metaError(std::string What) const {
    return Error{MetaWhere, std::move(What)};
  }

  /// What the keys "model" and "antialias" say; older writers have the latter.
  Expected<Drawing> drawing() const {
    const auto Flag = Root.find("antialias"), Model = Root.find("model");
    Drawing D;
    if (Flag != Root.end() && !Flag->is_null()) {
      if (!Flag->is_boolean())
        return metaError("antialias is not a Boolean, expected true or false");
      D = {Flag->get<bool>(), std::nullopt,
           fmt::format("antialias {}", Flag->get<bool>())};
    }
    if (Model == Root.end() || Model->is_null())
      return D;
    if (!Model->is_string())
      return metaError(
          "model is not a string, expected default or antialiased");
    auto Named = drawingOfModel(MetaWhere, Model->get<std::string>());
    if (Named && !D.Source.empty() && !Named->drawsAs(D))
      return metaError(
          fmt::format("{} and {} are contradictory, expected one of them",
                      Named->Source, D.Source));
    return Named;
  }

  /// Keeps the first thing that is wrong.
  void fail(Error E) {
    if (!Problem)
      Problem = std::move(E);
  }

  /// \p Key of the group \p Group; null where there is none.
  const Json &value(const char *Group, const char *Key) const {
    static const Json None;
    const auto G = Root.find(Group);
    if (G == Root.end() || !G->is_object())
      return None;
    const auto V = G->find(Key);
    return V == G->end() ? None : *V;
  }

  /// A null is a NaN: JSON has no other notation for it.
  std::vector<double> numbers(const char *Group, const char *Key,
                              std::size_t Size) {
    const Json &V = value(Group, Key);
    std::vector<double> Result;
    if (V.is_array() && V.size() == Size) {
      for (const Json &N : V)
        if (N.is_number())
          Result.push_back(N.get<double>());
        else if (N.is_null())
          Result.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    if (Result.size() != Size)
      fail(metaError(
          fmt::format("{}.{}: expected {} finite numbers", Group, Key, Size)));
    return Result;
  }

  /// A codebook of version 2, in ascending order. Older writers stored the
  /// first entry as null where a scene has infinities, as flat Gaussians do:
  /// PlayCanvas' engine continues the mean step of the others, and so does
  /// this. Gaussians with another null have a NaN.
  Book codebook(const char *Group) {
    Book B = numbers(Group, "codebook", CodebookSize);
    if (!Problem && std::isnan(B.front()))
      B.front() = B[1] - (B.back() - B[1]) / (CodebookSize - 1);
    return B;
  }

  /// The number of Gaussians as the description has it.
  const Json &countOf() const {
    static const Json None;
    if (!IsFirst)
      return Root.contains("count") ? Root["count"] : None;
    const Json &Shape = value("means", "shape");
    return Shape.is_array() && !Shape.empty() ? Shape[0] : None;
  }

  /// Of each of \p Channels. Version 2 has one for all, version 1 even steps
  /// from a least to a greatest value.
  std::vector<Book> books(const char *Group, std::size_t Channels) {
    if (!IsFirst)
      return std::vector<Book>(Channels, codebook(Group));
    const auto Mins = numbers(Group, "mins", Channels),
               Maxs = numbers(Group, "maxs", Channels);
    std::vector<Book> Result;
    for (std::size_t C = 0; C < Channels && !Problem; ++C)
      Result.push_back(evenSteps(Mins[C], Maxs[C]));
    return Result;
  }

  static Book evenSteps(double Low, double High) {
    Book Result;
    for (std::size_t I = 0; I < CodebookSize; ++I)
      Result.push_back(
          lerp(Low, High, static_cast<double>(I) / (CodebookSize - 1)));
    return Result;
  }

  /// The name of a file of \p Group for messages.
  std::string file(const char *Group, std::size_t Index) const {
    const Json &Files = value(Group, "files");
    return fmt::format("{}: {}", Where,
                       printable(Files[Index].get_ref<const std::string &>()));
  }

  /// A picture as it is, which the description needs \p Pixels of: some more
  /// for whole rows and blocks are let be. decodePictures() fills it in.
  const Plane &picture(const char *Group, std::size_t Index,
                       std::size_t Pixels) {
    static const Plane None;
    if (Problem)
      return None;
    const Json &Files = value(Group, "files");
    if (!Files.is_array() || Index >= Files.size() ||
        !Files[Index].is_string()) {
      fail(metaError(fmt::format("{}.files: expected the name of picture {}",
                                 Group, Index + 1)));
      return None;
    }
    constexpr std::size_t Padding = 4, Small = std::size_t(4) << 20;
    const std::size_t Declared =
        4 * Padding * std::min(Pixels, MostPixels) + Small;
    // No file is larger than its pixels.
    auto Content = (*Read)(Files[Index].get<std::string>(), Declared);
    if (!Content) {
      fail(Content.error());
      return None;
    }
    FileSizes += Content->size();
    auto P =
        planeForWebP(file(Group, Index), *Content,
                     std::min(unpackLimit(FileSizes) - Unpacked, Declared));
    if (!P) {
      fail(P.error());
      return None;
    }
    Unpacked += P->bytes();
    Pictures.push_back(
        {file(Group, Index), std::move(*Content), std::move(*P)});
    return Pictures.back().Pixels;
  }

  /// A picture with a pixel for each Gaussian, which is at the same place in
  /// all of them.
  const Plane &plane(const char *Group, std::size_t Index) {
    const Plane &P = picture(Group, Index, Count);
    if (!Problem && P.pixels() < Count)
      fail({file(Group, Index),
            fmt::format(
                "{}x{} pixels, expected one pixel for each of {} Gaussians",
                P.Width, P.Height, Count)});
    if (!FirstPlane)
      FirstPlane = &P;
    if (!Problem &&
        (P.Width != FirstPlane->Width || P.Height != FirstPlane->Height))
      fail({file(Group, Index),
            fmt::format("{}x{} pixels, expected {}x{} as in {}", P.Width,
                        P.Height, FirstPlane->Width, FirstPlane->Height,
                        Pictures.front().Where)});
    return P;
  }

  /// All at once, because this takes half of the time that a scene takes.
  void decodePictures() {
    std::vector<Expected<Success>> Decoded(Pictures.size(), Success{});
    inParallel(Pictures.size(), [&](std::size_t I) {
      Picture &P = Pictures[I];
      Decoded[I] = decodeWebPInto(P.Where, P.File, P.Pixels);
      P.File = {};
    });
    for (const auto &Done : Decoded)
      if (!Done)
        fail(Done.error());
  }

  Palette palette() {
    Palette P;
    if (IsFirst)
      firstPalette(P);
    else
      secondPalette(P);
    P.Labels = &plane("shN", 1);
    return P;
  }

  /// Version 1 says neither how many entries there are nor of which degree:
  /// the picture's size does.
  void firstPalette(Palette &P) {
    const Json &Low = value("shN", "mins"), &High = value("shN", "maxs");
    if (!Low.is_number() || !High.is_number()) {
      fail(metaError("shN.mins and shN.maxs: expected a number each"));
      return;
    }
    P.Values = evenSteps(Low.get<double>(), High.get<double>());
    constexpr std::size_t MostEntries = std::size_t(1) << 16; // labels' 16 bits
    P.Centroids = &picture(
        "shN", 0, MostEntries * (shCoefficients(MaxStoredShDegree) - 1));
    if (Problem)
      return;
    P.Degree = P.Centroids->Width % PaletteRow == 0
                   ? shDegreeOf(P.Centroids->Width / PaletteRow)
                   : -1;
    P.Entries = P.Centroids->Height * PaletteRow;
    if (P.Degree < 1)
      fail(
          {file("shN", 0), fmt::format("{} pixels wide, expected {} pixels for "
                                       "each coefficient of degree 1 to 4",
                                       P.Centroids->Width, PaletteRow)});
  }

  void secondPalette(Palette &P) {
    const Json &Bands = value("shN", "bands"), &Entries = value("shN", "count");
    if (!Bands.is_number_unsigned() || Bands.get<uint64_t>() < 1 ||
        Bands.get<uint64_t>() > static_cast<unsigned>(MaxStoredShDegree)) {
      fail(metaError(
          fmt::format("shN.bands: expected 1 to {}", MaxStoredShDegree)));
      return;
    }
    P.Degree = Bands.get<int>();
    if (!Entries.is_number_unsigned()) {
      fail(metaError("shN.count is not a whole number, expected 1 or more"));
      return;
    }
    P.Entries = Entries.get<uint64_t>();
    P.Values = codebook("shN");
    const std::size_t Later = shCoefficients(P.Degree) - 1;
    const std::size_t Width = PaletteRow * Later;
    P.Centroids = &picture("shN", 0, std::min(P.Entries, MostPixels) * Later);
    if (!Problem && (P.Centroids->Width != Width ||
                     P.Entries > P.Centroids->Height * PaletteRow))
      fail({file("shN", 0),
            fmt::format("{}x{} pixels for {} palette entries of degree {}, "
                        "expected {} per row and {} rows",
                        P.Centroids->Width, P.Centroids->Height, P.Entries,
                        P.Degree, Width,
                        P.Entries / PaletteRow +
                            (P.Entries % PaletteRow != 0 ? 1 : 0))});
  }

  std::string Where, MetaWhere;
  const FileSource *Read = nullptr; ///< while the description is read
  Json Root;
  bool IsFirst = false; ///< of version 1
  const Plane *LowMeans = nullptr, *HighMeans = nullptr, *QuatPlane = nullptr,
              *ScalePlane = nullptr, *ColorPlane = nullptr;
  std::vector<double> LeastMeans, MostMeans;
  std::vector<Book> ScaleBooks, ColorBooks;
  Palette Harmonics;
  struct Picture {
    std::string Where;
    std::vector<std::byte> File;
    Plane Pixels;
  };
  std::deque<Picture> Pictures; ///< in the order in which they were read
  const Plane *FirstPlane =
      nullptr;               ///< of those with a pixel for each Gaussian
  std::size_t FileSizes = 0; ///< of all pictures so far
  std::size_t Unpacked = 0;  ///< what they unpack to, bytes
  std::optional<Error> Problem;
};

SogData::SogData(std::unique_ptr<Reader> TheReader)
    : Own(std::move(TheReader)) {}
SogData::SogData(SogData &&) noexcept = default;
SogData::~SogData() = default;

Expected<SogData> SogData::open(const std::string &Where,
                                const std::string &MetaWhere, Bytes Meta,
                                const FileSource &Read) {
  auto Root = parseJson<Json>(asText(Meta), MetaWhere, "SOG's description");
  if (!Root)
    return Root.error();
  auto R = std::make_unique<Reader>(Where, MetaWhere, std::move(*Root));
  if (const auto Described = R->describe(Read); !Described)
    return Described.error();
  return SogData(std::move(R));
}

std::size_t SogData::size() const { return Own->Count; }
const SceneFile &SogData::head() const { return Own->Head; }
Expected<Success> SogData::unpack(Scene &To, std::size_t At) {
  assert(To.ShDegree == head().Gaussians.ShDegree && At + size() <= To.size());
  return Own->unpack(To, At);
}

Expected<SceneFile> parseSogData(const std::string &Where,
                                 const std::string &MetaWhere, Bytes Meta,
                                 const FileSource &Read) {
  auto Data = SogData::open(Where, MetaWhere, Meta, Read);
  if (!Data)
    return Data.error();
  SceneFile Result = Data->head();
  Result.Gaussians = Scene::sized(Data->size(), Result.Gaussians.ShDegree);
  if (const auto Unpacked = Data->unpack(Result.Gaussians, 0); !Unpacked)
    return Unpacked.error();
  return Result;
}

} // namespace vorion::splat
