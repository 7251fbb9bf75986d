#include "Adam.h"

#include <cmath>

namespace vorion::reference {

double adamStep(double Gradient, unsigned Step, double Rate,
                AdamMoments &Moments, const AdamRule &Rule) {
  Moments.First = Rule.Beta1 * Moments.First + (1 - Rule.Beta1) * Gradient;
  Moments.Second =
      Rule.Beta2 * Moments.Second + (1 - Rule.Beta2) * Gradient * Gradient;
  const double First = Moments.First / (1 - std::pow(Rule.Beta1, Step));
  const double Second = Moments.Second / (1 - std::pow(Rule.Beta2, Step));
  return -Rate * First / (std::sqrt(Second) + Rule.Epsilon);
}

} // namespace vorion::reference
