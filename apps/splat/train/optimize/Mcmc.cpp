#include "train/optimize/Mcmc.h"

#include "kernels/mcmc.cl.h"
#include "picture/Layout.h"
#include "render/Pipeline.h"
#include "scene/Activation.h"

#include <algorithm>
#include <limits>

namespace vorion::splat {

namespace {

/// Which draws are meant, for their random numbers.
enum : uint32_t { DrawsOfMoves = 0, DrawsOfGrowth = 1 };

cl::NDRange planesOf(uint32_t Count, std::size_t Planes) {
  return {itemsFor(Count)[0], Planes};
}

const cl::NDRange PlaneGroup(GroupSize, 1);

} // namespace

ProgramSpec mcmcProgram() { return kernels::mcmc::Program{}; }

/// The sum of \p Values, whose prefix sums go to \p Sums.
uint32_t McmcControl::total(const cl::Buffer &Values, const cl::Buffer &Sums,
                            uint32_t Count) {
  Sort.scan(Values, Sums, Count);
  uint32_t Sum = 0;
  Launch.read("sums over Gaussians", &Sum, Sums, 4, 4 * uint64_t{Count});
  return Sum;
}

McmcControl::Weights McmcControl::weigh(const DeviceScene &S, float DeadLogit) {
  // Their sum must fit into a word.
  const double Scale =
      std::min(16777216.0, 0.999 * std::numeric_limits<uint32_t>::max() /
                               std::max(1U, S.Count));
  const cl::Buffer Each = words("Gaussians' weights", S.Count);
  Weights W{words("sums of weights", uint64_t{S.Count} + 1),
            words("transparent Gaussians", S.Count), 0};
  Launch.run(itemsFor(S.Count), GroupSize,
             kernels::mcmc::mcmc_weigh{.geometry = S.Parameters.Geometry,
                                       .weights = Each,
                                       .dead = W.Dead,
                                       .count = S.Count,
                                       .dead_logit = DeadLogit,
                                       .scale = static_cast<float>(Scale)});
  W.Total = total(Each, W.Sums, S.Count);
  if (!Launch.failure() && W.Total == 0)
    Launch.fail({"",
                 "every Gaussian is practically transparent, expected at least "
                 "one visible Gaussian to sample",
                 ExitCode::LimitReached});
  return W;
}

McmcControl::Draw McmcControl::draw(const DeviceScene &S, const Weights &W,
                                    uint32_t Draws, uint32_t Kind,
                                    unsigned Iteration) {
  Draw D{words("drawn Gaussians", Draws), words("times drawn", S.Count)};
  const std::vector<uint32_t> None(S.Count, 0);
  Launch.write("times drawn", D.Drawn, None.data(), 4 * None.size());
  Launch.run(itemsFor(Draws), GroupSize,
             kernels::mcmc::mcmc_draw{.sums = W.Sums,
                                      .sources = D.Sources,
                                      .drawn = D.Drawn,
                                      .count = S.Count,
                                      .draws = Draws,
                                      .total = W.Total,
                                      .seed_low = seedLow(),
                                      .seed_high = seedHigh(),
                                      .kind = Kind,
                                      .iteration = Iteration});
  return D;
}

void McmcControl::share(DeviceScene &S, const Draw &D) {
  Launch.run(itemsFor(S.Count), GroupSize,
             kernels::mcmc::mcmc_share{
                 .geometry = S.Parameters.Geometry,
                 .drawn = D.Drawn,
                 .count = S.Count,
                 .least_opacity = static_cast<float>(Settings.LeastOpacity)});
}

void McmcControl::identify(const cl::Buffer &Identities, const Draw &D,
                           const cl::Buffer *List, uint32_t Count,
                           uint32_t Draws, unsigned Iteration) {
  Launch.run(itemsFor(Draws), GroupSize,
             kernels::mcmc::mcmc_identify{.identities = Identities,
                                          .sources = D.Sources,
                                          .list = List ? *List : D.Sources,
                                          .use_list = List ? 1U : 0U,
                                          .count = Count,
                                          .draws = Draws,
                                          .seed_low = seedLow(),
                                          .seed_high = seedHigh(),
                                          .iteration = Iteration});
}

void McmcControl::relocate(DeviceScene &S, unsigned Iteration) {
  const Weights W = weigh(S, opacityLogit(Settings.LeastOpacity));
  const cl::Buffer Places = words("places of Gaussians", uint64_t{S.Count} + 1);
  const uint32_t Dead = total(W.Dead, Places, S.Count);
  if (Launch.failure() || Dead == 0)
    return;
  const cl::Buffer List = words("transparent Gaussians", Dead);
  Launch.run(
      itemsFor(S.Count), GroupSize,
      kernels::mcmc::mcmc_list{
          .dead = W.Dead, .places = Places, .list = List, .count = S.Count});
  const Draw D = draw(S, W, Dead, DrawsOfMoves, Iteration);
  share(S, D);
  const auto Move = [&](const cl::Buffer &Values, std::size_t Planes,
                        bool Moments) {
    if (Moments)
      Launch.run(planesOf(S.Count, Planes), PlaneGroup,
                 kernels::mcmc::mcmc_forget{
                     .moments = Values, .drawn = D.Drawn, .count = S.Count});
    Launch.run(planesOf(Dead, Planes), PlaneGroup,
               kernels::mcmc::mcmc_move{.values = Values,
                                        .sources = D.Sources,
                                        .list = List,
                                        .count = S.Count,
                                        .draws = Dead,
                                        .moments = Moments ? 1U : 0U});
  };
  Move(S.Parameters.Geometry, GEOMETRY_PLANES, false);
  Move(S.Parameters.Sh, S.colourPlanes(), false);
  const auto MoveMoments = [&](const cl::Buffer &Values, uint32_t,
                               uint32_t Planes) { Move(Values, Planes, true); };
  for (MomentPair *M : {&S.First, &S.Second}) {
    M->Geometry.change(Launch, S.Count, GEOMETRY_PLANES, MoveMoments);
    M->Sh.change(Launch, S.Count, S.colourPlanes(), MoveMoments);
  }
  identify(S.Identities, D, &List, S.Count, Dead, Iteration);
}

void McmcControl::grow(DeviceScene &S, uint32_t After, unsigned Iteration) {
  // What has just moved counts whatever its opacity.
  const Weights W = weigh(S, -std::numeric_limits<float>::infinity());
  if (Launch.failure())
    return;
  const uint32_t More = After - S.Count;
  const Draw D = draw(S, W, More, DrawsOfGrowth, Iteration);
  share(S, D);
  DeviceScene New;
  New.Count = After;
  New.ShDegree = S.ShDegree;
  const auto Grow = [&](const cl::Buffer &From, const cl::Buffer &To,
                        std::size_t Planes, bool Moments) {
    Launch.run(planesOf(After, Planes), PlaneGroup,
               kernels::mcmc::mcmc_grow{.in = From,
                                        .out = To,
                                        .sources = D.Sources,
                                        .count = S.Count,
                                        .new_count = After,
                                        .moments = Moments ? 1U : 0U});
  };
  New.Parameters = New.allocate(Launch, After);
  Grow(S.Parameters.Geometry, New.Parameters.Geometry, GEOMETRY_PLANES, false);
  Grow(S.Parameters.Sh, New.Parameters.Sh, S.colourPlanes(), false);
  S.Parameters = {};
  S.remakeMoments(Launch, New,
                  [&](const cl::Buffer &From, const cl::Buffer &To,
                      uint32_t Planes) { Grow(From, To, Planes, true); });
  New.Identities = words("Gaussians' identities", After);
  Launch.run(planesOf(After, 1), PlaneGroup,
             kernels::mcmc::mcmc_grow{.in = S.Identities,
                                      .out = New.Identities,
                                      .sources = D.Sources,
                                      .count = S.Count,
                                      .new_count = After,
                                      .moments = 0U});
  identify(New.Identities, D, nullptr, S.Count, More, Iteration);
  S = New;
}

DensityChange McmcControl::change(DeviceScene &S, unsigned Iteration) {
  DensityChange Change{S.Count, S.Count};
  relocate(S, Iteration);
  const auto Wanted = static_cast<uint32_t>(
      std::min((1 + Settings.GrowShare) * S.Count,
               static_cast<double>(Settings.MostGaussians)));
  if (!Launch.failure() && Wanted > S.Count)
    grow(S, Wanted, Iteration);
  Change.After = S.Count;
  return Change;
}

void McmcControl::addNoise(DeviceScene &S, unsigned Iteration, double Rate) {
  Launch.run(itemsFor(S.Count), GroupSize,
             kernels::mcmc::mcmc_noise{.geometry = S.Parameters.Geometry,
                                       .identities = S.Identities,
                                       .count = S.Count,
                                       .seed_low = seedLow(),
                                       .seed_high = seedHigh(),
                                       .iteration = Iteration,
                                       .rate = static_cast<float>(Rate)});
}

} // namespace vorion::splat
