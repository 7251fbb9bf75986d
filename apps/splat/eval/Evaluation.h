/// How well a scene shows what photographs show.
#pragma once

#include "render/Renderer.h"
#include "train/data/TrainingSet.h"

#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// A photograph at the size at which it is judged, and its camera.
struct JudgedView {
  const TrainView *View = nullptr;
  bool HeldOut = false;
};

/// The views of \p Set: held-out ones, and with \p All also those that training
/// uses; by name. \p Set must outlive them.
std::vector<JudgedView> judgedViews(const TrainingSet &Set, bool All);

/// A picture against its photograph. Both are 8-bit values, so that a figure is
/// that of the picture as a file, and the one that `splat train` prints.
struct ViewScore {
  std::string Name;
  bool HeldOut = false;
  Photo Drawn;
  double PsnrDb = 0;            ///< infinity for equal pictures
  double Ssim = 0;              ///< io/Metrics.h
  std::optional<double> MsSsim; ///< nothing for small pictures
};

ViewScore scoreOf(const JudgedView &V, Photo Drawn);

/// Means over views: of a measure that some view lacks there is none.
struct MeanScore {
  std::size_t Views = 0;
  double PsnrDb = 0, Ssim = 0;
  std::optional<double> MsSsim;
};

/// Over all, or over those whose \c HeldOut is \p HeldOut. Nothing of no view.
std::optional<MeanScore> meanOf(const std::vector<ViewScore> &Scores,
                                std::optional<bool> HeldOut = {});

/// Draws \p S from each of \p Views by \p Plan, which must fit all of them.
/// Pictures with values that are no numbers are an Error (GuestFailed).
Expected<std::vector<ViewScore>>
evaluate(Launcher &Launch, const RenderPlan &Plan, const Scene &S,
         const RenderOptions &Options, const std::vector<JudgedView> &Views);

} // namespace vorion::splat
