/// Density control: what becomes of each Gaussian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vorion::reference {

enum class Fate : uint8_t { Drop, Keep, Clone, Split };

/// Gaussians that a fate leaves.
constexpr std::size_t becomes(Fate F) {
  return F == Fate::Drop ? 0 : F == Fate::Keep ? 1 : 2;
}

/// What decides about one.
struct DensityFacts {
  double Gradient = 0; ///< mean over the views that saw it, half pictures
  double Scale = 0;    ///< of its longest axis
  double Opacity = 0;
  double Radius = 0; ///< px, largest
};

struct DensityRule {
  double Gradient = 2e-4;      ///< grows above
  double SplitScale = 0;       ///< splits rather than clones above
  double SplitShrink = 1.6;    ///< a half's scale: over this
  double LeastOpacity = 0.005; ///< dropped below
  double MostScale = 0;        ///< dropped above; infinite: never
  double MostRadius = 0;       ///< dropped above; infinite: never
  std::size_t MostGaussians = 0;
};

/// Fates by Kerbl et al. 2023: cloning and splitting first, then dropping what
/// that leaves (a split's halves have no radius yet). Where more than
/// MostGaussians would be left, those with the largest gradients grow, ties by
/// index, and the others are kept as they are.
std::vector<Fate> fatesOf(const std::vector<DensityFacts> &Gaussians,
                          const DensityRule &Rule);

} // namespace vorion::reference
