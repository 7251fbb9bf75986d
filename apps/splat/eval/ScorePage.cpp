#include "eval/ScorePage.h"

#include "eval/ScoreText.h"
#include "io/Inside.h"
#include "page/Page.h"
#include "vorion/support/File.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace vorion::splat {
namespace {

Expected<std::string> pngOf(const Photo &P) {
  Image I;
  I.Width = P.Width;
  I.Height = P.Height;
  I.Render.resize(P.Rgb.size());
  std::ranges::transform(P.Rgb, I.Render.begin(), [](uint8_t Level) {
    return static_cast<float>(Level) / 255.0F;
  });
  return encodePng(I);
}

/// Four times the difference of each value, so that small ones are seen.
Photo differenceOf(const Photo &A, const Photo &B) {
  Photo D = A;
  for (std::size_t I = 0; I < D.Rgb.size(); ++I)
    D.Rgb[I] = static_cast<uint8_t>(
        std::min(255, 4 * std::abs(int{A.Rgb[I]} - int{B.Rgb[I]})));
  return D;
}

} // namespace

Expected<std::string> scorePageOf(const ScorePage &P,
                                  const std::vector<JudgedView> &Views,
                                  const std::vector<ViewScore> &Scores) {
  nlohmann::ordered_json Data = scoreJson(Scores);
  Data["scene"] = P.Scene;
  Data["made"] = P.Made;
  Data["training"] = P.Training;
  for (std::size_t I = 0; I < Scores.size(); ++I) {
    const Photo &Drawn = Scores[I].Drawn, &Wanted = Views[I].View->Picture;
    const Photo Difference = differenceOf(Drawn, Wanted);
    for (const auto &[Key, Picture] :
         {std::pair("drawn", &Drawn), std::pair("photograph", &Wanted),
          std::pair("difference", &Difference)}) {
      const auto Png = pngOf(*Picture);
      if (!Png)
        return Png.error();
      Data["views"][I][Key] = pngUri(*Png);
    }
  }
  return filledPage(scoreTemplate(), Data);
}

Expected<Success> writePairFiles(const std::string &Prefix,
                                 const std::vector<JudgedView> &Views,
                                 const std::vector<ViewScore> &Scores) {
  std::set<std::string> Taken;
  for (std::size_t I = 0; I < Scores.size(); ++I) {
    const std::string Name = asFileName(
        std::filesystem::path(Scores[I].Name).replace_extension().string());
    std::string Own = Name;
    for (unsigned Next = 2; !Taken.insert(Own).second; ++Next)
      Own = fmt::format("{}-{}", Name, Next);
    for (const auto &[Kind, Picture] :
         {std::pair("drawn", &Scores[I].Drawn),
          std::pair("photo", &Views[I].View->Picture)}) {
      const auto Png = pngOf(*Picture);
      if (!Png)
        return Png.error();
      if (auto Written = writeFileAtomically(
              fmt::format("{}.{}.{}.png", Prefix, Own, Kind), *Png);
          !Written)
        return Written;
    }
  }
  return Success{};
}

} // namespace vorion::splat
