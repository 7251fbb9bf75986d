// GaussianSplats3D's `.ksplat`.
// https://github.com/mkkellogg/GaussianSplats3D
//
// A header of 4096 bytes, one of 1024 for each section, and the sections: how
// many Gaussians each bucket has that is not full, the centres of the buckets,
// and records of position, scale (not its logarithm), quaternion w, x, y, z,
// four bytes r, g, b, opacity, and harmonics. Compression 0 has floats. 1 has
// positions of 16 bits about the bucket's centre, and halves. 2 has in
// addition harmonics of 8 bits between bounds of the header. Sections may
// differ in degree; what one lacks is zero.
//
// The format has no mark but its version, 0.1, and a header that is zero behind
// its 44th byte. Refused: other versions, counts that the file does not hold,
// bucket records of other than 12 bytes. A scale of zero or less becomes the
// smallest normal float, as in `.splat`.
#include "scene/formats/Dequantize.h"
#include "scene/formats/Formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <vector>

namespace vorion::splat {
namespace {

constexpr std::size_t HeaderSize = 4096, HeaderUsed = 44, Marked = 64,
                      SectionHeader = 1024, CentreSize = 12;

/// A number of 16 bits as IEEE 754 has it.
float half(Bytes B, std::size_t At) {
  const auto Word = load<uint16_t>(B, At);
  const int Exponent = Word >> 10 & 0x1F, Fraction = Word & 0x3FF;
  const float Sign = (Word & 0x8000) != 0 ? -1.0F : 1.0F;
  if (Exponent == 0x1F)
    return Sign * (Fraction != 0 ? std::numeric_limits<float>::quiet_NaN()
                                 : std::numeric_limits<float>::infinity());
  return Sign * std::ldexp(static_cast<float>(Exponent != 0 ? Fraction + 0x400
                                                            : Fraction),
                           std::max(Exponent, 1) - 25);
}

struct Header {
  std::size_t Sections = 0, Count = 0;
  int Compression = 0;
  float LeastHarmonic = 0, GreatestHarmonic = 0;

  std::size_t wide() const { return Compression == 0 ? 4 : 2; } ///< of a number
  std::size_t harmonicSize() const { return Compression == 2 ? 1 : wide(); }
  /// Bytes of a Gaussian.
  std::size_t each(int ShDegree) const {
    return (3 + 3 + 4) * wide() + 4 +
           harmonicSize() * 3 * (shCoefficients(ShDegree) - 1);
  }
};

struct Section {
  std::size_t Count = 0, Room = 0; ///< Gaussians that there are and fit
  std::size_t BucketSize = 0, Buckets = 0, FullBuckets = 0, PartBuckets = 0;
  float BlockSize = 0;
  uint32_t Range = 0; ///< steps from a bucket's centre to its side
  int ShDegree = 0;
  std::size_t Start = 0; ///< of its data in the file

