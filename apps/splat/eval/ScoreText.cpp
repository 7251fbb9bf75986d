#include "eval/ScoreText.h"

#include "vorion/support/Printable.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t MostOfAName = 60;

Json finite(double Value) {
  return std::isfinite(Value) ? Json(Value) : Json();
}

Json orNull(const std::optional<double> &Value) {
  return Value ? Json(*Value) : Json();
}

Json meanJson(const std::optional<MeanScore> &M) {
  if (!M)
    return {};
  return {{"views", M->Views},
          {"psnr8_db", finite(M->PsnrDb)},
          {"ssim", M->Ssim},
          {"ms_ssim", orNull(M->MsSsim)}};
}

std::string csvText(const std::string &Text) {
  if (Text.find_first_of(",\"\r\n") == std::string::npos)
    return Text;
  std::string Quoted = "\"";
  for (const char C : Text)
    Quoted += C == '"' ? "\"\"" : std::string(1, C);
  return Quoted + '"';
}

} // namespace

std::string scoreTable(const std::vector<ViewScore> &Scores) {
  struct Line {
    std::string Name;
    double PsnrDb, Ssim;
    std::optional<double> MsSsim;
  };
  std::vector<Line> Lines;
  Lines.reserve(Scores.size() + 2);
  for (const ViewScore &S : Scores)
    Lines.push_back(
        {printable(S.Name, MostOfAName), S.PsnrDb, S.Ssim, S.MsSsim});
  const auto AddMean = [&](const char *Of, std::optional<bool> HeldOut) {
    if (const auto M = meanOf(Scores, HeldOut))
      Lines.push_back({fmt::format("mean of {} {}", M->Views, Of), M->PsnrDb,
                       M->Ssim, M->MsSsim});
  };
  AddMean("held out", true);
  AddMean("in training", false);
  std::size_t Width = 0;
  for (const Line &L : Lines)
    Width = std::max(Width, L.Name.size());
  std::string Text = fmt::format("{:<{}}  {:>8}  {:>8}  {:>8}\n", "view", Width,
                                 "PSNR, dB", "SSIM", "MS-SSIM");
  for (const Line &L : Lines)
    Text += fmt::format("{:<{}}  {:>8.3f}  {:>8.5f}  {:>8}\n", L.Name, Width,
                        L.PsnrDb, L.Ssim,
                        L.MsSsim ? fmt::format("{:.5f}", *L.MsSsim) : "-");
  return Text;
}

std::string scoreCsv(const std::vector<ViewScore> &Scores) {
  std::string Text = "view,held_out,width,height,psnr8_db,ssim,ms_ssim\r\n";
  for (const ViewScore &S : Scores)
    Text +=
        fmt::format("{},{},{},{},{},{},{}\r\n", csvText(S.Name),
                    S.HeldOut ? 1 : 0, S.Drawn.Width, S.Drawn.Height, S.PsnrDb,
                    S.Ssim, S.MsSsim ? fmt::format("{}", *S.MsSsim) : "");
  return Text;
}

Json scoreJson(const std::vector<ViewScore> &Scores) {
  Json Views = Json::array();
  for (const ViewScore &S : Scores)
    Views.push_back({{"name", S.Name},
                     {"held_out", S.HeldOut},
                     {"resolution", {S.Drawn.Width, S.Drawn.Height}},
                     {"psnr8_db", finite(S.PsnrDb)},
                     {"ssim", S.Ssim},
                     {"ms_ssim", orNull(S.MsSsim)}});
  return {{"mean_held_out", meanJson(meanOf(Scores, true))},
          {"mean_in_training", meanJson(meanOf(Scores, false))},
          {"lpips", nullptr},
          {"lpips_note", NoLpips},
          {"views", std::move(Views)}};
}

} // namespace vorion::splat
