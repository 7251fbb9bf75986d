#include "commands/Compare.h"
#include "commands/OutputFile.h"

#include "io/Image.h"
#include "io/Metrics.h"
#include "io/Npz.h"
#include "io/ReportHead.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Outputs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace vorion::splat {

namespace {

constexpr const char *Metric = "PSNR, peak 1, linear unclamped floats";
constexpr const char *EightBitMetric =
    "PSNR, peak 1, 8-bit values: floats are clamped and rounded to 8 bits";

/// \p I as a picture of 8 bits has it. What is no finite number stays, to be
/// counted.
void roundToBytes(ExactImage &I) {
  if (I.IsEightBit)
    return;
  for (std::vector<double> *Values : {&I.Render, &I.Alpha})
    for (double &V : *Values)
      if (std::isfinite(V))
        V = toByte(static_cast<float>(V)) / 255.0;
}

/// The union of the arrays of \p File whose names begin with "mask".
Expected<std::vector<uint8_t>> readMask(const std::string &File,
                                        const ExactImage &Picture) {
  auto Arrays = NpzFile::open(File);
  if (!Arrays)
    return Arrays.error();
  std::vector<uint8_t> Mask(Picture.pixels(), 0);
  bool Found = false;
  for (const auto &[Name, Shape] : Arrays->shapes()) {
    if (!Name.starts_with("mask"))
      continue;
    if (Shape.numbers() != Mask.size())
      return Error{File,
                   fmt::format("{} has {} elements, expected {}x{}", Name,
                               Shape.numbers(), Picture.Height, Picture.Width)};
    const auto Array = Arrays->read(Name);
    if (!Array)
      return Array.error();
    const std::vector<double> Values = Array->toDoubles();
    Found = true;
    for (std::size_t I = 0; I < Mask.size(); ++I)
      Mask[I] |= static_cast<uint8_t>(Values[I] != 0);
  }
  if (!Found)
    return Error{File,
                 "no array whose name begins with mask, expected at least one"};
  return Mask;
}

/// What a reader must know of figures that are infinite.
std::string notFinite(const Difference &D) {
  return D.NotFinite == 0
             ? ""
             : fmt::format(", {} of them with non-finite values", D.NotFinite);
}

void print(const char *What, const Difference &D) {
  printOut("{}: {:.2f} dB, largest difference {:.3g}, {}{}\n", What, D.PsnrDb,
           D.MaxAbs, counted(D.Pixels, "pixel"), notFinite(D));
}

/// JSON has no infinity. So the PSNR of equal pictures, whose largest
/// difference is 0, is null, and both are null where values are no finite
/// numbers.
nlohmann::ordered_json finite(double Value) {
  return std::isfinite(Value) ? nlohmann::ordered_json(Value) : nullptr;
}

/// Of the colours outside \p Mask: what does not count is black in both. Empty
/// where values are no finite numbers.
std::optional<double> ssimOutside(ExactImage A, ExactImage B,
                                  const std::vector<uint8_t> &Mask,
                                  const Difference &D) {
  if (D.NotFinite != 0)
    return {};
  for (std::size_t I = 0; I < Mask.size(); ++I)
    if (Mask[I] != 0)
      for (ExactImage *Picture : {&A, &B})
        std::fill_n(Picture->Render.begin() + 3 * static_cast<long>(I), 3, 0);
  return ssim(A.Render, B.Render, static_cast<std::size_t>(A.Width), 3);
}

Expected<Success> require(const std::string &File, const char *What,
                          const Difference &D,
                          const std::optional<double> &Least) {
  if (!Least || D.PsnrDb >= *Least)
    return Success{};
  return Error{File,
               fmt::format("{} {:.2f} dB{}, expected at least {} dB", What,
                           D.PsnrDb, notFinite(D), *Least),
               ExitCode::GuestFailed};
}

} // namespace

Expected<nlohmann::ordered_json> comparedFile(const std::string &File) {
  if (File.empty())
    return nlohmann::ordered_json(nullptr);
  auto Hash = fnv1a64OfFile(File);
  if (!Hash)
    return Hash.error();
  return nlohmann::ordered_json{{"file", File}, {"fnv1a64", *Hash}};
}

