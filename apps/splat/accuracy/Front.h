/// Which settings are worth having.
#pragma once

#include "accuracy/Setting.h"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// What a setting may cost: cycles, or the chip's joules where they are asked
/// for. Every run repeats them.
enum class TimeAxis { Cycles, EqualArea, Cores, Energy };
inline constexpr std::size_t TimeAxes = 4;
/// Their names in files.
inline constexpr std::array<std::string_view, TimeAxes> TimeAxisNames{
    "cycles", "equal_area_cycles", "cores_cycles", "chip_joules"};

/// The errors that a setting may be judged by.
enum class ErrorKind { Psnr, Ssim, Largest, OffShare };
inline constexpr std::size_t ErrorKinds = 4;
/// Their names in files.
inline constexpr std::array<std::string_view, ErrorKinds> ErrorNames{
    "psnr_db", "ssim", "largest", "off_share"};
constexpr bool moreIsBetter(ErrorKind K) {
  return K == ErrorKind::Psnr || K == ErrorKind::Ssim;
}
/// By kind; of equal pictures the PSNR is infinite.
using Errors = std::array<double, ErrorKinds>;

/// A setting over several views.
struct Candidate {
  Setting Chosen;
  Errors Worst{}; ///< of the views, on the rasterizer
  /// Sums over the views; nothing where the setting cannot be so.
  std::array<std::optional<double>, TimeAxes> Times{};
  std::optional<Errors> CoresWorst = std::nullopt; ///< on the cores alone
  double LaneArea = 1; ///< relative to the default's

  double db() const { return Worst[static_cast<std::size_t>(ErrorKind::Psnr)]; }
  std::optional<double> time(TimeAxis A) const {
    return Times[static_cast<std::size_t>(A)];
  }
};

/// What a candidate is worth: more merit is better.
struct Judged {
  double Merit = 0;
  std::optional<double> Time;
  std::size_t Changes = 0; ///< knobs that do not have their default
};

/// By \p K, of the pictures that \p A times.
std::vector<Judged> judged(const std::vector<Candidate> &All, ErrorKind K,
                           TimeAxis A);

/// Times whose ratio is nearer to 1 than this are the same: what a unit's
/// latency adds at the end of each tile is no reason to prefer another.
inline constexpr double SameTime = 0.002;

/// Places in \p All of those that no other one beats: that are faster than all
/// at least as accurate ones. Of equally accurate ones that are as fast as the
/// fastest, the one that changes least is there. The most accurate first.
std::vector<std::size_t> paretoFront(const std::vector<Judged> &All);
/// The same by the PSNR on the rasterizer.
std::vector<std::size_t> paretoFront(const std::vector<Candidate> &All,
                                     TimeAxis A);

/// The fastest of the front of \p All with at least \p Floor: nothing with that
/// much is faster, but for what is the same time.
std::optional<std::size_t> recommend(const std::vector<Judged> &All,
                                     double Floor);
/// The same by the PSNR of the pictures that \p A times.
std::optional<std::size_t> recommend(const std::vector<Candidate> &All,
                                     TimeAxis A, double FloorDb);

/// What recommend() gives for every floor: \c Best for those up to \c Most that
/// are above the last step's.
struct FloorStep {
  double Most = 0;
  std::size_t Best = 0;
};
std::vector<FloorStep> recommendations(const std::vector<Judged> &All);

/// Places in \p All of those that change one knob of \p Base, the default's
/// candidate, and take its time by \p A.
std::vector<std::size_t> sameTimeAs(const Candidate &Base,
                                    const std::vector<Candidate> &All,
                                    TimeAxis A);

/// All combinations of the values that are on a front of machine time of their
/// own knob, by the single-knob candidates of \p All, and have at least
/// \p FloorDb; without those that change one knob or none. (A knob that saves
/// much would keep others, whose savings add to its own, off a common front.)
/// Where they are more than \p Most, the values that save least are left out
/// until they are not.
std::vector<Setting> productOfFronts(const std::vector<Knob> &Knobs,
                                     const std::vector<Candidate> &All,
                                     double FloorDb, std::size_t Most);

} // namespace vorion::splat
