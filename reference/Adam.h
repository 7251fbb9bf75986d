/// The optimiser, one parameter at a time.
#pragma once

namespace vorion::reference {

struct AdamRule {
  double Beta1 = 0.9, Beta2 = 0.999, Epsilon = 1e-15;
};

/// Running means of the gradient and of its square.
struct AdamMoments {
  double First = 0, Second = 0;
};

/// What step \p Step (from 1) with \p Gradient and \p Rate adds to the
/// parameter (D. P. Kingma, J. Ba 2015, algorithm 1); \p Moments move on.
double adamStep(double Gradient, unsigned Step, double Rate,
                AdamMoments &Moments, const AdamRule &Rule = {});

} // namespace vorion::reference
