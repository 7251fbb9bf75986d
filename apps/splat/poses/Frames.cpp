#include "poses/Frames.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

namespace vorion::splat {
namespace {

constexpr std::size_t Cell = 15; // pixels of a mean, along each axis
constexpr std::size_t Columns = MeasuredWidth / Cell;

double meanDifference(const FrameFacts &A, const FrameFacts &B) {
  double Sum = 0;
  for (std::size_t I = 0; I < A.Small.size(); ++I)
    Sum += std::abs(A.Small[I] - B.Small[I]);
  return Sum / static_cast<double>(A.Small.size());
}

} // namespace

FrameFacts factsOfFrame(std::span<const std::byte> Grey) {
  assert(Grey.size() == MeasuredPixels);
  const auto At = [Grey](std::size_t X, std::size_t Y) {
    return std::to_integer<int>(Grey[Y * MeasuredWidth + X]);
  };
  FrameFacts F;
  double Sum = 0, Squares = 0;
  for (std::size_t Y = 1; Y + 1 < MeasuredHeight; ++Y)
    for (std::size_t X = 1; X + 1 < MeasuredWidth; ++X) {
      const double Laplacian = At(X - 1, Y) + At(X + 1, Y) + At(X, Y - 1) +
                               At(X, Y + 1) - 4 * At(X, Y);
      Sum += Laplacian;
      Squares += Laplacian * Laplacian;
    }
  constexpr auto Inner =
      static_cast<double>((MeasuredWidth - 2) * (MeasuredHeight - 2));
  F.Sharpness = Squares / Inner - (Sum / Inner) * (Sum / Inner);
  for (std::size_t I = 0; I < F.Small.size(); ++I) {
    int Total = 0;
    for (std::size_t P = 0; P < Cell * Cell; ++P)
      Total += At(I % Columns * Cell + P % Cell, I / Columns * Cell + P / Cell);
    F.Small[I] = static_cast<uint8_t>(Total / static_cast<int>(Cell * Cell));
  }
  return F;
}

ChosenFrames chooseFrames(std::span<const FrameFacts> Frames,
                          std::size_t Wanted) {
  /// Levels of grey: less is noise of a camera that stands still.
  constexpr double LeastChange = 1;
  ChosenFrames Chosen;
  const std::size_t Spans = std::min(Wanted, Frames.size());
  for (std::size_t S = 0; S < Spans; ++S) {
    std::size_t Begin = S * Frames.size() / Spans;
    const std::size_t End = (S + 1) * Frames.size() / Spans;
    if (!Chosen.Frames.empty())
      Begin = std::min(
          std::max(Begin, Chosen.Frames.back() + (End - Begin) / 2), End - 1);
    const auto Span = Frames.subspan(Begin, End - Begin);
    const auto Sharpest =
        std::ranges::max_element(Span, {}, &FrameFacts::Sharpness);
    if (!Chosen.Frames.empty() &&
        meanDifference(*Sharpest, Frames[Chosen.Frames.back()]) < LeastChange)
      ++Chosen.Still;
    else
      Chosen.Frames.push_back(
          Begin + static_cast<std::size_t>(Sharpest - Span.begin()));
  }
  return Chosen;
}

} // namespace vorion::splat
