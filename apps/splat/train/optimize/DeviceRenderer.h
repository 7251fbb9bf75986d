/// Forward and backward pass on the device, with rasterizer and cores or only
/// with cores.
#pragma once

#include "render/Backward.h"
#include "train/optimize/GradientRenderer.h"

#include <array>
#include <optional>

namespace vorion::splat {

/// The path of blending and of the backward pass.
struct Blender {
  Blender(Path P) : Kind(P) {}
  Blender(Path P, unsigned Tile, unsigned SimtGroup)
      : Kind(P), Tile(Tile), SimtGroup(SimtGroup) {}

  Path Kind;
  /// For the path `simt` (RenderOptions); the backward pass has groups of 16.
  std::optional<unsigned> Tile;
  unsigned SimtGroup = 256;
};

class DeviceRenderer : public GradientRenderer {
public:
  /// Rendering options besides the rules.
  struct Look {
    std::array<float, 3> Background{};
    bool Several = false;     ///< whether setBackground() will be called
    bool Antialiased = false; ///< scene/Drawing.h
    /// Depth of the near plane; empty: that of the rules.
    std::optional<float> Near = std::nullopt;
    /// \name The cameras
    /// @{
    const LensModel *Optics = CameraModel().Model;
    bool Rolling = false;
    Spread Through = Spread::Jacobian;
    RendererKind Kind = RendererKind::Splat;
    unsigned FalloffDegree = 2;
    ViewFacts Facts{}; ///< those that do not depend on the scene
    /// @}
  };
  /// Renders with the rules \p Convention and the support `exact`.
  DeviceRenderer(Launcher &Launch, Rules Convention, const Blender &By,
                 const BackwardOptions &Backward, const Look &How);

  void setBackground(const std::array<float, 3> &Colour) override {
    Behind = Colour;
  }
  bool divide(TileDivision *By) override {
    Drawing.divide(By);
    return true;
  }
  cl::Buffer forward(const DeviceScene &S, const Camera &C,
                     int ShDegree) override;
  Backward backward(const cl::Buffer &ByRender, const cl::Buffer &ByAlpha,
                    const DepthTargets &Known) override;
  void forget() override {
    if (Back)
      Back->forget();
  }

  /// Number of pairs of each tile of the last picture, copied from the device.
  std::vector<uint32_t> listLengths();

private:
  void build(int ShDegree);

  Launcher &Launch;
  BackwardOptions Choice;
  RenderOptions Options;
  ViewFacts Facts;
  std::array<float, 3> Behind; ///< the picture
  Pipeline Drawing;
  int BuiltDegree = -1; ///< degree of the compiled programs
  std::optional<BackwardPipeline> Back;
  cl::Buffer Picture;
};

} // namespace vorion::splat
