#include "train/optimize/Exposure.h"

#include "kernels/exposure.cl.h"
#include "render/Pipeline.h"

#include <algorithm>
#include <utility>

namespace vorion::splat {

namespace {

constexpr std::size_t Terms = std::tuple_size_v<ExposureMatrix>;
/// Pixels of a group of exposure_back.
constexpr uint32_t Stretch = 4096;

/// Factors of the channel itself are 1, others 0.
float identity(std::size_t Term) { return Term % 5 == 0 ? 1.0F : 0.0F; }

} // namespace

ProgramSpec exposureProgram() { return kernels::exposure::Program{}; }

void Exposures::restart() {
  std::vector<float> From(areOn() ? Terms * Pictures : 0);
  for (std::size_t I = 0; I < From.size(); ++I)
    From[I] = identity(I % Terms);
  State.restart(std::move(From));
}

cl::Buffer Exposures::upload(std::size_t View) {
  const cl::Buffer Matrix = Launch.allocate("exposure", 4 * Terms);
  Launch.write("exposure", Matrix, State.data() + Terms * View, 4 * Terms);
  return Matrix;
}

cl::Buffer Exposures::apply(const cl::Buffer &Picture, uint32_t Pixels,
                            std::size_t View) {
  const cl::Buffer Exposed =
      Launch.allocate("exposed picture", 16 * uint64_t{Pixels});
  Launch.run(itemsFor(Pixels), GroupSize,
             kernels::exposure::exposure_apply{.picture = Picture,
                                               .exposed = Exposed,
                                               .matrix = upload(View),
                                               .pixels = Pixels});
  return Exposed;
}

ExposureMatrix Exposures::back(const cl::Buffer &Picture,
                               const cl::Buffer &Gradient, uint32_t Pixels,
                               std::size_t View) {
  const std::size_t Groups = (Pixels + Stretch - 1) / Stretch;
  std::vector<float> Sums(Terms * Groups);
  const cl::Buffer Parts =
      Launch.allocate("exposure's gradients", 4 * Sums.size());
  Launch.run(Groups * Lanes, Lanes,
             kernels::exposure::exposure_back{.picture = Picture,
                                              .gradient = Gradient,
                                              .matrix = upload(View),
                                              .sums = Parts,
                                              .pixels = Pixels,
                                              .stretch = Stretch});
  Launch.read("exposure's gradients", Sums.data(), Parts, 4 * Sums.size());
  ExposureMatrix By{};
  for (std::size_t I = 0; I < Sums.size(); ++I)
    By[I % Terms] += Sums[I];
  return By;
}

void Exposures::step(const std::vector<Slope> &Slopes, unsigned Iteration) {
  std::vector<double> Gradient(State.size(), 0);
  for (const Slope &S : Slopes)
    for (std::size_t K = 0; K < Terms; ++K)
      Gradient[Terms * S.View + K] +=
          S.Gradient[K] / static_cast<double>(Slopes.size());
  const std::vector<double> Stepped = State.step(
      Settings, Gradient, exposureRate(Settings, Iteration), Iteration);
  ExposureMatrix Excess{};
  for (std::size_t I = 0; I < Stepped.size(); ++I)
    Excess[I % Terms] +=
        (Stepped[I] - identity(I % Terms)) / static_cast<double>(Pictures);
  for (std::size_t I = 0; I < Stepped.size(); ++I)
    State.set(I, Stepped[I] - Excess[I % Terms]);
}

void Exposures::restore(const std::vector<float> &Saved) {
  restart();
  State.restore(Saved);
}

ExposureMatrix Exposures::matrix(std::size_t View) const {
  ExposureMatrix M{};
  std::copy_n(State.data() + Terms * View, Terms, M.begin());
  return M;
}

} // namespace vorion::splat
