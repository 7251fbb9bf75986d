#include "Judge.h"

#include "Convert.h"
#include "analyze/ToReference.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <iterator>

namespace vorion::test {
namespace {

/// How many times the fp32 reference's error is allowed.
constexpr double Times = 10;
/// The fp32 reference counts as no better than this, in parts of the largest
/// colour: an exact result by luck binds nobody.
constexpr double LeastError = 0x1p-22;
/// Share of the doubtful pixels that may decide as neither reference does.
constexpr double ThirdWayShare = 0.05;

splat::Scene without(const splat::Scene &S, const std::vector<uint32_t> &Out) {
  splat::Scene Rest = splat::Scene::sized(0, S.ShDegree);
  for (uint32_t I = 0; I < S.size(); ++I)
    if (std::ranges::find(Out, I) == Out.end())
      append(Rest, S, I, 1);
  return Rest;
}

/// Depths for colours.
template <typename Real>
void showDepths(std::vector<reference::Splat<Real>> &Splats) {
  for (auto &S : Splats)
    S.Color = {S.Depth, 0, 0};
}

/// Normals for colours: the shortest axis, towards the camera. Whether it is
/// clear for each on which side that is.
template <typename Real>
bool showNormals(std::vector<reference::Splat<Real>> &Splats,
                 const splat::Scene &S, const splat::Camera &View) {
  bool Settled = true;
  for (std::size_t At = 0; At < Splats.size(); ++At) {
    const std::size_t I = At % S.size();
    if (!Splats[At].Visible)
      continue;
    const float *const Scales = S.LogScales.data() + 3 * I;
    const auto Axis =
        static_cast<int>(std::min_element(Scales, Scales + 3) - Scales);
    glm::dvec4 Q(0);
    for (int K = 0; K < 4; ++K)
      Q[K] = double(S.Quats[4 * I + static_cast<std::size_t>(K)]);
    if (const double Length = glm::length(Q); Length > 0)
      Q /= Length;
    // The axis turned, as q v q* is: v + 2 w (u x v) + 2 u x (u x v).
    glm::dvec3 V(0);
    V[Axis] = 1;
    const glm::dvec3 U(Q[1], Q[2], Q[3]);
    const glm::dvec3 Across = glm::cross(U, V);
    glm::dvec3 N = V + 2 * Q[0] * Across + 2.0 * glm::cross(U, Across);
    glm::dvec3 From(0);
    for (int K = 0; K < 3; ++K) {
      const auto Of = static_cast<std::size_t>(K);
      From[K] = double(S.Means[3 * I + Of]) - View.Position[Of];
    }
    const double Along = glm::dot(N, From);
    Settled &= std::abs(Along) > 1e-5 * glm::length(From);
    if (Along > 0)
      N = -N;
    Splats[At].Color = glm::vec<3, Real>(N);
  }
  return Settled;
}

} // namespace

reference::Options referenceOptions(const splat::RenderOptions &O) {
  reference::Options R = toReference(O);
  R.Threads = 1;
  return R;
}

Judge::Judge(const HardCase &C, const splat::RenderOptions &O, Shown What)
    : Case(C), Cutoff(double(O.Cutoff)),
      LeastAlpha(double(O.AlphaCutoff) / 255) {
  reference::Options R = referenceOptions(O);
  const auto View = splat::toReference<double>(C.View);
  auto SingleSplats = reference::project(splat::toReference<float>(C.Scene),
                                         splat::toReference<float>(C.View), R);
  // Under other rules fp32 may draw them.
  std::vector<uint32_t> LeftOut;
  std::ranges::copy_if(C.BeyondSingle, std::back_inserter(LeftOut),
                       [&](uint32_t I) { return !SingleSplats[I].Visible; });
  const splat::Scene Drawn = without(C.Scene, LeftOut);
  auto Splats = reference::project(splat::toReference<double>(Drawn), View, R);
  if (What == Shown::Depths) {
    showDepths(SingleSplats);
    showDepths(Splats);
    R.Background = {};
  }
  if (What == Shown::Normals) {
    showNormals(SingleSplats, C.Scene, C.View);
    Settled = showNormals(Splats, Drawn, C.View);
    R.Background = {};
  }
  for (const auto &S : Splats)
    if (S.Visible)
      for (int K = 0; K < 3; ++K)
        Peak = std::max(Peak, std::abs(S.Color[K]));
  const auto P = reference::blend(Splats, View.Width, View.Height, R);
  Exact = renderOf(P);
  Doubts = P.Doubts;
  Single = renderOf(reference::blend(SingleSplats, View.Width, View.Height, R));
}

Verdict Judge::judge(const splat::RenderResult &R, double Allowance,
                     bool OwnOptions) const {
  Verdict V;
  std::size_t Doubtful = 0;
  for (const uint8_t D : Doubts)
    Doubtful += D != 0;
  V.Doubtful = double(Doubtful) / double(Doubts.size());
  for (std::size_t I = 0; I < Exact.size(); ++I)
    if (Doubts[I / 3] == 0)
      V.Single = std::max(V.Single, std::abs(Single[I] - Exact[I]));
  V.Bound = std::min(Times * std::max(V.Single, LeastError * Peak),
                     OwnOptions ? Case.Cap : HUGE_VAL) +
            Allowance * Peak;

  // A doubtful pixel shows what fp32 or fp64 decides; a few may take a third
  // way, which one decision more or less is apart from either: an alpha at
  // the smallest, T at the cut-off, or two Gaussians of nearly one depth.
  const double Decision =
      Peak * std::min(1.0, 2 * LeastAlpha + 100 * Cutoff) + V.Bound;
  bool WorseThanDecision = false;
  std::size_t ThirdWay = 0;
  for (std::size_t I = 0; I < Exact.size(); ++I) {
    const double Is = R.Picture.Render[I];
    const double Off = std::isfinite(Is) ? std::abs(Is - Exact[I]) : HUGE_VAL;
    if (Doubts[I / 3] == 0) {
      V.Error = std::max(V.Error, Off);
      continue;
    }
    V.DoubtfulError = std::max(V.DoubtfulError, Off);
    const double Least = std::min(Off, std::abs(Is - Single[I]));
    const bool Ordered = (Doubts[I / 3] & reference::DoubtOrder) == 0;
    WorseThanDecision |= !(Least <= (Ordered ? Decision : Peak));
    ThirdWay += Least > V.Bound;
  }

  uint64_t Sum = R.Visible;
  for (const uint64_t N : R.Culled)
    Sum += N;
  if (!(V.Error <= V.Bound))
    V.Broken =
        fmt::format("error {:.3g}, expected at most {:.3g}", V.Error, V.Bound);
  else if (WorseThanDecision)
    V.Broken = fmt::format("a doubtful pixel is off by {:.3g}, expected one "
                           "decision, {:.3g}",
                           V.DoubtfulError, Decision);
  else if (double(ThirdWay) >
           std::max(6.0, 3 * ThirdWayShare * double(Doubtful)))
    V.Broken = fmt::format("{} channels of {} doubtful pixels are neither "
                           "fp32's nor fp64's",
                           ThirdWay, Doubtful);
  else if (OwnOptions && V.Doubtful > Case.MostDoubtful)
    V.Broken = fmt::format("{:.1f} % doubtful, expected {:.1f} %",
                           100 * V.Doubtful, 100 * Case.MostDoubtful);
  else if (Sum != Case.Scene.size())
    V.Broken = fmt::format("{} Gaussians seen or culled, expected {}", Sum,
                           Case.Scene.size());
  else if (OwnOptions && R.Culled != Case.ExpectedCulls)
    for (std::size_t K = 0; K < R.Culled.size(); ++K)
      if (R.Culled[K] != Case.ExpectedCulls[K])
        V.Broken = fmt::format("{} culled as {}, expected {}", R.Culled[K],
                               splat::CullReasons[K], Case.ExpectedCulls[K]);
  return V;
}

} // namespace vorion::test
