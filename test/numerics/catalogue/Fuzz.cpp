#include "Fuzz.h"

#include "Build.h"
#include "Judge.h"
#include "Knobs.h"
#include "Rows.h"
#include "analyze/ToReference.h"
#include "reference/Projection.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <ostream>
#include <rapidcheck.h>
#include <set>

namespace vorion::test {

/// As the shrunk counterexample shows it.
static void showValue(const Blob &B, std::ostream &Out) {
  Out << fmt::format("mean {} {} {}, scale {:.3g} {:.3g} {:.3g}, quaternion {} "
                     "{} {} {}, opacity {:.6g}, color {:.3g} {:.3g} {:.3g}",
                     B.Mean[0], B.Mean[1], B.Mean[2], B.Scale[0], B.Scale[1],
                     B.Scale[2], B.Quat[0], B.Quat[1], B.Quat[2], B.Quat[3],
                     B.Opacity, B.Color[0], B.Color[1], B.Color[2]);
}

namespace {

using splat::Path;

constexpr int ScenesPerGroup = 10;
/// Most Gaussians of a scene; keeps a scene below a second.
constexpr int MostGaussians = 40;

rc::Gen<Blob> randomBlob() {
  return rc::gen::exec([] {
    const auto Part = [](int Low, int High) {
      return *rc::gen::inRange(Low, High + 1);
    };
    Blob B;
    // Multiples of powers of two, so that depths coincide at times.
    B.Mean = {static_cast<float>(Part(-60, 60)) / 32,
              static_cast<float>(Part(-60, 60)) / 32,
              2 + static_cast<float>(Part(-80, 160)) / 32};
    const int Odd = Part(0, 30); // one in thirty is extreme
    for (double &S : B.Scale)
      S = std::exp(Part(-36, 4) / 4.0 + (Odd == 1   ? 20
                                         : Odd == 2 ? -40
                                         : Odd == 3 ? 8
                                                    : 0));
    for (float &Q : B.Quat)
      Q = static_cast<float>(Part(-9, 9));
    B.Opacity = Odd == 4 ? 1 : 1 / (1 + std::exp(-Part(-60, 70) / 10.0));
    for (double &C : B.Color)
      C = Part(-4, 14) / 10.0;
    return B;
  });
}

/// What a group shares.
class Fuzzer {
public:
  explicit Fuzzer(Machine &M) : Device(M) {}

  /// Empty, or what does not hold.
  std::string failureOf(const HardCase &C, uint32_t Seed);

private:
  std::string againstReferences(HardCase C, Path P, const Setting &S);
  std::string weights(HardCase C, Path P, const Setting &S);
  std::string sameBits(const HardCase &C, const splat::Scene &Other,
                       const char *What);
  std::string monotone(const HardCase &C);