  std::size_t centres() const { return Start + 4 * PartBuckets; }
  std::size_t records() const { return centres() + CentreSize * Buckets; }
};

Expected<Header> readHeader(const std::string &Where, Bytes File) {
  if (File.size() < HeaderSize)
    return Error{Where,
                 fmt::format("{} bytes of a .ksplat, expected its header "
                             "of {}",
                             File.size(), HeaderSize)};
  Header H;
  H.Sections = load<uint32_t>(File, 4);
  H.Count = load<uint32_t>(File, 16);
  H.Compression = load<uint16_t>(File, 20);
  // Writers that knew no bounds left zeros.
  const auto Bound = [&](std::size_t At, float Else) {
    const auto Value = load<float>(File, At);
    return Value == 0 ? Else : Value;
  };
  H.LeastHarmonic = Bound(36, -1.5F);
  H.GreatestHarmonic = Bound(40, 1.5F);
  if (H.Compression > 2)
    return Error{Where, fmt::format("compression {}, expected 0, 1 or 2",
                                    H.Compression)};
  if (H.Sections > (File.size() - HeaderSize) / SectionHeader)
    return Error{
        Where,
        fmt::format("{} sections, expected a file with all their headers",
                    H.Sections)};
  return H;
}

/// The section whose header is number \p I, with its data at \p Start.
Expected<Section> readSection(const std::string &Where, Bytes File,
                              const Header &H, std::size_t I,
                              std::size_t Start) {
  const Bytes B = File.subspan(HeaderSize + I * SectionHeader, SectionHeader);
  Section S;
  S.Start = Start;
  S.Count = load<uint32_t>(B, 0);
  S.Room = load<uint32_t>(B, 4);
  S.BucketSize = load<uint32_t>(B, 8);
  S.Buckets = load<uint32_t>(B, 12);
  S.BlockSize = load<float>(B, 16);
  const std::size_t BucketRecord = load<uint16_t>(B, 20);
  const auto Range = load<uint32_t>(B, 24);
  S.Range = Range == 0 ? 32767 : Range;
  S.FullBuckets = load<uint32_t>(B, 32);
  S.PartBuckets = load<uint32_t>(B, 36);
  S.ShDegree = load<uint16_t>(B, 40);
  const auto Wrong = [&](std::string What) {
    return Error{Where, fmt::format("section {} {}", I, What)};
  };
  if (S.ShDegree > MaxShDegree)
    return Wrong(fmt::format("has degree {}, expected 0 to 3", S.ShDegree));
  if (S.Count > S.Room)
    return Wrong(
        fmt::format("has {} Gaussians, expected at most its capacity of {}",
                    S.Count, S.Room));
  if (S.Buckets > 0 && BucketRecord != CentreSize)
    return Wrong(
        fmt::format("has buckets of {} bytes, expected 12", BucketRecord));
  if (S.records() + S.Room * H.each(S.ShDegree) > File.size())
    return Wrong(fmt::format("ends at byte {}, expected an end inside the file",
                             S.records() + S.Room * H.each(S.ShDegree)));
  if (H.Compression > 0 && S.FullBuckets + S.PartBuckets > S.Buckets)
    return Wrong(fmt::format("has {} full and {} other buckets, expected {} "
                             "together",
                             S.FullBuckets, S.PartBuckets, S.Buckets));
  return S;
}

/// In which bucket each Gaussian is, in their order: the full ones come first.
class BucketOf {
public:
  BucketOf(Bytes File, const Section &S)
      : File(File), S(S), End(S.FullBuckets * S.BucketSize) {}

  /// Of Gaussian \p I, which is asked for in order; nothing if all buckets
  /// together have fewer.
  std::optional<std::size_t> operator()(std::size_t I) {
    if (I < S.FullBuckets * S.BucketSize)
      return I / S.BucketSize;
    while (I >= End && Part < S.PartBuckets)
      End += load<uint32_t>(File, S.Start + 4 * Part++);
    if (I >= End || Part == 0)
      return std::nullopt;
    return S.FullBuckets + Part - 1;
  }

private:
  Bytes File;
  const Section &S;
  std::size_t End, Part = 0;
};

class Decoder {
public:
  Decoder(Bytes File, const Header &H, Scene &To) : File(File), H(H), To(To) {}

