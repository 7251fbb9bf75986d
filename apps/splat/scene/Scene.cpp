#include "scene/Scene.h"

#include "vorion/support/Parallel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace vorion::splat {
namespace {

struct Parameter {
  std::string_view Name; ///< for messages
  std::vector<float> Scene::*Values;
  std::size_t Each; ///< values of a Gaussian
};

/// Of scenes of degree \p ShDegree.
std::array<Parameter, 5> parametersOf(int ShDegree) {
  return {{{"position", &Scene::Means, 3},
           {"scales", &Scene::LogScales, 3},
           {"rotation", &Scene::Quats, 4},
           {"opacity", &Scene::OpacityLogits, 1},
           {"colours", &Scene::Sh, 3 * shCoefficients(ShDegree)}}};
}

} // namespace

Scene Scene::sized(std::size_t Count, int ShDegree) {
  Scene S;
  S.ShDegree = ShDegree;
  const auto Parameters = parametersOf(ShDegree);
  const auto Resize = [&](std::size_t I) {
    const auto &[Name, Values, Each] = Parameters[I];
    (S.*Values).resize(Each * Count);
  };
  // From some megabytes on, the system takes longer to clear fresh memory than
  // to start threads.
  constexpr std::size_t WorthThreads = 1 << 16;
  if (Count >= WorthThreads)
    inParallel(Parameters.size(), Resize);
  else
    for (std::size_t I = 0; I < Parameters.size(); ++I)
      Resize(I);
  return S;
}

Expected<Success> checkFinite(const std::string &Where, const Scene &S) {
  std::size_t First = S.size();
  std::string_view Part;
  for (const auto &[Name, Values, Each] : parametersOf(S.ShDegree)) {
    const auto Begin = (S.*Values).begin(), End = (S.*Values).end();
    const auto Bad =
        std::find_if(Begin, End, [](float V) { return !std::isfinite(V); });
    const auto At = static_cast<std::size_t>(Bad - Begin) / Each;
    if (Bad != End && At < First) {
      First = At;
      Part = Name;
    }
  }
  if (First < S.size())
    return Error{Where, fmt::format("Gaussian {} has a NaN or an infinity in "
                                    "its {}, expected finite values",
                                    First, Part)};
  return Success{};
}

std::size_t dropNonFinite(Scene &S) {
  const std::size_t Count = S.size();
  const auto Parameters = parametersOf(S.ShDegree);
  std::vector<bool> Finite(Count, true);
  for (const auto &[Name, Part, Each] : Parameters) {
    const std::vector<float> &Values = S.*Part;
    for (std::size_t I = 0; I < Values.size(); ++I)
      if (!std::isfinite(Values[I]))
        Finite[I / Each] = false;
  }
  for (const auto &[Name, Part, Each] : Parameters) {
    std::vector<float> &Values = S.*Part;
    std::size_t To = 0;
    for (std::size_t I = 0; I < Values.size(); ++I)
      if (Finite[I / Each])
        Values[To++] = Values[I];
    Values.resize(To);
  }
  return Count - S.size();
}

void copy(const Scene &From, std::size_t First, std::size_t Count, Scene &To,
          std::size_t At) {
  assert(To.ShDegree == From.ShDegree && First + Count <= From.size() &&
         At + Count <= To.size());
  for (const auto &[Name, Values, Each] : parametersOf(From.ShDegree))
    std::copy_n((From.*Values).data() + First * Each, Count * Each,
                (To.*Values).data() + At * Each);
}

void append(Scene &To, const Scene &From, std::size_t First,
            std::size_t Count) {
  const std::size_t At = To.size();
  for (const auto &[Name, Values, Each] : parametersOf(To.ShDegree))
    (To.*Values).resize(Each * (At + Count));
  copy(From, First, Count, To, At);
}

} // namespace vorion::splat
