#include "train/optimize/Density.h"

#include "kernels/batch.cl.h"
#include "kernels/density.cl.h"
#include "kernels/scan.cl.h"
#include "kernels/sort.cl.h"
#include "picture/Layout.h"
#include "render/Pipeline.h"
#include "render/Plan.h"
#include "scene/Activation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorion::splat {

namespace {
constexpr float Never = std::numeric_limits<float>::infinity();
} // namespace

std::vector<ProgramSpec> densityPrograms(RendererKind Of) {
  kernels::density::Program Density;
  if (hasRayRecords(Of))
    Density.USE_RAYS = EffectSwitch::compiled();
  return {Density, kernels::scan::Program{}, kernels::sort::Program{}};
}

ProgramSpec batchProgram() { return kernels::batch::Program{}; }

namespace {

DensityNotes nothing(uint32_t Count) {
  return {std::vector<float>(Count), std::vector<uint32_t>(Count),
          std::vector<float>(Count)};
}

} // namespace

void DensityControl::restart(uint32_t Count) { restore(nothing(Count)); }

DensityControl::Notebook DensityControl::upload(const DensityNotes &N) {
  const auto Upload = [&](const auto &Values) {
    cl::Buffer To = words("density control's notes", Values.size());
    Launch.write("density control's notes", To, Values.data(),
                 4 * Values.size());
    return To;
  };
  return {Upload(N.GradientSums), Upload(N.Views), Upload(N.Radii)};
}

DensityNotes DensityControl::download(const Notebook &From, uint32_t Count) {
  DensityNotes N = nothing(Count);
  const uint64_t Bytes = 4 * uint64_t{Count};
  Launch.read("density control's notes", N.GradientSums.data(),
              From.GradientSums, Bytes);
  Launch.read("density control's notes", N.Views.data(), From.Views, Bytes);
  Launch.read("density control's notes", N.Radii.data(), From.Radii, Bytes);
  return N;
}

void DensityControl::note(const SeenView &V, uint32_t Count) {
  Launch.run(itemsFor(Count), GroupSize,
             kernels::density::density_note{
                 .records = V.Records,
                 .depths = V.Depths,
                 .gradients = V.Gradients,
                 .plane = V.MeanPlane,
                 .sums = Noted.GradientSums,
                 .views = Noted.Views,
                 .radii = Noted.Radii,
                 .count = Count,
                 .half_width = 0.5F * static_cast<float>(V.Width),
                 .half_height = 0.5F * static_cast<float>(V.Height)});
}

/// The sum of \p Values; their prefix sums are left in Places.
uint32_t DensityControl::total(const cl::Buffer &Values, uint32_t Count) {
  Sort.scan(Values, Places, Count);
  uint32_t Sum = 0;
  Launch.read("places of Gaussians", &Sum, Places, 4, 4 * uint64_t{Count});
  return Sum;
}

uint32_t DensityControl::decide(const DeviceScene &S, unsigned Iteration) {
  const bool DropsLarge = dropsLargeAt(Settings, Iteration);
  splat_density Rule{};
  Rule.gradient = static_cast<float>(Settings.DensifyGradient);
  Rule.split_log_scale =
      static_cast<float>(std::log(Settings.SplitExtent * Extent));
  Rule.split_shrink = static_cast<float>(std::log(Settings.SplitShrink));
  Rule.least_logit = opacityLogit(Settings.LeastOpacity);
  Rule.most_log_scale =
      DropsLarge ? static_cast<float>(std::log(Settings.MostExtent * Extent))
                 : Never;
  Rule.most_radius =
      DropsLarge ? static_cast<float>(Settings.MostRadius) : Never;
  Launch.run(itemsFor(S.Count), GroupSize,
             kernels::density::density_decide{.geometry = S.Parameters.Geometry,
                                              .sums = Noted.GradientSums,
                                              .views = Noted.Views,
                                              .radii = Noted.Radii,
                                              .fates = Fates,
                                              .counts = Counts,
                                              .keys = Keys,
                                              .order = Order,
                                              .count = S.Count,
                                              .rule = Rule});
  return total(Counts, S.Count);
}

void DensityControl::limit(uint32_t Count, uint32_t Total) {
  const cl::Buffer Grows = words("growing Gaussians", Count);
  Launch.run(itemsFor(Count), GroupSize,
             kernels::density::density_grows{
                 .counts = Counts, .grows = Grows, .count = Count});
  // Each that grows becomes one more.
  const uint32_t Kept = Total - total(Grows, Count);
  const uint32_t More =
      Settings.MostGaussians > Kept ? Settings.MostGaussians - Kept : 0;
  const Sorter::Pairs A{words("sorted gradients", Count),
                        words("sorted Gaussians", Count)};
  const Sorter::Pairs B{words("sorted gradients", Count),
                        words("sorted Gaussians", Count)};
  const Sorter::Pairs Sorted =
      Sort.sort({Keys, Order}, A, B, Count, {0, 32}, Sorter::Keys::Lost);
  Launch.run(itemsFor(Count), GroupSize,
             kernels::density::density_limit{.order = Sorted.Values,
                                             .fates = Fates,
                                             .counts = Counts,
                                             .count = Count,
                                             .most = More});
}

