/// Selection of a video's frames.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vorion::splat {

/// The size at which frames are measured, in pixels.
inline constexpr std::size_t MeasuredWidth = 480, MeasuredHeight = 270;
inline constexpr std::size_t MeasuredPixels = MeasuredWidth * MeasuredHeight;

/// A measured frame.
struct FrameFacts {
  /// The variance of the Laplacian of the grey picture: comparable between
  /// frames of one place.
  double Sharpness = 0;
  /// The frame as 32x18 means of grey, row by row.
  std::array<uint8_t, std::size_t{32} * 18> Small{};
};

/// Measures a frame of MeasuredPixels bytes of grey, row by row.
FrameFacts factsOfFrame(std::span<const std::byte> Grey);

/// The chosen frames, in order, and the number of spans without one.
struct ChosenFrames {
  std::vector<std::size_t> Frames;
  std::size_t Still = 0;
};

/// The sharpest frame of each of \p Wanted equal spans of \p Frames, but none
/// within half a span of the frame before. A span in which the picture does not
/// change is skipped.
ChosenFrames chooseFrames(std::span<const FrameFacts> Frames,
                          std::size_t Wanted);

} // namespace vorion::splat
