// splat-chart: a page with the chart that standard input describes in JSON, on
// standard output. Scripts that measure give it to splat-figures
// (bench/paper/writing.py); it is not installed.

#include "page/VerdictPage.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"
#include "vorion/support/Tool.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

namespace {

using namespace vorion;
using Json = nlohmann::ordered_json;

/// "series" is an object of lists of numbers, a series' name each.
Expected<splat::VerdictPage> readChart() {
  const std::string In = "/dev/stdin";
  const auto J = readJson<Json>(In, "a chart");
  if (!J)
    return J.error();
  const JsonShape Texts = JsonShape::list(JsonShape::text());
  if (auto Fits =
          JsonShape::object({{"title", JsonShape::text()},
                             {"x_label", JsonShape::text()},
                             {"y_label", JsonShape::text()},
                             {"places", JsonShape::list(JsonShape::text(), 1)},
                             {"series", JsonShape::object({})},
                             {"bars", JsonShape::boolean()},
                             {"made", Texts}})
              .closed()
              .check(*J, In);
      !Fits)
    return Fits.error();
  splat::Chart C{
      (*J)["title"], (*J)["x_label"], (*J)["y_label"], (*J)["places"], {},
      (*J)["bars"]};
  const std::size_t Places = C.Places.size();
  for (const auto &[Name, Values] : (*J)["series"].items()) {
    if (auto Fits = JsonShape::list(JsonShape::number(), Places, Places)
                        .check(Values, In);
        !Fits)
      return Fits.error();
    C.Series.push_back({Name, Values});
  }
  splat::VerdictPage Page;
  Page.Heading = C.Title;
  Page.Charts = {C};
  Page.Made = (*J)["made"];
  return Page;
}

} // namespace

int main() {
  return runTool("splat-chart", [] {
    const auto Page = readChart();
    if (!Page)
      return reportError("splat-chart", Page.error());
    printText(splat::verdictPageOf(*Page));
    return EXIT_SUCCESS;
  });
}
