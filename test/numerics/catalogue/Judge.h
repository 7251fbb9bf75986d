/// Holds a picture against the references in fp64 and fp32.
#pragma once

#include "HardCase.h"
#include "reference/Types.h"

namespace vorion::test {

/// \p O as the reference has it; what it has not changes no picture there.
reference::Options referenceOptions(const splat::RenderOptions &O);

/// What was found, and whether the contract is kept.
struct Verdict {
  double Error = 0;  ///< largest of a pixel that is not doubtful
  double Single = 0; ///< the same of the fp32 reference
  double Bound = 0;
  double DoubtfulError = 0; ///< largest of a doubtful pixel
  double Doubtful = 0;      ///< share of such pixels
  std::string Broken;       ///< what the contract says otherwise; empty: kept
};

/// The pictures that a case must come close to under some options. Reused for
/// every setting that does not change them.
class Judge {
public:
  /// What a picture shows.
  enum class Shown {
    Colors,
    Depths, ///< in the first channel, as \c splat::DepthMap has them
    Normals ///< in the world's axes
  };
  Judge(const HardCase &C, const splat::RenderOptions &O,
        Shown What = Shown::Colors);

  /// \p Allowance is in parts of the largest colour. \p OwnOptions: those of
  /// the case, for which it says how many are culled and how good fp32 is.
  Verdict judge(const splat::RenderResult &R, double Allowance,
                bool OwnOptions) const;

  /// False if a Gaussian is seen so exactly from its edge that its normal may
  /// be on either side.
  bool isSettled() const { return Settled; }

private:
  const HardCase &Case;
  bool Settled = true;
  double Cutoff, LeastAlpha;
  double Peak = 1; ///< largest colour
  std::vector<double> Exact, Single;
  std::vector<uint8_t> Doubts;
};

} // namespace vorion::test
