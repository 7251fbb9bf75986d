/// Evaluation of a scene on photographs.
#pragma once

#include "render/Renderer.h"
#include "train/data/TrainingSet.h"

#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// A photograph at the resolution of the evaluation, and its camera.
struct JudgedView {
  const TrainView *View = nullptr;
  bool HeldOut = false;
};

/// The views of \p Set: held-out ones, and with \p All also those that training
/// uses; in order of names. \p Set must outlive them.
std::vector<JudgedView> judgedViews(const TrainingSet &Set, bool All);

/// Scores of a picture against its photograph. Both are 8-bit values, so that
/// scores are those of the picture file, and equal those of `splat train`.
struct ViewScore {
  std::string Name;
  bool HeldOut = false;
  Photo Drawn;
  double PsnrDb = 0;            ///< infinity for equal pictures
  double Ssim = 0;              ///< io/Metrics.h
  std::optional<double> MsSsim; ///< nothing for small pictures
};

ViewScore scoreOf(const JudgedView &V, Photo Drawn);

/// Means over views; empty for a metric that a view lacks.
struct MeanScore {
  std::size_t Views = 0;
  double PsnrDb = 0, Ssim = 0;
  std::optional<double> MsSsim;
};

/// The mean over all views, or over those whose \c HeldOut is \p HeldOut; empty
/// without views.
std::optional<MeanScore> meanOf(const std::vector<ViewScore> &Scores,
                                std::optional<bool> HeldOut = {});

/// Renders \p S from each of \p Views with \p Plan, which must fit all of them.
/// Error (GuestFailed): a picture has non-finite values.
Expected<std::vector<ViewScore>>
evaluate(Launcher &Launch, const RenderPlan &Plan, const Scene &S,
         const RenderOptions &Options, const std::vector<JudgedView> &Views);

} // namespace vorion::splat
