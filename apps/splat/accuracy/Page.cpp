#include "Page.h"

#include "vorion/support/Json.h"

#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

/// No tag inside a script may end it.
static std::string forScript(std::string Text) {
  for (std::size_t At = 0; (At = Text.find("</", At)) != std::string::npos;)
    Text.replace(At, 2, "<\\/");
  return Text;
}

static std::string filled(std::string_view Template, const Json &Data) {
  constexpr std::string_view Place = "@DATA@";
  std::string Page(Template);
  return Page.replace(Page.find(Place), Place.size(),
                      forScript(jsonText(Data)));
}

Expected<std::string> pageOf(const SweepPlan &P, KeptPoints &Kept,
                             const PageHead &Head,
                             const std::vector<Setting> &Settings) {
  Json Views = Json::array(), Points = Json::array();
  for (const Camera &View : P.Views)
    Views.push_back(View.Name);
  for (const Point &Of : pointsOf(P, Settings)) {
    auto Measured = readPoint(P, Kept, Of);
    if (!Measured)
      return Measured.error();
    for (const char *Key : {"made_by", "made_from"})
      Measured->erase(Key);
    Points.push_back(std::move(*Measured));
  }
  const Json Data{{"made", Head.Made},
                  {"floor_db", Head.FloorDb},
                  {"views", std::move(Views)},
                  {"chosen_on", Head.ChosenOn},
                  {"points", std::move(Points)}};
  return filled(pageTemplate(), Data);
}

std::string trainPageOf(const Json &Results, const std::string &Made) {
  Json Curves = Json::array();
  for (const Json &Point : Results["points"])
    if (Point.contains("curve"))
      Curves.push_back({{"setting", Point["setting"]},
                        {"seed", Point["seed"]},
                        {"curve", Point["curve"]}});
  return filled(trainPageTemplate(), {{"made", Made},
                                      {"iterations", Results["iterations"]},
                                      {"reached_db", Results["reached_db"]},
                                      {"settings", Results["settings"]},
                                      {"curves", std::move(Curves)}});
}

} // namespace vorion::splat
