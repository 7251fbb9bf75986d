/// Sums the results of the views of an iteration.
#pragma once

#include "train/optimize/Density.h"
#include "train/optimize/Exposure.h"
#include "train/optimize/GradientRenderer.h"
#include "train/optimize/PictureLoss.h"
#include "train/optimize/Pose.h"

namespace vorion::splat {

/// Views are added in their order. The launcher keeps errors.
class ViewBatch {
public:
  /// \p Views is the number of views of an iteration.
  ViewBatch(Launcher &Launch, DensityControl &Control, unsigned Views)
      : Launch(Launch), Density(Control), Views(Views) {}

  /// Starts an iteration with gradients of \p Of, whose bands up to \p ShDegree
  /// are in use. \p Notes: density control collects statistics.
  void begin(const DeviceScene &Of, int ShDegree, bool Notes);
  /// Frees the gradients.
  void forget() { Sum = {}; }
  bool complete() const { return Added == Views; }
  /// The next view.
  unsigned next() const { return Added; }

  struct ViewResult {
    LossValues Loss;
    GradientRenderer::Backward Back;
    ExposureMatrix ByExposure = {};
    PoseSlope ByPose = {};
  };
  void add(const ViewResult &View);

  /// \name Means over the views, once complete
  /// @{
  const PlanePair &gradients() const { return Sum; }
  LossValues loss() const;
  /// Gradients of each view by its exposure and by its pose.
  const std::vector<ExposureMatrix> &byExposures() const { return Exposed; }
  const std::vector<PoseSlope> &byPoses() const { return Posed; }
  /// @}

private:
  void addGradients(const PlanePair &Of);

  Launcher &Launch;
  DensityControl &Density;
  unsigned Views;

  uint32_t Gaussians = 0;
  std::size_t GeometrySize = 0, ShSize = 0; ///< floats
  bool Notes = false;
  unsigned Added = 0;
  LossValues Losses;
  std::vector<ExposureMatrix> Exposed;
  std::vector<PoseSlope> Posed;
  PlanePair Sum;
};

} // namespace vorion::splat
