#include "train/run/TrainReport.h"
#include "io/ReportHead.h"
#include "train/settings/SettingsTable.h"

#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

Expected<Json> trainReport(const TrainRequest &R, const TrainOutcome &Out,
                           const std::optional<EnergyRequest> &Energy) {
  auto Timed = Out.Timed.json(Energy);
  if (!Timed)
    return Timed;
  Json Views = Json::array(), Scores = Json::array(), Counts = Json::array();
  for (const auto &[Name, Db] : Out.HeldOut)
    Views.push_back({{"name", Name}, {"psnr8_db", Db}});
  for (const auto &[Iteration, Db] : Out.Scores)
    Scores.push_back({{"iteration", Iteration}, {"psnr8_db", Db}});
  for (const auto &[Iteration, Gaussians] : Out.Counts)
    Counts.push_back({{"iteration", Iteration}, {"gaussians", Gaussians}});
  const auto &B = Out.Without;
  const auto &P = Out.Poses;
  Json Report = reportHead("splat-train");
  Report.update(
      {{"device", {{"name", Out.DeviceName}, {"version", Out.DeviceVersion}}},
       {"capture", R.Capture},
       {"resolution", {Out.Width, Out.Height}},
       {"run", Out.Record},
       {"settings", settingsJson(R.Run.Settings)},
       {"picture_filter", PhotoFilter},
       {"held_out_by", Out.HeldOutBy},
       {"without_picture", Out.WithoutPicture},
       {"distorted", Out.Distorted},
       {"masked", Out.Masked},
       {"depths", Out.Depths},
       {"poses", P ? Json{{"mean_turn", P->MeanTurn},
                          {"largest_turn", P->MostTurn},
                          {"mean_shift", P->MeanShift},
                          {"largest_shift", P->MostShift}}
                   : Json()},
       {"rules", name(R.Convention)},
       {"support", name(Support::Exact)},
       {"iterations", Out.Iterations},
       {"gaussians", Out.Result.size()},
       {"moments", name(Out.Moments)},
       {"seconds", Out.Seconds},
       {"resumed_after",
        Out.ResumedAfter != 0 ? Json(Out.ResumedAfter) : Json()},
       {"iterations_timed", Out.Iterations - Out.First},
       {"timed", std::move(*Timed)},
       {"psnr8_db", Out.HeldOut.empty() ? Json() : Json(Out.meanDb())},
       {"scores", Scores},
       {"views", Views},
       {"baselines_db", B ? Json{{"constant", B->Constant},
                                 {"mean_picture", B->Mean},
                                 {"best_training_view", B->BestView}}
                          : Json()},
       {"gaussian_counts", Counts},
       {"losses", Out.Losses}});
  return Report;
}

} // namespace vorion::splat
