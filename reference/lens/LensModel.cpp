#include "reference/lens/LensModel.h"

namespace vorion::reference {

double firstFailure(double End, const std::function<bool(double)> &Good) {
  constexpr int Steps = 20000;
  for (int I = 1; I <= Steps; ++I) {
    double Low = End * (I - 1) / Steps, High = End * I / Steps;
    if (Good(High))
      continue;
    for (int K = 0; K < 60; ++K)
      (Good((Low + High) / 2) ? Low : High) = (Low + High) / 2;
    return High;
  }
  return End;
}

Dual<double> distortedRadius(const LensModel &M, const LensCoefficients &K,
                             double Radius) {
  return M.AtWithRows(M.RadialPart(K),
                      {Dual<double>::variable(Radius, 0), 0., 1.})[0];
}

std::span<const LensModel *const> lenses::all() {
  static constexpr std::array List{
#define VORION_LENS(Name) &(Name),
#include "reference/lens/Lenses.def"
  };
  return List;
}

const LensModel *lensModelNamed(std::string_view Name) {
  for (const LensModel *M : lenses::all())
    if (M->Name == Name)
      return M;
  return nullptr;
}

} // namespace vorion::reference
