/// The loss of a picture on the device, and its gradient.
#pragma once

#include "capture/Photo.h"
#include "device/Launcher.h"

#include <vector>

namespace vorion::splat {

ProgramSpec lossProgram();
/// For pictures of which some pixels do not count.
ProgramSpec maskProgram();

struct LossValues {
  double Absolute = 0; ///< mean over pixels and channels
  double Ssim = 0;     ///< mean
  double Value = 0;    ///< (1 - D) Absolute + D (1 - Ssim)
};

/// Buffers are kept from picture to picture and grow with the largest one.
/// Pixels are added in a fixed order: of tiles in fp32 on the device, their
/// sums in double.
class PictureLoss {
public:
  PictureLoss(Launcher &Launch, double DSsimShare)
      : Launch(Launch), DSsim(DSsimShare) {}

  /// \p Picture has four floats a pixel, of which the first three are compared
  /// with \p Target; dL/dpicture goes to \c gradient(), three floats a pixel.
  /// Where \p Counts, if it is not empty, has a 0 for a pixel, that pixel is
  /// black in both; means are over the pixels that count.
  LossValues evaluate(const cl::Buffer &Picture, const Photo &Target,
                      const std::vector<uint8_t> &Counts = {});
  const cl::Buffer &gradient() const { return Gradient; }
  /// The loss does not know alpha: a 0 for each pixel.
  const cl::Buffer &alphaGradient() const { return NoAlpha; }

private:
  void reserve(uint64_t Pixels, uint64_t Tiles);

  Launcher &Launch;
  double DSsim;
  uint64_t Room = 0, TileRoom = 0;
  cl::Buffer Packed, Slopes, Totals, Gradient, NoAlpha, Masked;
  uint64_t MaskRoom = 0;
  std::vector<uint32_t> HostPacked;
  std::vector<float> HostTotals;
};

} // namespace vorion::splat
