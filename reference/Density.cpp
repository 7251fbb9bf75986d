#include "Density.h"

#include <algorithm>

namespace vorion::reference {

std::vector<Fate> fatesOf(const std::vector<DensityFacts> &Gaussians,
                          const DensityRule &Rule) {
  std::vector<Fate> Fates;
  std::vector<std::size_t> Growing;
  std::size_t Left = 0;
  for (const DensityFacts &G : Gaussians) {
    const bool Grows = G.Gradient > Rule.Gradient;
    const bool Splits = Grows && G.Scale > Rule.SplitScale;
    Fate F = Splits ? Fate::Split : Grows ? Fate::Clone : Fate::Keep;
    const double Scale = Splits ? G.Scale / Rule.SplitShrink : G.Scale;
    if (G.Opacity < Rule.LeastOpacity || Scale > Rule.MostScale ||
        (!Splits && G.Radius > Rule.MostRadius))
      F = Fate::Drop;
    if (becomes(F) == 2)
      Growing.push_back(Fates.size());
    Left += becomes(F);
    Fates.push_back(F);
  }
  if (Left <= Rule.MostGaussians)
    return Fates;
  std::ranges::sort(Growing, [&](std::size_t A, std::size_t B) {
    const double Ga = Gaussians[A].Gradient, Gb = Gaussians[B].Gradient;
    return Ga > Gb || (Ga == Gb && A < B);
  });
  const std::size_t Kept = Left - Growing.size();
  const std::size_t More =
      Rule.MostGaussians > Kept ? Rule.MostGaussians - Kept : 0;
  for (std::size_t Rank = More; Rank < Growing.size(); ++Rank)
    Fates[Growing[Rank]] = Fate::Keep;
  return Fates;
}

} // namespace vorion::reference
