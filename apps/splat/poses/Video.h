/// Videos, read and written by the program ffmpeg.
#pragma once

#include "poses/Frames.h"
#include "vorion/support/Expected.h"

#include <functional>
#include <string>
#include <vector>

namespace vorion::splat {

/// Measures all frames of \p Video. Calls \p Measured after each frame with the
/// number of frames so far.
Expected<std::vector<FrameFacts>>
measureVideo(const std::string &Video,
             const std::function<void(std::size_t)> &Measured);

/// The file names of the frames \p Chosen: their numbers from 0, in order.
std::string frameName(std::size_t Frame);

/// Writes the frames \p Chosen of \p Video, ascending, to \p Folder as JPEGs.
Expected<Success> extractFrames(const std::string &Video,
                                const std::vector<std::size_t> &Chosen,
                                const std::string &Folder);

/// The extensions of videos that can be written.
inline constexpr const char *VideoEndings[] = {".mp4", ".webm"};
bool isVideoName(const std::string &File);

/// Checks that ffmpeg is installed.
Expected<Success> checkVideoWriter();

/// Writes the pictures PREFIX000000.png, PREFIX000001.png and so on to the
/// video
/// \p File, \p Rate per second: H.264 in .mp4, VP9 in .webm, in sRGB's colours.
/// Odd sides get another row or column of pixels, for the codecs.
Expected<Success> writeVideo(const std::string &File, const std::string &Prefix,
                             double Rate);

} // namespace vorion::splat
