#include "scene/formats/Quantize.h"
#include "scene/formats/Writers.h"

namespace vorion::splat {

std::string splatOf(const Scene &S) {
  std::string Out;
  const std::size_t ShEach = 3 * S.coefficients();
  for (std::size_t I = 0; I < S.size(); ++I) {
    for (std::size_t A = 0; A < 3; ++A)
      put(Out, S.roundedMean(3 * I + A));
    for (std::size_t A = 0; A < 3; ++A)
      put(Out, std::exp(S.LogScales[3 * I + A]));
    for (std::size_t C = 0; C < 3; ++C)
      putByte(Out, std::round(255 * (0.5 + ShC0 * S.Sh[ShEach * I + C])));
    putByte(Out, std::round(255 * opacityOf(S, I)));
    for (const double V : UnitQuat(S, I, Wxyz).Q)
      putByte(Out, std::round(V * 128 + 128));
  }
  return Out;
}

} // namespace vorion::splat
