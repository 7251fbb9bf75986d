#include "train/optimize/HostAdam.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vorion::splat {

void HostAdam::restart(std::vector<float> From) {
  Values = std::move(From);
  First.assign(Values.size(), 0);
  Second.assign(Values.size(), 0);
}

std::vector<double> HostAdam::step(const TrainSettings &Settings,
                                   const std::vector<double> &Gradient,
                                   double Rate, unsigned Iteration) {
  const double FirstBias = 1 - std::pow(Settings.Beta1, Iteration);
  const double SecondBias = 1 - std::pow(Settings.Beta2, Iteration);
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
  }
  return Stepped;
}

std::vector<float> HostAdam::save() const {
  std::vector<float> All = Values;
  for (const std::vector<float> *Moment : {&First, &Second})
    All.insert(All.end(), Moment->begin(), Moment->end());
  return All;
}

void HostAdam::restore(const std::vector<float> &State) {
  if (State.size() != 3 * Values.size())
    return;
  const float *From = State.data();
  for (std::vector<float> *To : {&Values, &First, &Second}) {
    std::copy_n(From, To->size(), To->begin());
    From += To->size();
  }
}

} // namespace vorion::splat
