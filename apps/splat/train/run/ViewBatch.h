/// What the views of one iteration give, added up over all processes.
#pragma once

#include "train/optimize/Density.h"
#include "train/optimize/Exposure.h"
#include "train/optimize/GradientRenderer.h"
#include "train/optimize/PictureLoss.h"
#include "train/optimize/Pose.h"
#include "train/run/Ranks.h"

namespace vorion::splat {

/// Views are numbered in an iteration and added in that order, one after the
/// other: results are the same bits for any number of processes. Process r has
/// views r, r + size, ... Errors stick in the launcher.
class ViewBatch {
public:
  /// \p Views of an iteration.
  ViewBatch(Launcher &Launch, Ranks &Processes, DensityControl &Control,
            unsigned Views)
      : Launch(Launch), Processes(Processes), Density(Control), Views(Views) {}

  /// Forgets the last iteration. Gradients of \p Of, whose bands up to
  /// \p ShDegree are in use; \p Notes: density control notes the views.
  void begin(const DeviceScene &Of, int ShDegree, bool Notes);
  /// Frees the gradients.
  void forget() { Sum = {}; }
  bool complete() const { return Added == Views; }
  /// The view that this process renders next; \c Views or more: none.
  unsigned next() const { return Added + Processes.rank(); }

  struct ViewResult {
    LossValues Loss;
    GradientRenderer::Backward Back;
    ExposureMatrix ByExposure = {};
    PoseSlope ByPose = {};
  };
  /// Adds a view of each process; \p Mine is null where \c next() is none.
  void add(const ViewResult *Mine);

  /// \name Means over the views, once complete
  /// @{
  const PlanePair &gradients() const { return Sum; }
  LossValues loss() const;
  /// Of each view by its exposure and by its pose.
  const std::vector<ExposureMatrix> &byExposures() const { return Exposed; }
  const std::vector<PoseSlope> &byPoses() const { return Posed; }
  /// @}

private:
  void addOwn(const ViewResult &Mine);
  void addShared(const ViewResult *Mine, unsigned Count);
  void addGradients(const PlanePair &Of);

  Launcher &Launch;
  Ranks &Processes;
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
