/// The loss of a picture on the device, and its gradient.
#pragma once

#include "capture/Photo.h"
#include "device/Launcher.h"
#include "render/TileDivision.h"

#include <vector>

namespace vorion::splat {

/// \p Divided: for pictures whose rows are divided over processes.
ProgramSpec lossProgram(bool Divided = false);
/// For pictures with masks.
ProgramSpec maskProgram();

struct LossValues {
  double Absolute = 0; ///< mean over pixels and channels
  double Ssim = 0;     ///< mean
  double Value = 0;    ///< (1 - D) Absolute + D (1 - Ssim)
};

/// Buffers are reused, and grow with the largest picture. Pixels are summed in
/// a fixed order: within tiles in fp32 on the device, and the sums of tiles in
/// double precision.
class PictureLoss {
public:
  PictureLoss(Launcher &Launch, double DSsimShare)
      : Launch(Launch), DSsim(DSsimShare) {}

  /// \p Picture has four floats per pixel. The first three are compared with
  /// \p Target. \c gradient() is then dL/dpicture, three floats
  /// per pixel. Pixels with a 0 in \p Counts (if not empty) are black in both
  /// pictures and excluded from means. If \p Among is set, \c gradient() has
  /// only the rows of this process.
  LossValues evaluate(const cl::Buffer &Picture, const Photo &Target,
                      const std::vector<uint8_t> &Counts = {},
                      TileDivision *Among = nullptr);
  const cl::Buffer &gradient() const { return Gradient; }
  /// 0 for each pixel, because the loss does not depend on alpha.
  const cl::Buffer &alphaGradient() const { return NoAlpha; }

private:
  void reserve(uint64_t Pixels, uint64_t Tiles);

  Launcher &Launch;
  double DSsim;
  bool BuiltDivided = false;
  uint64_t Room = 0, TileRoom = 0;
  cl::Buffer Packed, Slopes, Totals, Gradient, NoAlpha, Masked;
  uint64_t MaskRoom = 0;
  std::vector<uint32_t> HostPacked;
  std::vector<float> HostTotals;
};

} // namespace vorion::splat
