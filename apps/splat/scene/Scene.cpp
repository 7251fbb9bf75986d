#include "scene/Scene.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace vorion::splat {

Scene Scene::sized(std::size_t Count, int ShDegree) {
  Scene S;
  S.ShDegree = ShDegree;
  S.Means.resize(3 * Count);
  S.LogScales.resize(3 * Count);
  S.Quats.resize(4 * Count);
  S.OpacityLogits.resize(Count);
  S.Sh.resize(3 * Count * S.coefficients());
  return S;
}

Expected<Success> checkFinite(const std::string &Where, const Scene &S) {
  std::size_t First = S.size();
  std::string_view Part;
  const auto Check = [&](std::string_view Name,
                         const std::vector<float> &Values, std::size_t Each) {
    const auto Bad = std::find_if(Values.begin(), Values.end(),
                                  [](float V) { return !std::isfinite(V); });
    const auto At = static_cast<std::size_t>(Bad - Values.begin()) / Each;
    if (Bad != Values.end() && At < First) {
      First = At;
      Part = Name;
    }
  };
  Check("position", S.Means, 3);
  Check("scales", S.LogScales, 3);
  Check("rotation", S.Quats, 4);
  Check("opacity", S.OpacityLogits, 1);
  Check("colours", S.Sh, 3 * S.coefficients());
  if (First < S.size())
    return Error{Where, fmt::format("Gaussian {} holds a NaN or an infinity in "
                                    "its {}, expected finite values",
                                    First, Part)};
  return Success{};
}

std::size_t dropNonFinite(Scene &S) {
  const std::size_t Count = S.size();
  // Each parameter's values and how many of them a Gaussian has.
  const std::pair<std::vector<float> *, std::size_t> Parameters[] = {
      {&S.Means, 3},
      {&S.LogScales, 3},
      {&S.Quats, 4},
      {&S.OpacityLogits, 1},
      {&S.Sh, 3 * S.coefficients()}};
  std::vector<bool> Finite(Count, true);
  for (const auto &[Values, Each] : Parameters)
    for (std::size_t I = 0; I < Values->size(); ++I)
      if (!std::isfinite((*Values)[I]))
        Finite[I / Each] = false;
  for (const auto &[Values, Each] : Parameters) {
    std::size_t To = 0;
    for (std::size_t I = 0; I < Values->size(); ++I)
      if (Finite[I / Each])
        (*Values)[To++] = (*Values)[I];
    Values->resize(To);
  }
  return Count - S.size();
}

void append(Scene &To, const Scene &From, std::size_t First,
            std::size_t Count) {
  assert(To.ShDegree == From.ShDegree && First + Count <= From.size());
  const auto Copy = [&](std::vector<float> &Out, const std::vector<float> &In,
                        std::size_t Each) {
    const float *Start = In.data() + First * Each;
    Out.insert(Out.end(), Start, Start + Count * Each);
  };
  Copy(To.Means, From.Means, 3);
  Copy(To.LogScales, From.LogScales, 3);
  Copy(To.Quats, From.Quats, 4);
  Copy(To.OpacityLogits, From.OpacityLogits, 1);
  Copy(To.Sh, From.Sh, 3 * From.coefficients());
}

} // namespace vorion::splat
