/// The optimizer Adam, for one parameter.
#pragma once

namespace vorion::reference {

struct AdamRule {
  double Beta1 = 0.9, Beta2 = 0.999, Epsilon = 1e-15;
};

/// First and second moment: running means of the gradient and of its square.
struct AdamMoments {
  double First = 0, Second = 0;
};

/// The update of a parameter in step \p Step (from 1) with \p Gradient and
/// learning rate \p Rate (D. P. Kingma, J. Ba 2015, algorithm 1). Updates \p
/// Moments.
double adamStep(double Gradient, unsigned Step, double Rate,
                AdamMoments &Moments, const AdamRule &Rule = {});

} // namespace vorion::reference
