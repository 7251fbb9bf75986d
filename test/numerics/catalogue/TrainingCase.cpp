#include "TrainingCase.h"

#include <cmath>
#include <fmt/format.h>

namespace vorion::test {

TrainingCase withoutBlending(const char *Name, const char *Why,
                             std::string Contract,
                             Expected<Finding> (*Run)(splat::Launcher &),
                             std::vector<std::string> FoundIn) {
  return {Name,
          Why,
          std::move(Contract),
          [=](splat::Launcher &L, splat::Path) { return Run(L); },
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
