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
    float Cutoff = 0; ///< a pixel stops below this transmittance
    uint32_t Gaussians = 0;
    uint32_t Pixels = 0;  ///< 0: not known yet, and the rest neither
    uint32_t Latency = 0; ///< of memory, in cycles
    uint32_t Fragments = 0, Blends = 0;
    /// By the clock: all cycles, and by reason.
    uint32_t Cycles = 0, Begin = 0, Fetch = 0, Clip = 0, Blend = 0, Hazard = 0,
             Flush = 0, Drain = 0;
  } What;
  std::vector<std::array<uint32_t, 12>> Gaussians; ///< vx_gaussian records
  std::vector<std::array<uint32_t, 4>> Pixels;     ///< in rows: r, g, b, T

  /// False at the end of \p File, or where it is cut off.
  bool read(std::FILE *File) {
    if (std::fread(&What, sizeof(What), 1, File) != 1)
      return false;
    Gaussians.resize(What.Gaussians);
    Pixels.resize(What.Pixels);
    return std::fread(Gaussians.data(), sizeof(Gaussians[0]), Gaussians.size(),
                      File) == Gaussians.size() &&
           std::fread(Pixels.data(), sizeof(Pixels[0]), Pixels.size(), File) ==
               Pixels.size();
  }
  bool write(std::FILE *File) const {
    return std::fwrite(&What, sizeof(What), 1, File) == 1 &&
           std::fwrite(Gaussians.data(), sizeof(Gaussians[0]), Gaussians.size(),
                       File) == Gaussians.size() &&
           std::fwrite(Pixels.data(), sizeof(Pixels[0]), Pixels.size(), File) ==
               Pixels.size();
  }
};

} // namespace vorion
