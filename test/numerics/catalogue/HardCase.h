/// The catalogue of numerically hard scenes: what each is, why it is hard, and
/// what must come out of it (docs/hard-cases.md).
#pragma once

#include "picture/Options.h"
#include "render/Renderer.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace vorion::test {

/// Gaussians culled for each reason, by \c splat::CullReasons.
using Culled = std::array<uint64_t, splat::CullReasons.size()>;

/// One hard scene with its view and contract.
struct HardCase {
  std::string Name;
  std::string Why; ///< one sentence
  splat::Scene Scene;
  splat::Camera View;
  /// On either path; knobs change them further.
  splat::RenderOptions Options;
  /// Gaussians that fp32 culls and fp64 would not, being beyond fp32's range or
  /// on a threshold: left out of the fp64 picture too where fp32 does.
  std::vector<uint32_t> BeyondSingle{};
  Culled ExpectedCulls{};
  /// Largest error of a pixel that is not doubtful, whatever the error of the
  /// fp32 reference is; under the case's own options.
  double Cap = 1e-5;
  /// Largest share of doubtful pixels.
  double MostDoubtful = 0.02;
  /// Names of \c brokenKernels that this case must notice, on each path that
  /// they are in.
  std::vector<std::string> FoundIn{};
  /// Decimal digits of the largest colour that fp64 has of it, with and
  /// without dilation: at least.
  double ExactDigits = 10;
  /// Under a knob it may need more memory than the machine has, which one line
  /// says.
  bool MayExceedMemory = false;
  /// Left out of the tests' share.
  bool Long = false;
};

/// All of them, in the order of the documentation.
std::vector<HardCase> catalogue();

/// A case that has no scene because it is about a unit's input or a file's
/// content: its test stands elsewhere.
struct CaseElsewhere {
  std::string Name, Contract, Test;
};
std::vector<CaseElsewhere> casesElsewhere();

/// \name Parts of \c catalogue
/// @{
void addShapes(std::vector<HardCase> &Cases);
void addOpacities(std::vector<HardCase> &Cases);
void addViews(std::vector<HardCase> &Cases);
void addPlaces(std::vector<HardCase> &Cases);
void addOrders(std::vector<HardCase> &Cases);
void addLists(std::vector<HardCase> &Cases);
void addLenses(std::vector<HardCase> &Cases);
/// @}

} // namespace vorion::test
