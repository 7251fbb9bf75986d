/// Conversion of COLMAP records to views, for both encodings.
#pragma once

#include "capture/Colmap.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace vorion::splat {

/// A camera model of COLMAP, from the records of lens/.
struct ColmapCameraModel : ColmapLens {
  const LensModel *Lens; ///< null if unsupported
};
/// In the order of their numbers.
std::span<const ColmapCameraModel> colmapCameraModels();
/// The same if \p Lenses were the only records.
std::vector<ColmapCameraModel>
colmapCameraModelsOf(std::span<const LensModel *const> Lenses);
/// Names of the supported models, for messages.
std::string knownColmapModels();

/// A stored image: world to camera, quaternion w, x, y, z.
struct ColmapImage {
  int64_t Id = 0;
  std::array<double, 4> Quaternion{};
  std::array<double, 3> Translation{};
  int64_t Camera = 0;
  std::string Name;
};

/// Collects and checks records. \p Where is the file, with the line number for
/// text files.
class ColmapBuilder {
public:
  /// Checks that \p Model is supported, before its parameters are read.
  static Expected<Success> checkModel(const std::string &Where, int64_t Id,
                                      const ColmapCameraModel &Model);
  Expected<Success> addCamera(const std::string &Where, int64_t Id,
                              const ColmapCameraModel &Model, double Width,
                              double Height,
                              std::span<const double> Parameters);
  Expected<Success> addImage(const std::string &Where, const ColmapImage &I);
  /// \p Track: IDs of the images in which it is visible; unknown IDs are
  /// ignored.
  Expected<Success> addPoint(const std::string &Where,
                             const std::array<double, 3> &Position,
                             const std::array<uint8_t, 3> &Colour,
                             std::span<const int64_t> Track);
  /// The model, which must have an image.
  Expected<ColmapModel> finish(const ColmapFiles &Files);

private:
  std::map<int64_t, CaptureView> Cameras; ///< without pose and name
  std::map<int64_t, std::size_t> ImageOf; ///< index in the model by ID
  ColmapModel Model;
};

} // namespace vorion::splat
