/// Forward and back on the device: by rasterizer and cores, or the cores alone.
#pragma once

#include "render/Backward.h"
#include "train/optimize/GradientRenderer.h"

#include <array>
#include <optional>

namespace vorion::splat {

/// What blends and goes back.
struct Blender {
  Blender(Path P) : Kind(P) {}
  Blender(Path P, unsigned SimtTile, unsigned SimtGroup)
      : Kind(P), SimtTile(SimtTile), SimtGroup(SimtGroup) {}

  Path Kind;
  /// Of the cores alone (RenderOptions); going back has groups of 16.
  unsigned SimtTile = 16, SimtGroup = 256;
};

class DeviceRenderer : public GradientRenderer {
public:
  /// How pictures are drawn beside the rules.
  struct Look {
    std::array<float, 3> Background{};
    bool Several = false;     ///< setBackground() will follow
    bool Antialiased = false; ///< scene/Drawing.h
    /// \name The cameras
    /// @{
    const LensModel *Optics = CameraModel().Model;
    bool Rolling = false;
    Spread Through = Spread::Jacobian;
    ViewFacts Facts{}; ///< those that need no scene
    /// @}
  };
  /// Renders by the rules of \p Convention, support `exact`.
  DeviceRenderer(Launcher &Launch, Rules Convention, const Blender &By,
                 const BackwardOptions &Backward, const Look &How);

  void setBackground(const std::array<float, 3> &Colour) override {
    Behind = Colour;
  }
  cl::Buffer forward(const DeviceScene &S, const Camera &C,
                     int ShDegree) override;
  Backward backward(const cl::Buffer &ByRender, const cl::Buffer &ByAlpha,
                    const DepthTargets &Known) override;
  void forget() override {
    if (Back)
      Back->forget();
  }

  /// Pairs of every tile of the last picture; copied from the device.
  std::vector<uint32_t> listLengths();

private:
  void build(int ShDegree);

  Launcher &Launch;
  BackwardOptions Choice;
  RenderOptions Options;
  ViewFacts Facts;
  std::array<float, 3> Behind; ///< the picture
  Pipeline Drawing;
  int BuiltDegree = -1; ///< bands that the programs have
  std::optional<BackwardPipeline> Back;
  cl::Buffer Picture;
};

} // namespace vorion::splat
