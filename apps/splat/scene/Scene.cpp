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

/// Keeps the Gaussians \p Kept, in ascending order, in \p Values, which has
/// \p Each of a Gaussian or none.
template <typename Number>
void keep(std::vector<Number> &Values, std::size_t Each,
          const std::vector<std::size_t> &Kept) {
  if (Values.empty())
    return;
  for (std::size_t To = 0; To < Kept.size(); ++To)
    std::copy_n(Values.data() + Kept[To] * Each, Each,
                Values.data() + To * Each);
  Values.resize(Kept.size() * Each);
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

void Scene::setMean(std::size_t I, double Value) {
  const double Local = Value - Origin[I % 3];
  Means[I] = static_cast<float>(Local);
  const double Rest = std::isfinite(Means[I]) ? Local - Means[I] : 0;
  if (MeanRests.empty() && Rest != 0)
    MeanRests.resize(Means.size());
  if (!MeanRests.empty())
    MeanRests[I] = Rest;
}

void Scene::setOrigin(const std::array<double, 3> &To) {
  std::vector<double> World(Means.size());
  for (std::size_t I = 0; I < World.size(); ++I)
    World[I] = mean(I);
  Origin = To;
  for (std::size_t I = 0; I < World.size(); ++I)
    setMean(I, World[I]);
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
  return keepOnly(S, [&Finite](std::size_t I) { return Finite[I]; });
}

std::size_t keepOnly(Scene &S, const std::function<bool(std::size_t)> &Keep) {
  const std::size_t Count = S.size();
  std::vector<std::size_t> Kept;
  for (std::size_t I = 0; I < Count; ++I)
    if (Keep(I))
      Kept.push_back(I);
  for (const auto &[Name, Values, Each] : parametersOf(S.ShDegree))
    keep(S.*Values, Each, Kept);
  keep(S.MeanRests, 3, Kept);
  return Count - Kept.size();
}

void copy(const Scene &From, std::size_t First, std::size_t Count, Scene &To,
          std::size_t At) {
  assert(To.ShDegree == From.ShDegree && To.Origin == From.Origin &&
         First + Count <= From.size() && At + Count <= To.size());
  for (const auto &[Name, Values, Each] : parametersOf(From.ShDegree))
    std::copy_n((From.*Values).data() + First * Each, Count * Each,
                (To.*Values).data() + At * Each);
  if (From.MeanRests.empty() && To.MeanRests.empty())
    return;
  To.MeanRests.resize(To.Means.size());
  for (std::size_t K = 0; K < 3 * Count; ++K)
    To.MeanRests[3 * At + K] =
        From.MeanRests.empty() ? 0 : From.MeanRests[3 * First + K];
}

void append(Scene &To, const Scene &From, std::size_t First,
            std::size_t Count) {
  const std::size_t At = To.size();
  for (const auto &[Name, Values, Each] : parametersOf(To.ShDegree))
    (To.*Values).resize(Each * (At + Count));
  copy(From, First, Count, To, At);
}

} // namespace vorion::splat
