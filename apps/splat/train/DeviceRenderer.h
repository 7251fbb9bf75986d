/// Forward and back on the device: by rasterizer and cores, or the cores alone.
#pragma once

#include "../render/Backward.h"
#include "GradientRenderer.h"

#include <array>
#include <optional>

namespace vorion::splat {

class DeviceRenderer : public GradientRenderer {
public:
  /// Renders over \p Background by the rules of \p Convention, support `exact`.
  DeviceRenderer(Launcher &Launch, Rules Convention, Path Blending,
                 const BackwardOptions &Backward,
                 const std::array<float, 3> &Background);

  cl::Buffer forward(const DeviceScene &S, const Camera &C,
                     int ShDegree) override;
  Backward backward(const cl::Buffer &ByRender,
                    const cl::Buffer &ByAlpha) override;

private:
  void build(int ShDegree);

  Launcher &L;
  BackwardOptions Choice;
  RenderOptions Options;
  Pipeline Drawing;
  int BuiltDegree = -1; ///< bands that the programs have
  std::optional<BackwardPipeline> Back;
  cl::Buffer Picture;
};

} // namespace vorion::splat
