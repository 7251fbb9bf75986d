#include "Commands.h"

#include "../io/Image.h"
#include "../io/Metrics.h"
#include "../io/Npz.h"

#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>

namespace vorion::splat {

namespace {

struct CompareArguments {
  std::string A, B, Mask;
  std::optional<double> AtLeast;
};

/// The union of the arrays of \p File whose names begin with "mask".
Expected<std::vector<std::uint8_t>> readMask(const std::string &File,
                                             const Image &Picture) {
  auto Arrays = readNpz(File);
  if (!Arrays)
    return Arrays.error();
  std::vector<std::uint8_t> Mask(Picture.pixels(), 0);
  bool Found = false;
  for (const auto &[Name, Array] : *Arrays) {
    if (!Name.starts_with("mask"))
      continue;
    if (Array.elements() != Picture.pixels())
      return Error{File, fmt::format("{} has {} elements, expected {}x{}", Name,
                                     Array.elements(), Picture.Height,
                                     Picture.Width)};
    Found = true;
    const std::vector<double> Values = Array.toDoubles();
    for (std::size_t I = 0; I < Mask.size(); ++I)
      Mask[I] |= static_cast<std::uint8_t>(Values[I] != 0);
  }
  if (!Found)
    return Error{File, "no array whose name begins with mask"};
  return Mask;
}

void print(const char *What, const Difference &D) {
  fmt::print("{}: {:.2f} dB, largest difference {:.3g}, {} pixels\n", What,
             D.PsnrDb, D.MaxAbs, D.Pixels);
}

Expected<Success> run(const CompareArguments &Arguments) {
  auto A = readImage(Arguments.A);
  if (!A)
    return A.error();
  auto B = readImage(Arguments.B);
  if (!B)
    return B.error();
  if (A->Width != B->Width || A->Height != B->Height)
    return Error{Arguments.B,
                 fmt::format("{}x{} pixels, expected {}x{} as in {}", B->Width,
                             B->Height, A->Width, A->Height, Arguments.A)};

  fmt::print("metric: PSNR, peak 1, linear unclamped floats\n");
  Difference Judged = compare(A->Render, B->Render, 3);
  print("render, all pixels", Judged);
  std::vector<std::uint8_t> Mask;
  if (!Arguments.Mask.empty()) {
    auto Read = readMask(Arguments.Mask, *A);
    if (!Read)
      return Read.error();
    Mask = std::move(*Read);
    Judged = compare(A->Render, B->Render, 3, Mask);
    print("render, outside the mask", Judged);
    const auto Masked = static_cast<double>(A->pixels() - Judged.Pixels);
    fmt::print("masked: {:.3f} %\n",
               100 * Masked / static_cast<double>(A->pixels()));
  }
  if (!A->Alpha.empty() && !B->Alpha.empty())
    print(Mask.empty() ? "alpha, all pixels" : "alpha, outside the mask",
          compare(A->Alpha, B->Alpha, 1, Mask));
  if (Arguments.AtLeast && !(Judged.PsnrDb >= *Arguments.AtLeast))
    return Error{Arguments.B,
                 fmt::format("{:.2f} dB from {}, expected at least {} dB",
                             Judged.PsnrDb, Arguments.A, *Arguments.AtLeast),
                 ExitCode::GuestFailed};
  return Success{};
}

} // namespace

Runner addCompare(CLI::App &App) {
  auto Arguments = std::make_shared<CompareArguments>();
  App.add_option("a", Arguments->A, "Picture: .pfm or .npz")->required();
  App.add_option("b", Arguments->B, "Picture of the same size")->required();
  App.add_option(
      "--mask", Arguments->Mask,
      "Pixels to leave out: .npz whose arrays mask* are not 0 there");
  App.add_option("--at-least", Arguments->AtLeast,
                 "Exit with 1 if the PSNR (outside the mask) is lower, dB");
  return [Arguments] { return run(*Arguments); };
}

} // namespace vorion::splat
