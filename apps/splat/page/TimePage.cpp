#include "page/TimePage.h"

#include "page/Page.h"
#include "vorion/support/Json.h"

#include <fmt/format.h>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// The text at \p Key of the object at \p Place of \p Report; empty for none.
std::string textAt(const Json &Report, const char *Place, const char *Key) {
  const auto Object = Report.find(Place);
  if (Object == Report.end() || !Object->is_object())
    return "";
  const auto Found = Object->find(Key);
  return Found != Object->end() && Found->is_string()
             ? Found->get<std::string>()
             : "";
}

/// The command that wrote \p Report, as far as it says.
std::string commandOf(const Json &Report) {
  std::string Text = textAt(Report, "program", "name") + " " +
                     textAt(Report, "program", "version");
  const Json Program = Report.value("program", Json::object());
  const Json Arguments = Program.value("arguments", Json::array());
  if (!Arguments.empty())
    Text += ": " + textAt(Report, "program", "name");
  for (const Json &Word : Arguments)
    Text += " " + (Word.is_string() ? Word.get<std::string>() : jsonText(Word));
  return Text;
}

/// Lines for the page's foot.
void addMade(Json &To, const TimeRun &R, std::string_view Letter) {
  const std::string Mark = Letter.empty() ? "" : fmt::format("{}: ", Letter);
  To.push_back(Mark + commandOf(R.Report));
  To.push_back(fmt::format("{}scene {}, fnv1a64 {}; cameras {}, fnv1a64 {}",
                           Mark, textAt(R.Report, "scene", "file"),
                           textAt(R.Report, "scene", "fnv1a64"),
                           textAt(R.Report, "cameras", "file"),
                           textAt(R.Report, "cameras", "fnv1a64")));
  const Json Device = R.Report.value("device", Json::object());
  To.push_back(fmt::format(
      "{}device {}, {}; configuration {}", Mark,
      textAt(R.Report, "device", "name"), textAt(R.Report, "device", "version"),
      Device.contains("configuration") ? jsonText(Device["configuration"])
                                       : ""));
}

} // namespace

Expected<std::string> timePageOf(const std::vector<TimeRun> &Runs,
                                 Json Changes) {
  constexpr const char *Shown[] = {"view", "resolution", "rules",  "support",
                                   "path", "scene",      "counts", "time"};
  Json Made = Json::array(), All = Json::array();
  for (const TimeRun &R : Runs) {
    const bool IsOne = Runs.size() == 1;
    addMade(Made, R, IsOne ? "" : All.empty() ? "A" : "B");
    Json Report;
    for (const char *Key : Shown) {
      if (!R.Report.contains(Key))
        return Error{R.Name, fmt::format("no {} in it, expected what `splat "
                                         "render --time --json` writes for "
                                         "one view",
                                         Key)};
      Report[Key] = R.Report[Key];
    }
    for (const char *Key : {"bounds", "what_if", "heat_map", "energy"})
      if (R.Report.contains(Key))
        Report[Key] = R.Report[Key];
    All.push_back({{"name", R.Name},
                   {"report", std::move(Report)},
                   {"picture", R.Picture.empty() ? Json(nullptr)
                                                 : Json(pngUri(R.Picture))}});
  }
  return filledPage(timeTemplate(), {{"made", std::move(Made)},
                                     {"runs", std::move(All)},
                                     {"changes", std::move(Changes)}});
}

} // namespace vorion::splat