Expected<Success> comparePictures(const CompareArguments &A) {
  if (auto Checked = checkJsonName(A.Json); !Checked)
    return Checked;
  if (auto Claimed =
          claimOutputs({{"--json", A.Json}}, {{"a picture", A.Reference},
                                              {"a picture", A.Picture},
                                              {"--mask", A.Mask}});
      !Claimed)
    return Claimed;
  auto First = readImage(A.Reference);
  if (!First)
    return First.error();
  auto Second = readImage(A.Picture);
  if (!Second)
    return Second.error();
  if (First->Width != Second->Width || First->Height != Second->Height)
    return Error{A.Picture,
                 fmt::format("{}x{} pixels, expected {}x{} as in {}",
                             Second->Width, Second->Height, First->Width,
                             First->Height, A.Reference)};
  std::vector<uint8_t> Mask;
  if (!A.Mask.empty()) {
    auto Read = readMask(A.Mask, *First);
    if (!Read)
      return Read.error();
    Mask = std::move(*Read);
  }

  const bool InBytes = First->IsEightBit || Second->IsEightBit;
  if (InBytes) {
    roundToBytes(*First);
    roundToBytes(*Second);
  }
  const char *Measure = InBytes ? EightBitMetric : Metric;
  const Difference All = compare(First->Render, Second->Render, 3);
  const Difference Outside = compare(First->Render, Second->Render, 3, Mask);
  const double Share =
      1 - double(Outside.Pixels) / static_cast<double>(First->pixels());
  printOut("metric: {}\n", Measure);
  print("render, all pixels", All);
  if (!Mask.empty()) {
    print("render, outside the mask", Outside);
    printOut("masked: {:.3f} %\n", 100 * Share);
  }
  if (!First->Alpha.empty() && !Second->Alpha.empty())
    print(Mask.empty() ? "alpha, all pixels" : "alpha, outside the mask",
          compare(First->Alpha, Second->Alpha, 1, Mask));
  const auto Ssim = ssimOutside(*First, *Second, Mask, Outside);
  if (Ssim)
    printOut("SSIM{}: {:.5f}\n", Mask.empty() ? "" : ", outside the mask",
             *Ssim);
  if (!A.Json.empty()) {
    nlohmann::ordered_json Report = reportHead("splat-compare");
    for (const auto &[Name, File] :
         {std::pair("a", &A.Reference), std::pair("b", &A.Picture),
          std::pair("mask", &A.Mask)}) {
      auto Input = comparedFile(*File);
      if (!Input)
        return Input.error();
      Report[Name] = std::move(*Input);
    }
    Report.update({{"metric", Measure},
                   {"equal", All.MaxAbs == 0},
                   {"psnr_db", finite(All.PsnrDb)},
                   {"max_abs", finite(All.MaxAbs)},
                   {"doubtful_share", Share},
                   {"psnr_db_outside_doubtful", finite(Outside.PsnrDb)},
                   {"max_abs_outside_doubtful", finite(Outside.MaxAbs)},
                   {"ssim_outside_doubtful",
                    Ssim ? nlohmann::ordered_json(*Ssim) : nullptr},
                   {"not_finite", All.NotFinite},
                   {"not_finite_outside_doubtful", Outside.NotFinite}});
    if (auto Written = writeFileAtomically(A.Json, jsonText(Report, 2) + "\n");
        !Written)
      return Written;
  }

  if (auto Enough = require(A.Picture, "over all pixels", All, A.MinDbAll);
      !Enough)
    return Enough;
  if (A.MaxDoubtful && 100 * Share > *A.MaxDoubtful)
    return Error{A.Mask,
                 fmt::format("{:.3f} % of the pixels are doubtful, expected "
                             "at most {} %",
                             100 * Share, *A.MaxDoubtful),
                 ExitCode::GuestFailed};
  return require(A.Picture,
                 Mask.empty() ? "over all pixels" : "outside doubtful pixels",
                 Outside, A.MinDb);
}

} // namespace vorion::splat
