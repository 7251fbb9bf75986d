#include "TrainingCase.h"

#include <cmath>
#include <fmt/format.h>

namespace vorion::test {

std::string_view name(const Way &W) {
  return W.Sums == splat::SimtSums::Ordered ? splat::name(W.Blending)
                                            : splat::name(W.Sums);
}

std::vector<Way> waysOf(const TrainingCase &C) {
  using splat::Path;
  if (!C.Blends)
    return {{Path::Raster}};
  std::vector<Way> Ways;
  if (C.Only != Path::Simt)
    Ways.push_back({Path::Raster});
  if (C.Only != Path::Raster)
    Ways.push_back({Path::Simt});
  if (C.GoesBack && C.Only != Path::Raster)
    for (const auto Sums : {splat::SimtSums::Atomics, splat::SimtSums::Warp})
      Ways.push_back({Path::Simt, Sums});
  return Ways;
}

TrainingCase withoutBlending(const char *Name, const char *Why,
                             std::string Contract,
                             Expected<Finding> (*Run)(splat::Launcher &),
                             std::vector<std::string> FoundIn) {
  return {Name,
          Why,
          std::move(Contract),
          [=](splat::Launcher &L, const Way &) { return Run(L); },
          std::move(FoundIn),
          /*Blends=*/false};
}

void Worst::take(std::string_view What, double Is, double Want, double Unit) {
  const double Off = std::abs(Is - Want);
  const double Error = Off == 0 ? 0 : Off / Unit;
  if (!(Error <= F.Error))
    F.Error = Error;
  if (!(Error <= F.Bound) && F.Broken.empty())
    F.Broken = fmt::format("{} is {:.7g}, expected {:.7g}", What, Is, Want);
}

} // namespace vorion::test
