/// Pictures on the triangles of a mesh.
#pragma once

#include "io/Bytes.h"
#include "vorion/support/Expected.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace vorion::splat {

/// What is beyond the border of a texture.
enum class Wrap : uint8_t { Repeat, Mirror, Clamp };

/// How a texture is sampled (OpenGL ES 3.2, 8.14).
struct Sampler {
  std::array<Wrap, 2> Wraps{Wrap::Repeat, Wrap::Repeat}; ///< across and down
  bool MagnifiesLinearly = true; ///< else the nearest texel is taken
  bool MinifiesLinearly = true;
  /// Which of the smaller levels are taken where texels are smaller than
  /// pixels: none, the nearest one, or two, linearly.
  enum class Mips : uint8_t { None, Nearest, Linear } Levels = Mips::Linear;

  bool operator==(const Sampler &) const = default;
};

/// A picture in levels, each half as large as the one before, down to 1x1.
struct Texture {
  struct Level {
    std::size_t Width = 0, Height = 0;
    std::size_t First = 0; ///< texel, in Texels
  };
  std::vector<Level> Levels;
  /// Red, green, blue (as stored: sRGB) and alpha from the lowest byte on; rows
  /// from the top.
  std::vector<uint32_t> Texels;
  std::vector<std::byte> File; ///< the PNG, JPEG or WebP that it was read from
};

/// Levels that a texture may have: one of 32,768 texels a side.
inline constexpr std::size_t MaxTextureLevels = 16;
/// Texels of all levels of a texture.
inline constexpr std::size_t MaxTexels = std::size_t{1} << 28;

/// Of the \p Texels of the first level, averages the others: in linear light,
/// by area, each from the one before, rounded to 8 bits. Error: too large.
Expected<Texture> makeTexture(const std::string &Where, std::size_t Width,
                              std::size_t Height, std::vector<uint32_t> Texels);

/// The same for the PNG, JPEG or WebP \p File.
Expected<Texture> decodeTexture(const std::string &Where, Bytes File);

/// \p Stored as sRGB has it, 0 to 1, in linear light, and back.
double toLinear(double Stored);
double fromLinear(double Linear);

} // namespace vorion::splat
