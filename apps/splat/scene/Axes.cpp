#include "scene/Axes.h"

#include <cstdint>
#include <fmt/format.h>

namespace vorion::splat {
namespace {

/// For each coefficient in INRIA's order the axes in which its polynomial is
/// odd: bit 0 for x, 1 for y, 2 for z.
constexpr uint8_t OddAxes[16] = {
    0, 2, 4, 1,       // 1; y, z, x
    3, 6, 0, 5, 0,    // xy, yz, 3zz - 1, xz, xx - yy
    2, 7, 2, 4, 1, 4, // y(3xx - yy), xyz, y(5zz - 1), z(..), x(..), z(..)
    1,                // x(xx - 3yy)
};

} // namespace

Expected<Axes> parseAxes(const std::string &Option, const std::string &Text) {
  constexpr std::string_view Positive = "ruf", Negative = "ldb";
  Axes A{};
  for (std::size_t I = 0; I < 3 && Text.size() == 3; ++I)
    A[I] = Text[I] == Positive[I] ? 1 : Text[I] == Negative[I] ? -1 : 0;
  if (A[0] * A[1] * A[2] == 0)
    return Error{"",
                 fmt::format("{} {}: expected the directions of +x, +y and +z "
                             "as r or l, u or d, f or b (rdf, rub)",
                             Option, Text),
                 ExitCode::Usage};
  return A;
}

Expected<AxesChange> parseAxesChange(const std::string &Option,
                                     const std::string &Text) {
  const std::size_t Colon = Text.find(':');
  if (Colon == std::string::npos)
    return Error{
        "", fmt::format("{} {}: expected FROM:TO, as in rub:rdf", Option, Text),
        ExitCode::Usage};
  const auto From = parseAxes(Option, Text.substr(0, Colon));
  if (!From)
    return From.error();
  const auto To = parseAxes(Option, Text.substr(Colon + 1));
  if (!To)
    return To.error();
  return AxesChange{*From, *To};
}

void changeAxes(Scene &S, const AxesChange &Change) {
  Axes Flip{};
  uint8_t Flipped = 0;
  for (std::size_t A = 0; A < 3; ++A) {
    Flip[A] = Change.From[A] * Change.To[A];
    Flipped |= static_cast<uint8_t>((Flip[A] < 0 ? 1U : 0U) << A);
  }
  if (Flipped == 0)
    return;
  for (std::size_t A = 0; A < 3; ++A)
    S.Origin[A] *= Flip[A];
  // F R F is a rotation for every mirroring F; its axis is that of R times F
  // and F's determinant, so each component gets the other two axes' signs.
  const int Determinant = Flip[0] * Flip[1] * Flip[2];
  const std::size_t Coefficients = S.coefficients();
  for (std::size_t I = 0; I < S.size(); ++I) {
    for (std::size_t A = 0; A < 3; ++A) {
      S.Means[3 * I + A] *= static_cast<float>(Flip[A]);
      if (!S.MeanRests.empty())
        S.MeanRests[3 * I + A] *= Flip[A];
      S.Quats[4 * I + 1 + A] *= static_cast<float>(Determinant * Flip[A]);
    }
    for (std::size_t K = 1; K < Coefficients; ++K)
      if (__builtin_parity(OddAxes[K] & Flipped) != 0)
        for (std::size_t C = 0; C < 3; ++C)
          S.Sh[3 * (Coefficients * I + K) + C] *= -1;
  }
}

} // namespace vorion::splat
