/// The training loss of 3DGS of a picture against a photograph.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace vorion::reference {

/// L = (1 - DSsim) mean |x - y| + DSsim (1 - mean SSIM), means over pixels and
/// channels. SSIM (Wang et al. 2004) with a Gaussian window and zero padding,
/// without renormalization at the border.
struct LossRule {
  double DSsim = 0.2;
  int Reach = 5;               ///< the window has 2 Reach + 1 pixels a side
  double Sigma = 1.5;          ///< px
  double C1 = 1e-4, C2 = 9e-4; ///< (0.01)^2 and (0.03)^2 for values 0 to 1
};

struct Loss {
  double Absolute = 0; ///< mean |x - y|
  double Ssim = 0;     ///< mean
  double Value = 0;
  std::vector<glm::dvec3> Gradient; ///< dL/dx; the sign of 0 is 0
};

/// Loss of picture \p X against \p Y, both rows from the top, directly by the
/// definition: no separable window.
Loss lossOf(const std::vector<glm::dvec3> &X, const std::vector<glm::dvec3> &Y,
            int Width, int Height, const LossRule &Rule = {});

} // namespace vorion::reference
