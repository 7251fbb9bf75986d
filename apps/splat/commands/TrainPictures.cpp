#include "commands/TrainPictures.h"
#include "commands/OutputFile.h"

#include "eval/ScorePage.h"
#include "io/ReportHead.h"
#include "page/TrainingsPage.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/File.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace vorion::splat {

std::string camerasFor(const std::string &Output) {
  return std::filesystem::path(Output)
      .replace_extension(".cameras.json")
      .string();
}

void addTrainPictures(CLI::App &App, TrainPictures &P) {
  writesFiles(
      App.add_option("--pictures", P.Pictures,
                     "Write the rendered held-out views and their photographs "
                     "as PREFIX.NAME.drawn.png and PREFIX.NAME.photo.png"));
  addPageOptions(App, P.Page,
                 "Write a page with these pictures and their scores, and with "
                 "the curves of the run");
}

Expected<Success> checkTrainPictures(const TrainPictures &P) {
  if (auto Checked = checkPage(P.Page); !Checked)
    return Checked;
  return P.Pictures.empty() ? Expected<Success>(Success{})
                            : checkPrefix("--pictures", P.Pictures);
}

Expected<Success> writeTrainPictures(const TrainPictures &P,
                                     const std::string &Output,
                                     const TrainOutcome &Out,
                                     const nlohmann::ordered_json &Report) {
  std::vector<Camera> Cameras = Out.Cameras;
  std::ranges::sort(Cameras, {}, &Camera::Name);
  for (std::size_t I = 0; I < Cameras.size(); ++I)
    Cameras[I].Id = static_cast<int>(I);
  if (auto Written = writeCameras(camerasFor(Output), Cameras); !Written)
    return Written;
  if (!P.any())
    return Success{};
  std::vector<JudgedView> Views;
  std::vector<ViewScore> Scores;
  for (const auto &[Drawn, View] : Out.Shown) {
    Views.push_back({&View, true});
    Scores.push_back(scoreOf(Views.back(), Drawn));
  }
  if (!P.Pictures.empty())
    if (auto Written = writePairFiles(P.Pictures, Views, Scores); !Written)
      return Written;
  if (!P.Page.any())
    return Success{};
  const std::string Name = std::filesystem::path(Output).filename().string();
  const auto Page = scorePageOf(
      {Name,
       {madeBy(), fmt::format("scene {} after {}; device {}, {}", Output,
                              counted(Out.Iterations, "iteration"),
                              Out.DeviceName, Out.DeviceVersion)},
       curvesOf(Name, Report)},
      Views, Scores);
  return Page ? writePage(P.Page, *Page) : Expected<Success>(Page.error());
}

} // namespace vorion::splat