  Machine &Device;
};

/// Those that the reference draws in fp64 but not in fp32.
std::vector<uint32_t> beyondSingle(const HardCase &C,
                                   const reference::Options &O) {
  const auto Exact = reference::project(splat::toReference<double>(C.Scene),
                                        splat::toReference<double>(C.View), O);
  const auto Single = reference::project(splat::toReference<float>(C.Scene),
                                         splat::toReference<float>(C.View), O);
  std::vector<uint32_t> Beyond;
  for (uint32_t I = 0; I < Exact.size(); ++I)
    if (Exact[I].Visible && !Single[I].Visible)
      Beyond.push_back(I);
  return Beyond;
}

std::string Fuzzer::againstReferences(HardCase C, Path P, const Setting &S) {
  const splat::RenderOptions O = turned(C.Options, P, S);
  C.BeyondSingle = beyondSingle(C, referenceOptions(O));
  const auto R = Device.render(C, O, "");
  if (!R)
    return R.error().What;
  return Judge(C, O)
      .judge(*R, allowanceOf(S, O, C.Scene.size()), /*OwnOptions=*/false)
      .Broken;
}

std::string Fuzzer::weights(HardCase C, Path P, const Setting &S) {
  splat::RenderOptions O = turned(C.Options, P, S);
  O.Background = {1, 1, 1};
  std::ranges::fill(C.Scene.Sh, static_cast<float>(0.5 / splat::ShC0));
  const auto R = Device.render(C, O, "");
  if (!R)
    return R.error().What;
  // Three roundings a Gaussian, of values up to 1; and of each weight, where
  // multiplications are narrow.
  const double Bound =
      3 * 0x1p-24 * double(C.Scene.size() + 2) +
      (O.Arithmetic == splat::BlendUnit::Fp32 ? 0 : unitRoundoff(O.Arithmetic));
  for (const float V : R->Picture.Render)
    if (!(std::abs(double(V) - 1) <= Bound))
      return fmt::format("{}: weights and T add up to {:.9g}, expected 1 to "
                         "within {:.2g}",
                         flagsOf(P, S), V, Bound);
  return "";
}

std::string Fuzzer::sameBits(const HardCase &C, const splat::Scene &Other,
                             const char *What) {
  HardCase Changed = C;
  Changed.Scene = Other;
  const auto A = Device.render(C, C.Options, "");
  const auto B = Device.render(Changed, C.Options, "");
  if (!A || !B)
    return (A ? B : A).error().What;
  return A->Picture.Render == B->Picture.Render
             ? ""
             : fmt::format("{} changes the picture", What);
}

/// One more Gaussian behind all others makes no pixel more transparent.
std::string Fuzzer::monotone(const HardCase &C) {
  HardCase More = C;
  const double Behind = 500;
  add(More.Scene, {.Mean = seenAt(C.View, 0, 0, Behind),
                   .Scale = {200, 200, 200},
                   .Opacity = 0.3});
  const auto A = Device.render(C, C.Options, "");
  const auto B = Device.render(More, C.Options, "");
  if (!A || !B)
    return (A ? B : A).error().What;
  for (std::size_t I = 0; I < A->Picture.Alpha.size(); ++I)
    if (!(B->Picture.Alpha[I] >= A->Picture.Alpha[I]))
      return "one more Gaussian behind all makes a pixel more transparent";
  return "";
}

std::string Fuzzer::failureOf(const HardCase &C, uint32_t Seed) {
  for (const Path P : {Path::Raster, Path::Simt}) {
    const Setting S = combination(P, Seed);
    for (const std::string &Failure :
         {againstReferences(C, P, {}), againstReferences(C, P, S),
          weights(C, P, S)})
      if (!Failure.empty())
        return flagsOf(P, S) + ": " + Failure;
  }
  splat::Scene Scaled = C.Scene;
  for (float &Q : Scaled.Quats)
    Q *= 0x1p-9F;
  if (auto F = sameBits(C, Scaled, "the length of quaternions"); !F.empty())
    return F;

  std::set<float> Depths;
  splat::Scene Turned = splat::Scene::sized(0, C.Scene.ShDegree);
  for (std::size_t I = C.Scene.size(); I-- > 0;) {
    Depths.insert(C.Scene.Means[3 * I + 2]);
    append(Turned, C.Scene, I, 1);
  }
  if (Depths.size() == C.Scene.size())
    if (auto F = sameBits(C, Turned, "the file's order"); !F.empty())
      return F;
  return monotone(C);
}

/// Ten scenes; empty, or the shrunk counterexample.
std::string failureOfGroup(Machine &M, uint32_t Seed) {
  Fuzzer F(M);
  rc::detail::TestParams Params;
  Params.seed = Seed;
  Params.maxSuccess = ScenesPerGroup;
  Params.maxSize = MostGaussians;
  const auto Result = rc::detail::checkTestable(
      [&] {
        const auto Blobs = *rc::gen::nonEmpty(
            rc::gen::container<std::vector<Blob>>(randomBlob()));
        HardCase C;
        C.View =
            frontView(*rc::gen::inRange(1, 100), *rc::gen::inRange(1, 80), 40);
        C.Cap = 1;
        for (const Blob &B : Blobs)
          add(C.Scene, B);
        const auto Knobs = *rc::gen::inRange<uint32_t>(0, 1U << 20);
        if (const std::string Failure = F.failureOf(C, Knobs); !Failure.empty())
          RC_FAIL(Failure);
      },
      rc::detail::TestMetadata{"scenes", ""}, Params);
  std::ostringstream Said;
  if (Result.is<rc::detail::SuccessResult>())
    return "";
  rc::detail::printResultMessage(Result, Said);
  return Said.str();
}

} // namespace

Expected<Success> fuzz(const FuzzPlan &P) {
  auto M = Machine::open();
  if (!M)
    return M.error();
  auto Known = Rows::open(P.RowFile);
  if (!Known)
    return Known.error();
  const auto Start = std::chrono::steady_clock::now();
  uint32_t Done = 0;
  for (uint32_t I = 0; P.Groups == 0 || I < P.Groups; ++I) {
    const std::chrono::duration<double> Spent =
        std::chrono::steady_clock::now() - Start;
    if (P.Minutes > 0 && Spent.count() > 60 * P.Minutes)
      break;
    const uint32_t Seed = P.Seed + I;
    const std::string Key = fmt::format("fuzz {}", Seed);
    if (Known->find(Key))
      continue;
    if (const std::string Failure = failureOfGroup(*M, Seed); !Failure.empty())
      return Error{"", fmt::format("seed {}: {}", Seed, Failure),
                   ExitCode::GuestFailed};
    if (auto Kept = Known->add({{"key", Key}, {"scenes", ScenesPerGroup}});
        !Kept)
      return Kept;
    ++Done;
  }
  fmt::print("{} random scenes kept every invariant\n", Done * ScenesPerGroup);
  return Success{};
}

} // namespace vorion::test
