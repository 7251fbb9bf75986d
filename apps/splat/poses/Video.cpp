#include "poses/Video.h"

#include "study/Process.h"
#include "vorion/support/Letters.h"
#include "vorion/support/TemporaryFolder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <thread>
#include <unistd.h>

namespace vorion::splat {
namespace {

namespace fs = std::filesystem;

Expected<std::string> findFfmpeg() {
  return findProgram("ffmpeg", "reads and writes videos");
}

/// Runs ffmpeg with \p Arguments; what it says is in the error about \p File.
Expected<Success> runFfmpeg(std::vector<std::string> Arguments,
                            const std::string &File,
                            const std::string &OutFile = "/dev/null") {
  const auto Program = findFfmpeg();
  if (!Program)
    return Program.error();
  const auto Folder = TemporaryFolder::make("splat-video");
  if (!Folder)
    return Folder.error();
  const std::string Log = Folder->path() + "/ffmpeg.log";
  Arguments.insert(Arguments.begin(), {*Program, "-v", "error", "-nostdin"});
  const auto Ended = runProgram(std::move(Arguments), {}, OutFile, Log);
  if (!Ended)
    return Error{File, Ended.error().What};
  if (Ended->Code != ExitCode::Ok)
    return Error{File, fmt::format("ffmpeg failed: {}", lastLine(Log))};
  return Success{};
}

/// Reads \p Pipe to its end, a frame of grey at a time.
std::vector<FrameFacts>
readFrames(int Pipe, const std::function<void(std::size_t)> &Measured) {
  std::vector<FrameFacts> Frames;
  std::vector<std::byte> Grey(MeasuredPixels);
  std::size_t Filled = 0;
  for (;;) {
    const ssize_t Got = read(Pipe, &Grey[Filled], Grey.size() - Filled);
    if (Got < 0 && errno == EINTR)
      continue;
    if (Got <= 0)
      return Frames;
    Filled += static_cast<std::size_t>(Got);
    if (Filled < Grey.size())
      continue;
    Filled = 0;
    Frames.push_back(factsOfFrame(Grey));
    Measured(Frames.size());
  }
}

/// A filter's condition that is true for the frames \p Chosen. It is a balanced
/// tree, because ffmpeg limits the depth of expressions to 100.
std::string anyOf(std::span<const std::size_t> Chosen) {
  if (Chosen.size() == 1)
    return fmt::format("eq(n\\,{})", Chosen.front());
  const std::size_t Half = Chosen.size() / 2;
  return fmt::format("({}+{})", anyOf(Chosen.first(Half)),
                     anyOf(Chosen.subspan(Half)));
}

} // namespace

Expected<std::vector<FrameFacts>>
measureVideo(const std::string &Video,
             const std::function<void(std::size_t)> &Measured) {
  int Ends[2];
  if (pipe2(Ends, O_CLOEXEC) != 0)
    return Error{Video,
                 fmt::format("cannot make a pipe: {}, expected fewer "
                             "open files",
                             std::strerror(errno)),
                 ExitCode::LimitReached};
  std::optional<Expected<Success>> Ended;
  std::thread Runner([&] {
    Ended =
        runFfmpeg({"-i", Video, "-an", "-sn", "-fps_mode", "passthrough", "-vf",
                   fmt::format("scale={}:{}:flags=area,format=gray",
                               MeasuredWidth, MeasuredHeight),
                   "-f", "rawvideo", "pipe:1"},
                  Video, fmt::format("/proc/self/fd/{}", Ends[1]));
    close(Ends[1]);
  });
  auto Frames = readFrames(Ends[0], Measured);
  Runner.join();
  close(Ends[0]);
  if (!*Ended)
    return Ended->error();
  if (Frames.empty())
    return Error{Video, "has no frames, expected a video"};
  return Frames;
}

std::string frameName(std::size_t Frame) {
  return fmt::format("frame-{:06}.jpg", Frame);
}

Expected<Success> extractFrames(const std::string &Video,
                                const std::vector<std::size_t> &Chosen,
                                const std::string &Folder) {
  // Beside the frames, so that they are renamed into their place.
  const fs::path Part = fs::path(Folder) / ".frames";
  std::error_code Failed;
  fs::remove_all(Part, Failed);
  fs::create_directories(Part, Failed);
  if (auto Ran = runFfmpeg({"-i", Video, "-an", "-sn", "-fps_mode",
                            "passthrough", "-vf", "select=" + anyOf(Chosen),
                            "-q:v", "2", "-y", (Part / "%06d.jpg").string()},
                           Video);
      !Ran)
    return Ran;
  for (std::size_t I = 0; I < Chosen.size() && !Failed; ++I)
    fs::rename(Part / fmt::format("{:06}.jpg", I + 1),
               fs::path(Folder) / frameName(Chosen[I]), Failed);
  if (Failed)
    return Error{Folder, fmt::format("cannot write the frames of {}: {}, "
                                     "expected a writable folder",
                                     Video, Failed.message())};
  fs::remove_all(Part, Failed);
  return Success{};
}

bool isVideoName(const std::string &File) {
  return std::ranges::any_of(VideoEndings, [&](const char *Ending) {
    return lowerCase(File).ends_with(Ending);
  });
}

Expected<Success> checkVideoWriter() {
  const auto Found = findFfmpeg();
  return Found ? Expected<Success>(Success{}) : Found.error();
}

Expected<Success> writeVideo(const std::string &File, const std::string &Prefix,
                             double Rate) {
  // An even size, and video's range and matrix.
  constexpr const char *Filter =
      "pad=ceil(iw/2)*2:ceil(ih/2)*2,"
      "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";
  const bool IsMp4 = lowerCase(File).ends_with(".mp4");
  std::vector<std::string> Words{"-framerate",
                                 fmt::format("{:g}", Rate),
                                 "-i",
                                 Prefix + "%06d.png",
                                 "-vf",
                                 Filter,
                                 "-colorspace",
                                 "bt709",
                                 "-color_primaries",
                                 "bt709",
                                 "-color_trc",
                                 "iec61966-2-1",
                                 "-color_range",
                                 "tv",
                                 "-crf",
                                 IsMp4 ? "18" : "24",
                                 "-c:v",
                                 IsMp4 ? "libx264" : "libvpx-vp9"};
  if (IsMp4)
    Words.insert(Words.end(), {"-movflags", "+faststart"});
  else
    Words.insert(Words.end(), {"-b:v", "0", "-row-mt", "1"});
  Words.insert(Words.end(), {"-y", File});
  return runFfmpeg(std::move(Words), File);
}

} // namespace vorion::splat
