#include "page/TrainingsPage.h"

#include "page/Page.h"

#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

Json curvesOf(const std::string &Name, const Json &Report) {
  const auto Pairs = [&Report](const char *List, const auto &Value) {
    Json All = Json::array();
    for (const Json &Each : Report.at(List))
      All.push_back({Each.at("iteration"), Value(Each)});
    return All;
  };
  return {
      {"name", Name},
      {"losses", Report.at("losses")},
      {"gaussian_counts",
       Pairs("gaussian_counts",
             [](const Json &Each) { return Each.at("gaussians"); })},
      {"scores",
       Pairs("scores", [](const Json &Each) { return Each.at("psnr8_db"); })},
      {"machine_ms", Pairs("timed", [](const Json &Each) {
         return Each.at("time").at("frame_ms");
       })}};
}

std::string trainingsPageOf(const std::vector<std::string> &Names,
                            const std::vector<Json> &Reports,
                            const std::vector<TrainingChange> &Changes,
                            const std::vector<std::string> &Made) {
  Json Runs = Json::array(), Rows = Json::array();
  for (std::size_t I = 0; I != Names.size(); ++I)
    Runs.push_back(curvesOf(Names[I], Reports[I]));
  for (const TrainingChange &C : Changes)
    Rows.push_back({C.Name, C.A, C.B});
  return filledPage(trainingsTemplate(), Json{{"runs", std::move(Runs)},
                                              {"rows", std::move(Rows)},
                                              {"made", Made}});
}

} // namespace vorion::splat
