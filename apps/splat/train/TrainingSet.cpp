#include "train/TrainingSet.h"

#include "vorion/support/File.h"

#include <algorithm>

namespace vorion::splat {

std::pair<int, int> TrainingSet::largest() const {
  std::pair<int, int> Size{0, 0};
  for (const auto *Views : {&Training, &HeldOut})
    for (const TrainView &V : *Views)
      Size = {std::max(Size.first, V.Picture.Width),
              std::max(Size.second, V.Picture.Height)};
  return Size;
}

Expected<TrainingSet> loadTrainingSet(const Capture &C, int Downscale,
                                      const std::array<float, 3> &Background) {
  TrainingSet Set;
  for (const CaptureView &V : C.Views) {
    const auto File = readFile(V.Picture);
    if (!File)
      return File.error();
    const auto Full = decodePhoto(V.Picture, *File);
    if (!Full)
      return Full.error();
    const int Width = shrunkSide(V.Pose.Width, Downscale);
    const int Height = shrunkSide(V.Pose.Height, Downscale);
    (V.HeldOut ? Set.HeldOut : Set.Training)
        .push_back({resized(V.Pose, Width, Height),
                    shrink(*Full, Width, Height, Background)});
  }
  return Set;
}

} // namespace vorion::splat
