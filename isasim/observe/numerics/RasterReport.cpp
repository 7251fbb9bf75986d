#include "observe/numerics/RasterReport.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

using Json = nlohmann::ordered_json;

struct StageName {
  const char *Name, *Decision;
};
constexpr StageName StageNames[] = {
#define VORION_RASTER_STAGE(MEMBER, NAME, DECISION) {NAME, DECISION},
#include "observe/numerics/RasterStages.def"
};

double mean(double Sum, uint64_t Count) {
  return Count ? Sum / static_cast<double>(Count) : 0;
}

using NamedGaussian = std::pair<uint32_t, GaussianCounts>;

/// The \p Top that are off by most; equal ones by number.
std::vector<NamedGaussian> worst(const RasterFindings &F, size_t Top) {
  std::vector<NamedGaussian> All(F.Gaussians.begin(), F.Gaussians.end());
  const auto End =
      All.begin() + static_cast<ptrdiff_t>(std::min(All.size(), Top));
  std::partial_sort(All.begin(), End, All.end(),
                    [](const NamedGaussian &A, const NamedGaussian &B) {
                      return A.second.Colour != B.second.Colour
                                 ? A.second.Colour > B.second.Colour
                                 : A.first < B.first;
                    });
  All.erase(End, All.end());
  return All;
}

} // namespace

std::string rasterText(const RasterFindings &F, unsigned Top) {
  if (F.Commands == 0)
    return "";
  std::string Text = fmt::format(
      "\nrasterizers: {} commands, {} of them finished by pixel units\n"
      "# own: error of the stage alone, against double on the same fp32 "
      "operands; total: error against the shadow of all stages;\n# relative, "
      "absolute for the power\n"
      "{:>12} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n",
      F.Commands, F.Tails, "results", "own mean", "own max", "mean", "max",
      "differ", "subnorm", "nonfin");
  const StageCounts *Worst = nullptr;
  for (size_t N = 0; N != F.Stages.size(); ++N) {
    const StageCounts &S = F.Stages[N];
    Text += fmt::format("{:>12} {:>8.1e} {:>8.1e} {:>8.1e} {:>8.1e} {:>8} "
                        "{:>8} {:>8}  {}\n",
                        S.Results, mean(S.OwnSum, S.Results), S.OwnMax,
                        mean(S.TotalSum, S.Results), S.TotalMax, S.Differ,
                        S.Subnormal, S.NotFinite, StageNames[N].Name);
    if (S.Results && (!Worst || mean(S.OwnSum, S.Results) >
                                    mean(Worst->OwnSum, Worst->Results)))
      Worst = &S;
  }
  if (Worst)
    Text += fmt::format(
        "stage with the largest own error: {}, mean {:.1e}, maximum {:.1e}: "
        "{:.9g} for {:.9g} at pixel ({}, {}), Gaussian {}\n",
        StageNames[Worst - F.Stages.data()].Name,
        mean(Worst->OwnSum, Worst->Results), Worst->OwnMax, Worst->Actual,
        Worst->Reference, Worst->X, Worst->Y, Worst->Gaussian);
  Text += fmt::format("{} pixels with a mean error of {:.1e}\n", F.Pixels,
                      mean(F.OffSum, F.Pixels));
  for (size_t N = 0; N != std::min<size_t>(Top, F.WorstPixels.size()); ++N) {
    const PixelFinding &P = F.WorstPixels[N];
    Text += fmt::format("  pixel ({}, {}) by {:.1e}: {:.6g} {:.6g} {:.6g} T "
                        "{:.6g} for {:.6g} {:.6g} {:.6g} T {:.6g}\n",
                        P.X, P.Y, P.Off, P.Actual.R, P.Actual.G, P.Actual.B,
                        P.Actual.T, P.Reference[0], P.Reference[1],
                        P.Reference[2], P.Reference[3]);
  }
  Text += "Gaussians by their error in the picture\n";
  for (const auto &[Number, C] : worst(F, Top))
    Text += fmt::format("  Gaussian {} by {:.1e} in {} fragments, alpha by a "
                        "part of {:.1e}, {} decisions differ\n",
                        Number, C.Colour, C.Fragments, C.AlphaMax, C.Differ);
  if (F.NotReplayed)
    Text += fmt::format("{} pixels differ in bits from the recomputation: a "
                        "bug of the simulator\n",
                        F.NotReplayed);
  return Text;
}

Json rasterJson(const RasterFindings &F) {
  Json Stages = Json::array(), Gaussians = Json::array(),
       Pixels = Json::array();
  for (size_t N = 0; N != F.Stages.size(); ++N) {
    const StageCounts &S = F.Stages[N];
    Stages.push_back({{"stage", StageNames[N].Name},
                      {"decision", StageNames[N].Decision},
                      {"results", S.Results},
                      {"own_mean", mean(S.OwnSum, S.Results)},
                      {"own_max", S.OwnMax},
                      {"mean", mean(S.TotalSum, S.Results)},
                      {"max", S.TotalMax},
                      {"differ", S.Differ},
                      {"subnorm", S.Subnormal},
                      {"nonfin", S.NotFinite},
                      {"worst",
                       {{"gaussian", S.Gaussian},
                        {"x", S.X},
                        {"y", S.Y},
                        {"is", S.Actual},
                        {"should", S.Reference}}}});
  }
  for (const auto &[Number, C] : worst(F, RasterFindings::WorstKept))
    Gaussians.push_back({{"gaussian", Number},
                         {"fragments", C.Fragments},
                         {"alpha_max", C.AlphaMax},
                         {"colour", C.Colour},
                         {"differ", C.Differ}});
  for (const PixelFinding &P : F.WorstPixels)
    Pixels.push_back({{"x", P.X},
                      {"y", P.Y},
                      {"off", P.Off},
                      {"is", {P.Actual.R, P.Actual.G, P.Actual.B, P.Actual.T}},
                      {"should", P.Reference}});
  return {{"commands", F.Commands},
          {"tails", F.Tails},
          {"pixels", F.Pixels},
          {"off_mean", mean(F.OffSum, F.Pixels)},
          {"not_replayed", F.NotReplayed},
          {"stages", Stages},
          {"worst_gaussians", Gaussians},
          {"worst_pixels", Pixels}};
}

} // namespace vorion::isasim