  /// Gaussian \p I of \p S, in \p Bucket, becomes number \p Next.
  void decode(const Section &S, std::size_t I, std::size_t Bucket,
              std::size_t Next) {
    const Bytes Record =
        File.subspan(S.records() + I * H.each(S.ShDegree), H.each(S.ShDegree));
    const std::size_t Wide = H.wide(), Colour = 10 * Wide;
    for (std::size_t A = 0; A < 3; ++A) {
      To.Means[3 * Next + A] = position(S, Record, A, Bucket);
      To.LogScales[3 * Next + A] = std::log(std::max(
          number(Record, (3 + A) * Wide), std::numeric_limits<float>::min()));
    }
    for (std::size_t K = 0; K < 4; ++K)
      To.Quats[4 * Next + K] = number(Record, (6 + K) * Wide);
    float *Sh = &To.Sh[3 * To.coefficients() * Next];
    for (std::size_t C = 0; C < 3; ++C)
      Sh[C] = shOfColor(byteAt(Record, Colour + C) / 255.0);
    To.OpacityLogits[Next] = byteOpacityLogits()[byteAt(Record, Colour + 3)];
    // Degree by degree, and in each channel by channel.
    std::size_t At = Colour + 4;
    for (int Degree = 1; Degree <= S.ShDegree; ++Degree)
      for (std::size_t C = 0; C < 3; ++C)
        for (std::size_t K = shCoefficients(Degree - 1);
             K < shCoefficients(Degree); ++K, At += H.harmonicSize())
          Sh[3 * K + C] = harmonic(Record, At);
  }

private:
  float number(Bytes Record, std::size_t At) const {
    return H.Compression == 0 ? load<float>(Record, At) : half(Record, At);
  }

  float position(const Section &S, Bytes Record, std::size_t Axis,
                 std::size_t Bucket) const {
    if (H.Compression == 0)
      return load<float>(Record, 4 * Axis);
    const double Centre =
        load<float>(File, S.centres() + CentreSize * Bucket + 4 * Axis);
    const double Steps = double(load<uint16_t>(Record, 2 * Axis)) - S.Range;
    return static_cast<float>(Centre + Steps * (S.BlockSize / 2.0 / S.Range));
  }

  float harmonic(Bytes Record, std::size_t At) const {
    return H.Compression == 2
               ? static_cast<float>(lerp(H.LeastHarmonic, H.GreatestHarmonic,
                                         byteAt(Record, At) / 255.0))
               : number(Record, At);
  }

  Bytes File;
  const Header &H;
  Scene &To;
};

} // namespace

bool isKSplat(Bytes File) {
  // Of a `.splat`, these would be Gaussians without a size.
  return File.size() >= Marked && byteAt(File, 0) == 0 &&
         byteAt(File, 1) == 1 &&
         std::ranges::all_of(
             File.subspan(HeaderUsed,
                          std::min(File.size(), HeaderSize) - HeaderUsed),
             [](std::byte B) { return B == std::byte(0); });
}

Expected<SceneFile> parseKSplat(const std::string &Where, Bytes File,
                                const ReadOptions & /*Options*/) {
  const auto H = readHeader(Where, File);
  if (!H)
    return H.error();
  std::vector<Section> Sections;
  std::size_t At = HeaderSize + H->Sections * SectionHeader, Count = 0;
  int ShDegree = 0;
  for (std::size_t I = 0; I < H->Sections; ++I) {
    const auto S = readSection(Where, File, *H, I, At);
    if (!S)
      return S.error();
    At = S->records() + S->Room * H->each(S->ShDegree);
    Count += S->Count;
    ShDegree = std::max(ShDegree, S->Count > 0 ? S->ShDegree : 0);
    Sections.push_back(*S);
  }
  if (At != File.size() || Count != H->Count)
    return Error{Where, fmt::format("sections of {} Gaussians and {} bytes, "
                                    "expected {} and {}",
                                    Count, At, H->Count, File.size())};
  SceneFile Result;
  Result.Format = SceneFormat::KSplat;
  Result.Gaussians = Scene::sized(Count, ShDegree);
  Decoder D(File, *H, Result.Gaussians);
  std::size_t Next = 0;
  for (const Section &S : Sections) {
    BucketOf Bucket(File, S);
    for (std::size_t I = 0; I < S.Count; ++I) {
      const auto In = H->Compression == 0 ? 0 : Bucket(I);
      if (!In)
        return Error{Where, fmt::format("Gaussian {} is in no bucket, expected "
                                        "buckets for {}",
                                        Next, Count)};
      D.decode(S, I, *In, Next++);
    }
  }
  return Result;
}

} // namespace vorion::splat
