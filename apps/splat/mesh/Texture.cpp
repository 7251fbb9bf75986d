#include "mesh/Texture.h"

#include "io/PhotoFile.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace vorion::splat {
namespace {

/// The part of a side of \p From texels that texel \p I of \p To covers.
struct Cover {
  std::size_t First = 0;
  std::vector<double> Shares; ///< of the texels from First on; their sum is 1
};

std::vector<Cover> coversOf(std::size_t From, std::size_t To) {
  const double Step = static_cast<double>(From) / static_cast<double>(To);
  std::vector<Cover> Covers(To);
  for (std::size_t I = 0; I < To; ++I) {
    const double Begin = static_cast<double>(I) * Step, End = Begin + Step;
    Cover &C = Covers[I];
    C.First = static_cast<std::size_t>(Begin);
    for (std::size_t K = C.First; K < From && static_cast<double>(K) < End; ++K)
      C.Shares.push_back((std::min(End, static_cast<double>(K + 1)) -
                          std::max(Begin, static_cast<double>(K))) /
                         Step);
  }
  return Covers;
}

/// The 256 values of a channel in linear light.
const std::array<double, 256> &linearOfBytes() {
  static const auto Table = [] {
    std::array<double, 256> T{};
    for (std::size_t I = 0; I < T.size(); ++I)
      T[I] = toLinear(static_cast<double>(I) / 255);
    return T;
  }();
  return Table;
}

uint32_t byteOf(double Value) {
  return static_cast<uint32_t>(std::lround(255 * std::clamp(Value, 0.0, 1.0)));
}

/// Appends the level that is half as large as the last one of \p T.
void appendLevel(Texture &T) {
  const Texture::Level Last = T.Levels.back();
  const Texture::Level Next{std::max<std::size_t>(Last.Width / 2, 1),
                            std::max<std::size_t>(Last.Height / 2, 1),
                            T.Texels.size()};
  const std::vector<Cover> Columns = coversOf(Last.Width, Next.Width),
                           Rows = coversOf(Last.Height, Next.Height);
  const auto &Linear = linearOfBytes();
  for (const Cover &Row : Rows)
    for (const Cover &Column : Columns) {
      std::array<double, 4> Sum{};
      for (std::size_t R = 0; R < Row.Shares.size(); ++R)
        for (std::size_t C = 0; C < Column.Shares.size(); ++C) {
          const uint32_t Texel =
              T.Texels[Last.First + (Row.First + R) * Last.Width +
                       Column.First + C];
          const double Share = Row.Shares[R] * Column.Shares[C];
          for (std::size_t K = 0; K < 3; ++K)
            Sum[K] += Share * Linear[Texel >> 8 * K & 0xFF];
          Sum[3] += Share * (Texel >> 24) / 255;
        }
      uint32_t Texel = byteOf(Sum[3]) << 24;
      for (std::size_t K = 0; K < 3; ++K)
        Texel |= byteOf(fromLinear(Sum[K])) << 8 * K;
      T.Texels.push_back(Texel);
    }
  T.Levels.push_back(Next);
}

} // namespace

double toLinear(double Stored) {
  return Stored <= 0.04045 ? Stored / 12.92
                           : std::pow((Stored + 0.055) / 1.055, 2.4);
}

double fromLinear(double Linear) {
  return Linear <= 0.0031308 ? 12.92 * Linear
                             : 1.055 * std::pow(Linear, 1 / 2.4) - 0.055;
}

static Expected<Success> checkSize(const std::string &Where, std::size_t Width,
                                   std::size_t Height) {
  constexpr std::size_t MostSide = std::size_t{1} << (MaxTextureLevels - 1);
  // The other levels have a third of the first one's texels.
  if (std::max(Width, Height) > MostSide || Width * Height > MaxTexels / 4 * 3)
    return Error{Where,
                 fmt::format("a texture of {}x{} texels, expected sides "
                             "of at most {} and at most {} in all",
                             Width, Height, MostSide, MaxTexels / 4 * 3)};
  return Success{};
}

Expected<Texture> makeTexture(const std::string &Where, std::size_t Width,
                              std::size_t Height,
                              std::vector<uint32_t> Texels) {
  if (auto Fits = checkSize(Where, Width, Height); !Fits)
    return Fits.error();
  Texture T;
  T.Levels.push_back({Width, Height, 0});
  T.Texels = std::move(Texels);
  while (T.Levels.back().Width > 1 || T.Levels.back().Height > 1)
    appendLevel(T);
  return T;
}

Expected<Texture> decodeTexture(const std::string &Where, Bytes File) {
  const auto Size = photoSize(Where, File);
  if (!Size)
    return Size.error();
  if (auto Fits = checkSize(Where, static_cast<std::size_t>(Size->Width),
                            static_cast<std::size_t>(Size->Height));
      !Fits)
    return Fits.error();
  const auto P = decodePhoto(Where, File);
  if (!P)
    return P.error();
  std::vector<uint32_t> Texels(P->pixels());
  for (std::size_t I = 0; I < Texels.size(); ++I)
    Texels[I] = load<uint32_t>(P->Rgba, 4 * I);
  auto T = makeTexture(Where, P->Width, P->Height, std::move(Texels));
  if (T)
    T->File.assign(File.begin(), File.end());
  return T;
}

} // namespace vorion::splat
