#include "Contributors.h"

#include "Convert.h"
#include "Judge.h"
#include "reference/Pixel.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace vorion::test {
namespace {

/// As in Judge.cpp.
constexpr double Times = 10;
constexpr double LeastError = 0x1p-22;
/// Of T at a median's border, and of a depth.
constexpr double Band = 1e-4, DepthError = 1e-6;
/// Fewer than most pixels of a case have.
constexpr unsigned Top = 5;
/// Pixels of a picture that is not gone through: minutes of the reference.
constexpr std::size_t MostPixels = 1U << 18;

template <typename Real>
using Pixels = std::vector<std::vector<reference::Contributor<Real>>>;

template <typename Real>
double weightOf(const std::vector<reference::Contributor<Real>> &Pixel,
                int32_t Index) {
  const auto At =
      std::ranges::find(Pixel, Index, &reference::Contributor<Real>::Index);
  return At == Pixel.end() ? 0 : double(At->Weight);
}

/// The largest difference of a weight, of pixels that are not doubtful.
double errorOf(const Pixels<float> &Single, const Pixels<double> &Exact,
               const std::vector<uint8_t> &Doubts) {
  double Error = 0;
  for (std::size_t P = 0; P < Exact.size(); ++P) {
    if (Doubts[P] != 0)
      continue;
    for (const auto &C : Exact[P])
      Error =
          std::max(Error, std::abs(weightOf(Single[P], C.Index) - C.Weight));
    for (const auto &C : Single[P])
      Error = std::max(
          Error, std::abs(double(C.Weight) - weightOf(Exact[P], C.Index)));
  }
  return Error;
}

/// Whether \p Depth is that of a Gaussian at which half of the light may be
/// left, or of the last one.
bool isMedian(double Depth,
              const std::vector<reference::Contributor<double>> &Pixel,
              const std::vector<reference::Splat<double>> &Splats) {
  if (Pixel.empty())
    return Depth == 0;
  for (std::size_t K = 0; K < Pixel.size(); ++K) {
    const auto &C = Pixel[K];
    const double InFront = C.Weight / C.Alpha;
    const double Behind = InFront - C.Weight;
    const double Is = Splats[static_cast<std::size_t>(C.Index)].Depth;
    if (InFront > 0.5 - Band &&
        (Behind < 0.5 + Band || K + 1 == Pixel.size()) &&
        std::abs(Depth - Is) <= DepthError * std::abs(Is))
      return true;
  }
  return false;
}

} // namespace

std::string wrongContributors(const HardCase &C, const splat::RenderOptions &O,
                              const splat::PixelLists &L) {
  // What fp32 does not draw has no place in the lists.
  if (L.pixels() > MostPixels || !C.BeyondSingle.empty())
    return {};
  const reference::Options R = referenceOptions(O);
  const int Width = C.View.Width, Height = C.View.Height;
  const auto Splats = reference::project(splat::toReference<double>(C.Scene),
                                         splat::toReference<double>(C.View), R);
  const auto Doubts = reference::blend(Splats, Width, Height, R).Doubts;
  const auto Exact = reference::contributorsOfAll(Splats, Width, Height, R);
  const auto Single = reference::contributorsOfAll(
      reference::project(splat::toReference<float>(C.Scene),
                         splat::toReference<float>(C.View), R),
      Width, Height, R);
  const double Bound =
      Times * std::max(errorOf(Single, Exact, Doubts), LeastError);
  const splat::Contributors Found = splat::topContributors(L, O, Top);
  const std::vector<float> Medians = splat::medianDepths(L, O);
  for (std::size_t P = 0; P < Exact.size(); ++P) {
    if (Doubts[P] != 0)
      continue;
    const auto &Pixel = Exact[P];
    const auto Wrong = [&](const char *What, double Is) {
      return fmt::format("pixel {} {}: {} {:.9g}", P % std::size_t(Width),
                         P / std::size_t(Width), What, Is);
    };
    if (static_cast<std::size_t>(Found.Counts[P]) != Pixel.size() &&
        static_cast<std::size_t>(Found.Counts[P]) != Single[P].size())
      return Wrong("contributors", Found.Counts[P]);
    std::vector<double> Weights;
    for (const auto &One : Pixel)
      Weights.push_back(One.Weight);
    std::ranges::sort(Weights, std::greater());
    Weights.resize(Top);
    for (std::size_t K = 0; K < Top; ++K) {
      const double Is = double(Found.Weights[P * Top + K]);
      const int32_t Index = Found.Indices[P * Top + K];
      // The largest weights, whosesoever they are; and this one's own.
      if (!(std::abs(Is - Weights[K]) <= Bound))
        return Wrong("a weight of", Is);
      const bool Own = std::ranges::any_of(Pixel, [&](const auto &One) {
        return static_cast<std::size_t>(One.Index) % C.Scene.size() ==
                   static_cast<std::size_t>(Index) &&
               std::abs(Is - One.Weight) <= Bound;
      });
      if (!Own && Is > Bound)
        return Wrong("another Gaussian's weight,", Is);
    }
    if (!isMedian(double(Medians[P]), Pixel, Splats))
      return Wrong("a median depth of", double(Medians[P]));
  }
  return {};
}

} // namespace vorion::test
