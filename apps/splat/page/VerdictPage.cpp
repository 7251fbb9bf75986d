#include "page/VerdictPage.h"

#include "page/Page.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

std::string toString(const AnswerTable &T) {
  std::vector<std::size_t> Widths;
  for (std::size_t C = 0; C < T.Columns.size(); ++C) {
    Widths.push_back(T.Columns[C].size());
    for (const auto &Row : T.Rows)
      Widths[C] = std::max(Widths[C], Row[C].size());
  }
  const auto Line = [&](const std::vector<std::string> &Cells) {
    std::string Text = fmt::format("{:<{}}", Cells[0], Widths[0]);
    for (std::size_t C = 1; C + 1 < Cells.size(); ++C)
      Text += fmt::format("  {:>{}}", Cells[C], Widths[C]);
    Text += "  " + Cells.back();
    return Text.substr(0, Text.find_last_not_of(' ') + 1) + "\n";
  };
  std::string Text = Line(T.Columns);
  for (const auto &Row : T.Rows)
    Text += Line(Row);
  return Text;
}

/// What verdict.js draws.
static Json chartJson(const Chart &C) {
  Json Series = Json::array();
  for (const ChartSeries &S : C.Series)
    Series.push_back({{"name", S.Name}, {"values", S.Values}});
  return {{"title", C.Title},   {"x_label", C.XLabel}, {"y_label", C.YLabel},
          {"places", C.Places}, {"bars", C.Bars},      {"series", Series}};
}

std::string verdictPageOf(const VerdictPage &P) {
  Json Charts = Json::array(), Pictures = Json::array(), Tables = Json::array();
  for (const Chart &C : P.Charts)
    Charts.push_back(chartJson(C));
  for (const PagePictures &Group : P.Pictures) {
    Json Images = Json::array();
    for (const PagePicture &One : Group.Pictures)
      Images.push_back({{"image", pngUri(One.Png)}, {"caption", One.Caption}});
    Pictures.push_back({{"title", Group.Title},
                        {"note", Group.Note},
                        {"images", std::move(Images)}});
  }
  for (const AnswerTable &T : P.Tables)
    Tables.push_back({{"title", T.Title},
                      {"note", T.Note},
                      {"columns", T.Columns},
                      {"rows", T.Rows}});
  return filledPage(verdictTemplate(), Json{{"heading", P.Heading},
                                            {"verdict", P.Verdict},
                                            {"charts", std::move(Charts)},
                                            {"pictures", std::move(Pictures)},
                                            {"tables", std::move(Tables)},
                                            {"made", P.Made}});
}

} // namespace vorion::splat
