#include "train/Exposure.h"

#include "render/Pipeline.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat {

namespace {

constexpr std::size_t Terms = std::tuple_size_v<ExposureMatrix>;
/// Pixels of a group of exposure_back.
constexpr uint32_t Stretch = 4096;

/// Factors of the channel itself are 1, others 0.
float identity(std::size_t Term) { return Term % 5 == 0 ? 1.0F : 0.0F; }

} // namespace

ProgramSpec exposureProgram() { return {ExposureProgram, {"exposure.cl"}, {}}; }

void Exposures::restart() {
  const std::size_t Size = areOn() ? Terms * Pictures : 0;
  Values.resize(Size);
  for (std::size_t I = 0; I < Size; ++I)
    Values[I] = identity(I % Terms);
  First.assign(Size, 0);
  Second.assign(Size, 0);
}

cl::Buffer Exposures::upload(std::size_t View) {
  const cl::Buffer Matrix = Launch.allocate("exposure", 4 * Terms);
  Launch.write("exposure", Matrix, Values.data() + Terms * View, 4 * Terms);
  return Matrix;
}

cl::Buffer Exposures::apply(const cl::Buffer &Picture, uint32_t Pixels,
                            std::size_t View) {
  const cl::Buffer Exposed =
      Launch.allocate("exposed picture", 16 * uint64_t{Pixels});
  Launch.run(ExposureProgram, "exposure_apply", itemsFor(Pixels), GroupSize,
             Picture, Exposed, upload(View), Pixels);
  return Exposed;
}

ExposureMatrix Exposures::back(const cl::Buffer &Picture,
                               const cl::Buffer &Gradient, uint32_t Pixels,
                               std::size_t View) {
  const std::size_t Groups = (Pixels + Stretch - 1) / Stretch;
  std::vector<float> Sums(Terms * Groups);
  const cl::Buffer Parts =
      Launch.allocate("exposure's gradients", 4 * Sums.size());
  Launch.run(ExposureProgram, "exposure_back", Groups * Lanes, Lanes, Picture,
             Gradient, upload(View), Parts, Pixels, Stretch);
  Launch.read("exposure's gradients", Sums.data(), Parts, 4 * Sums.size());
  ExposureMatrix By{};
  for (std::size_t I = 0; I < Sums.size(); ++I)
    By[I % Terms] += Sums[I];
  return By;
}

void Exposures::step(const std::vector<Slope> &Slopes, unsigned Iteration) {
  std::vector<double> Gradient(Values.size(), 0);
  for (const Slope &S : Slopes)
    for (std::size_t K = 0; K < Terms; ++K)
      Gradient[Terms * S.View + K] +=
          S.Gradient[K] / static_cast<double>(Slopes.size());
  const double FirstBias = 1 - std::pow(Settings.Beta1, Iteration);
  const double SecondBias = 1 - std::pow(Settings.Beta2, Iteration);
  const double Rate = exposureRate(Settings, Iteration);
  ExposureMatrix Excess{};
  std::vector<double> Stepped(Values.size());
  for (std::size_t I = 0; I < Values.size(); ++I) {
    const double G = Gradient[I];
    First[I] = static_cast<float>(Settings.Beta1 * First[I] +
                                  (1 - Settings.Beta1) * G);
    Second[I] = static_cast<float>(Settings.Beta2 * Second[I] +
                                   (1 - Settings.Beta2) * G * G);
    Stepped[I] =
        Values[I] - Rate * (First[I] / FirstBias) /
                        (std::sqrt(Second[I] / SecondBias) + Settings.Epsilon);
    Excess[I % Terms] +=
        (Stepped[I] - identity(I % Terms)) / static_cast<double>(Pictures);
  }
  for (std::size_t I = 0; I < Values.size(); ++I)
    Values[I] = static_cast<float>(Stepped[I] - Excess[I % Terms]);
}

std::vector<float> Exposures::save() const {
  std::vector<float> All = Values;
  for (const std::vector<float> *Moment : {&First, &Second})
    All.insert(All.end(), Moment->begin(), Moment->end());
  return All;
}

void Exposures::restore(const std::vector<float> &State) {
  restart();
  if (State.size() != 3 * Values.size())
    return;
  const float *From = State.data();
  for (std::vector<float> *To : {&Values, &First, &Second}) {
    std::copy_n(From, To->size(), To->begin());
    From += To->size();
  }
}

ExposureMatrix Exposures::matrix(std::size_t View) const {
  ExposureMatrix M{};
  std::copy_n(Values.begin() + static_cast<std::ptrdiff_t>(Terms * View), Terms,
              M.begin());
  return M;
}

} // namespace vorion::splat
