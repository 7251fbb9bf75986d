/// What both encodings of a COLMAP model share: from records to views.
#pragma once

#include "capture/Colmap.h"

#include <map>
#include <span>
#include <string>

namespace vorion::splat {

/// A camera model that COLMAP knows, by the records of lens/.
struct ColmapCameraModel : ColmapLens {
  const LensModel *Lens; ///< null where we have no such lens
};
std::span<const ColmapCameraModel> colmapCameraModels();
/// Names of those that have a lens, for messages.
std::string knownColmapModels();

/// One image as stored: world to camera, quaternion w, x, y, z.
struct ColmapImage {
  int64_t Id = 0;
  std::array<double, 4> Quaternion{};
  std::array<double, 3> Translation{};
  int64_t Camera = 0;
  std::string Name;
};

/// Collects records and checks them; \p Where in each call is the file, with
/// the line where it has lines.
class ColmapBuilder {
public:
  /// That we have the lens of \p Model: asked before its parameters are read.
  static Expected<Success> checkModel(const std::string &Where, int64_t Id,
                                      const ColmapCameraModel &Model);
  Expected<Success> addCamera(const std::string &Where, int64_t Id,
                              const ColmapCameraModel &Model, double Width,
                              double Height,
                              std::span<const double> Parameters);
  Expected<Success> addImage(const std::string &Where, const ColmapImage &I);
  /// \p Track: ids of the images that see it; unknown ones are passed over.
  Expected<Success> addPoint(const std::string &Where,
                             const std::array<double, 3> &Position,
                             const std::array<uint8_t, 3> &Colour,
                             std::span<const int64_t> Track);
  /// The model, which must have an image and a point.
  Expected<ColmapModel> finish(const ColmapFiles &Files);

private:
  std::map<int64_t, CaptureView> Cameras; ///< without pose and name
  std::map<int64_t, std::size_t> ImageOf; ///< by id: place in the model
  ColmapModel Model;
};

} // namespace vorion::splat