/// Counted on the host: a kernel would be one for every run.
uint32_t DensityControl::withoutGradient(uint32_t Count) {
  std::vector<float> Sums(Count);
  Launch.read("density control's notes", Sums.data(), Noted.GradientSums,
              4 * uint64_t{Count});
  return static_cast<uint32_t>(std::ranges::count(Sums, 0.0F));
}

DensityChange DensityControl::densify(DeviceScene &S, unsigned Iteration) {
  const uint32_t WithoutGradient = withoutGradient(S.Count);
  Fates = words("fates of Gaussians", S.Count);
  Counts = words("numbers of Gaussians", S.Count);
  Places = words("places of Gaussians", uint64_t{S.Count} + 1);
  Keys = words("gradients to sort", S.Count);
  Order = words("Gaussians to sort", S.Count);
  uint32_t After = decide(S, Iteration);
  if (!Launch.failure() && After > Settings.MostGaussians) {
    limit(S.Count, After);
    After = total(Counts, S.Count);
  }
  if (!Launch.failure() && After == 0)
    Launch.fail({"",
                 "density control pruned every Gaussian, expected at least one "
                 "to remain",
                 ExitCode::LimitReached});
  if (Launch.failure())
    return {};

  const DensityChange Change{S.Count, After, WithoutGradient};
  DeviceScene New;
  New.Count = After;
  New.ShDegree = S.ShDegree;
  const auto Move = [&](const cl::Buffer &From, const cl::Buffer &To,
                        uint32_t Planes, bool Moments) {
    Launch.run(cl::NDRange(itemsFor(S.Count)[0], Planes),
               cl::NDRange(GroupSize, 1),
               kernels::density::density_copy{.in = From,
                                              .out = To,
                                              .fates = Fates,
                                              .places = Places,
                                              .count = S.Count,
                                              .new_count = After,
                                              .moments = Moments ? 1U : 0U});
  };
  New.Parameters = New.allocate(Launch, After);
  Move(S.Parameters.Geometry, New.Parameters.Geometry, GEOMETRY_PLANES, false);
  Move(S.Parameters.Sh, New.Parameters.Sh, S.colourPlanes(), false);
  S.remakeMoments(Launch, New,
                  [&](const cl::Buffer &From, const cl::Buffer &To,
                      uint32_t Planes) { Move(From, To, Planes, true); });
  const auto SeedLow = static_cast<uint32_t>(Seed);
  const auto SeedHigh = static_cast<uint32_t>(Seed >> 32);
  Launch.run(itemsFor(S.Count), GroupSize,
             kernels::density::density_split{
                 .geometry = S.Parameters.Geometry,
                 .new_geometry = New.Parameters.Geometry,
                 .identities = S.Identities,
                 .fates = Fates,
                 .places = Places,
                 .count = S.Count,
                 .new_count = After,
                 .seed_low = SeedLow,
                 .seed_high = SeedHigh,
                 .iteration = Iteration,
                 .shrink = static_cast<float>(std::log(Settings.SplitShrink))});
  New.Identities = words("Gaussians' identities", After);
  Launch.run(itemsFor(S.Count), GroupSize,
             kernels::density::density_identify{.in = S.Identities,
                                                .out = New.Identities,
                                                .fates = Fates,
                                                .places = Places,
                                                .count = S.Count,
                                                .seed_low = SeedLow,
                                                .seed_high = SeedHigh,
                                                .iteration = Iteration});
  S = New;
  Fates = Counts = Places = Keys = Order = {};
  restart(After);
  return Change;
}

void DensityControl::resetOpacity(DeviceScene &S) {
  Launch.run(itemsFor(S.Count), GroupSize,
             kernels::density::reset_opacity{
                 .geometry = S.Parameters.Geometry,
                 .count = S.Count,
                 .most_logit = opacityLogit(Settings.ResetOpacity)});
  for (MomentPair *M : {&S.First, &S.Second})
    M->Geometry.changePlane(
        Launch, S.Count, PLANE_LOGIT,
        [&](const cl::Buffer &Values, uint32_t At) {
          Launch.run(itemsFor(S.Count), GroupSize,
                     kernels::density::forget_plane{
                         .moments = Values, .plane = At, .count = S.Count});
        });
}

} // namespace vorion::splat
