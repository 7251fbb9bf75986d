/// The Pareto front of settings.
#pragma once

#include "accuracy/Setting.h"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// The costs of a setting: cycles, or the chip's joules if requested.
/// Deterministic.
enum class TimeAxis { Cycles, EqualArea, Cores, Energy };
inline constexpr std::size_t TimeAxes = 4;
/// Their names in files.
inline constexpr std::array<std::string_view, TimeAxes> TimeAxisNames{
    "cycles", "equal_area_cycles", "cores_cycles", "chip_joules"};

/// The error metrics of a setting.
enum class ErrorKind { Psnr, Ssim, Largest, OffShare };
inline constexpr std::size_t ErrorKinds = 4;
/// Their names in files.
inline constexpr std::array<std::string_view, ErrorKinds> ErrorNames{
    "psnr_db", "ssim", "largest", "off_share"};
constexpr bool moreIsBetter(ErrorKind K) {
  return K == ErrorKind::Psnr || K == ErrorKind::Ssim;
}
/// By kind; the PSNR of equal pictures is infinite.
using Errors = std::array<double, ErrorKinds>;

/// The results of a setting over several views.
struct Candidate {
  Setting Chosen;
  Errors Worst{}; ///< of the worst view, on the rasterizer
  /// Sums over the views; empty if the setting does not support the path.
  std::array<std::optional<double>, TimeAxes> Times{};
  std::optional<Errors> CoresWorst = std::nullopt; ///< on the path `simt`
  double LaneArea = 1; ///< relative to the default's

  double db() const { return Worst[static_cast<std::size_t>(ErrorKind::Psnr)]; }
  std::optional<double> time(TimeAxis A) const {
    return Times[static_cast<std::size_t>(A)];
  }
};

/// Merit (higher is better) and cost of a candidate.
struct Judged {
  double Merit = 0;
  std::optional<double> Time;
  std::size_t Changes = 0; ///< number of knobs that differ from their default
};

/// Merit by \p K, for the pictures of the cost \p A.
std::vector<Judged> judged(const std::vector<Candidate> &All, ErrorKind K,
                           TimeAxis A);

/// Times whose ratio is nearer to 1 than this count as equal: the latency of a
/// unit at the end of each tile does not make another unit preferable.
inline constexpr double SameTime = 0.002;

/// Indices in \p All of the Pareto-optimal candidates: faster than all that are
/// at least as accurate. Of equal candidates, the one with the fewest changes.
/// Sorted by descending merit.
std::vector<std::size_t> paretoFront(const std::vector<Judged> &All);
/// The same for the PSNR on the rasterizer.
std::vector<std::size_t> paretoFront(const std::vector<Candidate> &All,
                                     TimeAxis A);

/// The fastest candidate on the front of \p All with a merit of at least \p
/// Floor, up to equal times.
std::optional<std::size_t> recommend(const std::vector<Judged> &All,
                                     double Floor);
/// The same for the PSNR of the pictures of the cost \p A.
std::optional<std::size_t> recommend(const std::vector<Candidate> &All,
                                     TimeAxis A, double FloorDb);

/// The results of recommend() as a step function of the floor: \c Best up to \c
/// Most, from the previous step's \c Most on.
struct FloorStep {
  double Most = 0;
  std::size_t Best = 0;
};
std::vector<FloorStep> recommendations(const std::vector<Judged> &All);

/// Indices in \p All of the single changes of \p Base, the default, whose cost
/// \p A is equal to its cost.
std::vector<std::size_t> sameTimeAs(const Candidate &Base,
                                    const std::vector<Candidate> &All,
                                    TimeAxis A);

/// All combinations of at least two changes whose values are on the front of
/// machine time of their own knob, by the single changes in \p All, and reach
/// \p FloorDb. (On a common front, a knob with a large saving would exclude
/// others whose savings add to its own.) If there are more than \p Most, values
/// with the smallest savings are dropped.
std::vector<Setting> productOfFronts(const std::vector<Knob> &Knobs,
                                     const std::vector<Candidate> &All,
                                     double FloorDb, std::size_t Most);

} // namespace vorion::splat
