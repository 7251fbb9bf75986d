// splat-compare: the difference of two pictures, or of two lists of pairs.

#include "Image.h"
#include "Metrics.h"
#include "Npz.h"
#include "Tool.h"
#include "vorion/support/File.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>

namespace vorion::test {
namespace {

struct Arguments {
  std::string A, B, Mask, Json;
  bool Pairs = false;
  std::optional<double> MinDb, MinDbAll, MaxDoubtful;
};

/// A picture in double precision, of either kind of file.
struct Picture {
  std::size_t Width = 0, Height = 0;
  std::vector<double> Render;
};

Expected<Picture> readPicture(const std::string &Path) {
  // An .npz may hold doubles, which readImage would round.
  if (Path.ends_with(".npz")) {
    const auto Arrays = splat::readNpz(Path);
    if (!Arrays)
      return Arrays.error();
    const auto R = Arrays->find("render");
    if (R == Arrays->end() || R->second.Shape.size() != 3 ||
        R->second.Shape[2] != 3)
      return Error{Path, "no picture, expected `render` of shape (height, "
                         "width, 3)"};
    return Picture{R->second.Shape[1], R->second.Shape[0],
                   R->second.toDoubles()};
  }
  const auto I = splat::readImage(Path);
  if (!I)
    return I.error();
  return Picture{static_cast<std::size_t>(I->Width),
                 static_cast<std::size_t>(I->Height),
                 {I->Render.begin(), I->Render.end()}};
}

/// The union of the arrays of \p Path whose names begin with "mask".
Expected<std::vector<std::uint8_t>> readMask(const std::string &Path,
                                             std::size_t Pixels) {
  const auto Arrays = splat::readNpz(Path);
  if (!Arrays)
    return Arrays.error();
  std::vector<std::uint8_t> Mask(Pixels, 0);
  bool Found = false;
  for (const auto &[Name, A] : *Arrays) {
    if (!Name.starts_with("mask"))
      continue;
    const auto Values = A.toDoubles();
    if (Values.size() != Pixels)
      return Error{Path, fmt::format("{} has {} elements, expected {}", Name,
                                     Values.size(), Pixels)};
    Found = true;
    for (std::size_t I = 0; I < Pixels; ++I)
      Mask[I] |= static_cast<std::uint8_t>(Values[I] != 0);
  }
  if (!Found)
    return Error{Path, "no array whose name begins with mask"};
  return Mask;
}

/// JSON has no infinity; equal pictures get null.
nlohmann::ordered_json finite(double Value) {
  return std::isfinite(Value) ? nlohmann::ordered_json(Value) : nullptr;
}

Expected<Success> require(const std::string &File, const char *What,
                          double Value, const std::optional<double> &Least) {
  if (!Least || Value >= *Least)
    return Success{};
  return Error{
      File,
      fmt::format("{} {:.2f} dB, expected at least {}", What, Value, *Least),
      ExitCode::GuestFailed};
}

Expected<Success> comparePictures(const Arguments &A) {
  const auto First = readPicture(A.A);
  if (!First)
    return First.error();
  const auto Second = readPicture(A.B);
  if (!Second)
    return Second.error();
  if (First->Width != Second->Width || First->Height != Second->Height)
    return Error{A.B, fmt::format("{}x{} pixels, expected {}x{} as in {}",
                                  Second->Width, Second->Height, First->Width,
                                  First->Height, A.A)};
  const std::size_t Pixels = First->Width * First->Height;
  std::vector<std::uint8_t> Mask;
  if (!A.Mask.empty()) {
    auto M = readMask(A.Mask, Pixels);
    if (!M)
      return M.error();
    Mask = std::move(*M);
  }
  const auto All = splat::compare(First->Render, Second->Render, 3);
  const auto Outside = splat::compare(First->Render, Second->Render, 3, Mask);
  const double Share = 1 - double(Outside.Pixels) / double(Pixels);
  fmt::print("metric: PSNR, peak 1, linear unclamped floats\n"
             "all pixels: {:.2f} dB, largest difference {:.3g}\n",
             All.PsnrDb, All.MaxAbs);
  if (!Mask.empty())
    fmt::print("outside doubtful pixels ({:.3f} %): {:.2f} dB, largest "
               "difference {:.3g}\n",
               100 * Share, Outside.PsnrDb, Outside.MaxAbs);
  if (!A.Json.empty()) {
    const nlohmann::ordered_json Report{
        {"a", A.A},
        {"b", A.B},
        {"mask", A.Mask},
        {"metric", "PSNR, peak 1, linear unclamped floats"},
        {"equal", All.MaxAbs == 0},
        {"psnr_db", finite(All.PsnrDb)},
        {"max_abs", finite(All.MaxAbs)},
        {"doubtful_share", Share},
        {"psnr_db_outside_doubtful", finite(Outside.PsnrDb)},
        {"max_abs_outside_doubtful", finite(Outside.MaxAbs)}};
    if (auto W = writeFileAtomically(A.Json, Report.dump(2) + "\n"); !W)
      return W;
  }
  if (auto R = require(A.B, "over all pixels", All.PsnrDb, A.MinDbAll); !R)
    return R;
  if (A.MaxDoubtful && 100 * Share > *A.MaxDoubtful)
    return Error{A.Mask,
                 fmt::format("{:.3f} % of the pixels are doubtful, expected "
                             "at most {} %",
                             100 * Share, *A.MaxDoubtful),
                 ExitCode::GuestFailed};
  return require(A.B, "outside doubtful pixels", Outside.PsnrDb, A.MinDb);
}

Expected<Success> comparePairs(const Arguments &A) {
  const auto First = splat::readNpz(A.A);
  if (!First)
    return First.error();
  const auto Second = splat::readNpz(A.B);
  if (!Second)
    return Second.error();
  for (const char *Name : {"tile", "depth_bits", "index"}) {
    for (const auto &[Path, Arrays] :
         {std::pair(&A.A, &*First), std::pair(&A.B, &*Second)})
      if (!Arrays->contains(Name) || Arrays->at(Name).Type != "i4")
        return Error{*Path, fmt::format("no int32 array {}", Name)};
    const auto X = First->at(Name).toDoubles();
    const auto Y = Second->at(Name).toDoubles();
    const auto At = std::mismatch(X.begin(), X.end(), Y.begin(), Y.end());
    if (X == Y)
      continue;
    return Error{A.B,
                 fmt::format("{} pairs, {} differs from place {} on, expected "
                             "the {} pairs of {}",
                             Y.size(), Name, At.first - X.begin(), X.size(),
                             A.A),
                 ExitCode::GuestFailed};
  }
  fmt::print("equal: {} pairs\n", First->at("tile").elements());
  return Success{};
}

} // namespace
} // namespace vorion::test

int main(int Count, char **Values) {
  using namespace vorion::test;
  CLI::App App("Compares two pictures, or two lists of pairs.",
               "splat-compare");
  Arguments A;
  App.add_option("a", A.A, "What to expect: .npz or .pfm")->required();
  App.add_option("b", A.B, "What there is: .npz or .pfm")->required();
  App.add_option("--mask", A.Mask,
                 "Doubtful pixels: .npz whose arrays mask* are not 0 there");
  App.add_option("--json", A.Json, "Write the figures");
  App.add_flag(
      "--pairs", A.Pairs,
      "Compare tile, depth_bits and index instead; they must be equal");
  App.add_option("--min-db", A.MinDb,
                 "Exit with 1 if it is less outside doubtful pixels");
  App.add_option("--min-db-all", A.MinDbAll,
                 "Exit with 1 if it is less over all pixels");
  App.add_option("--max-doubtful", A.MaxDoubtful,
                 "Exit with 1 if more pixels are doubtful, per cent");
  return runTool(App, Count, Values, [&A] {
    return A.Pairs ? comparePairs(A) : comparePictures(A);
  });
}
