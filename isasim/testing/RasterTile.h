/// A tile for test/rtl in a file: what a rasterizer is given, what it has to
/// answer, and how long the clock says that it takes. Numbers are the host's.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace vorion {

struct RasterTile {
  /// Where a tile lies in the memory of whoever runs it. Entry i of the list is
  /// record i.
  static constexpr uint32_t List = 0x10000, Target = 0x100000,
                            Records = 0x120000;
  static constexpr uint32_t Pitch = 64 * 16;

  struct Head {
    std::array<char, 32> Name{};
    uint32_t X = 0, Y = 0, Width = 0, Height = 0;
    float Cutoff = 0;       ///< a pixel stops below this transmittance
    uint32_t Gaussians = 0; ///< or triangles
    uint32_t Pixels = 0;    ///< 0: not known yet, and the rest neither
    uint32_t Latency = 0;   ///< of memory, in cycles
    uint32_t Fragments = 0, Blends = 0;
    /// By the clock: all cycles, and by reason.
    uint32_t Cycles = 0, Begin = 0, Fetch = 0, Clip = 0, Blend = 0, Hazard = 0,
             Flush = 0, Drain = 0;
    /// Of triangles: VR_PRIMITIVE_TRIANGLE, VR_WORD_DEPTH and
    /// VR_WORD_DEPTH_CLEAR, which no Gaussian needs.
    uint32_t Primitive = 0, Depth = 0;
    float ClearDepth = 0;
  } What;
  std::vector<uint32_t> Input;  ///< records, word by word
  std::vector<uint32_t> Output; ///< pixels in rows, word by word

  /// vx_triangle, or vx_gaussian.
  uint32_t recordBytes() const { return What.Primitive ? 72 : 48; }
  /// Depth and primitive ID, or r, g, b, T.
  uint32_t pixelBytes() const { return What.Primitive ? 8 : 16; }

  /// False at the end of \p File, or where it is cut off.
  bool read(std::FILE *File) {
    if (std::fread(&What, sizeof(What), 1, File) != 1)
      return false;
    Input.resize(size_t{What.Gaussians} * recordBytes() / 4);
    Output.resize(size_t{What.Pixels} * pixelBytes() / 4);
    return std::fread(Input.data(), 4, Input.size(), File) == Input.size() &&
           std::fread(Output.data(), 4, Output.size(), File) == Output.size();
  }
  bool write(std::FILE *File) const {
    return std::fwrite(&What, sizeof(What), 1, File) == 1 &&
           std::fwrite(Input.data(), 4, Input.size(), File) == Input.size() &&
           std::fwrite(Output.data(), 4, Output.size(), File) == Output.size();
  }
};

/// Likewise of the backward mode, whose list is gone through from its end.
struct BackwardTile {
  struct Head {
    uint32_t X = 0, Y = 0, Width = 0, Height = 0, Gaussians = 0;
    uint32_t ClampStops = 0;
  } What;
  std::vector<std::array<uint32_t, 12>> Gaussians; ///< vx_gaussian records
  /// In rows: dL/dr, dL/dg, dL/db, T, behind, last.
  std::vector<std::array<uint32_t, 6>> Pixels;
  std::vector<std::array<uint32_t, 2>> After; ///< T and behind, in rows
  std::vector<std::array<uint32_t, 9>> Sums;  ///< by entry of the list

  bool read(std::FILE *File) {
    if (std::fread(&What, sizeof(What), 1, File) != 1)
      return false;
    const size_t Count = size_t{What.Width} * What.Height;
    Gaussians.resize(What.Gaussians);
    Pixels.resize(Count);
    After.resize(Count);
    Sums.resize(What.Gaussians);
    const auto All = [&](auto &Rows) {
      return std::fread(Rows.data(), sizeof(Rows[0]), Rows.size(), File) ==
             Rows.size();
    };
    return All(Gaussians) && All(Pixels) && All(After) && All(Sums);
  }
  bool write(std::FILE *File) const {
    const auto All = [&](const auto &Rows) {
      return std::fwrite(Rows.data(), sizeof(Rows[0]), Rows.size(), File) ==
             Rows.size();
    };
    return std::fwrite(&What, sizeof(What), 1, File) == 1 && All(Gaussians) &&
           All(Pixels) && All(After) && All(Sums);
  }
};

} // namespace vorion
