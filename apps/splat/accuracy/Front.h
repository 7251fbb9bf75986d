/// Which settings are worth having.
#pragma once

#include "Setting.h"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// The times that a setting may be judged by: counts, which every run repeats.
enum class TimeAxis { Cycles, EqualArea, Cores };
inline constexpr std::size_t TimeAxes = 3;
/// Their names in files.
inline constexpr std::array<std::string_view, TimeAxes> TimeAxisNames{
    "cycles", "equal_area_cycles", "cores_cycles"};

/// A setting over several views.
struct Candidate {
  Setting Chosen;
  double Db = 0; ///< the worst view's PSNR
  /// Sums over the views; nothing where the setting cannot be so.
  std::array<std::optional<double>, TimeAxes> Times;

  std::optional<double> time(TimeAxis A) const {
    return Times[static_cast<std::size_t>(A)];
  }
};

/// Times whose ratio is nearer to 1 than this are the same: what a unit's
/// latency adds at the end of each tile is no reason to prefer another.
inline constexpr double SameTime = 0.002;

/// Places in \p All of those that no other one beats: that are faster than all
/// at least as accurate ones. The most accurate first.
std::vector<std::size_t> paretoFront(const std::vector<Candidate> &All,
                                     TimeAxis A);

/// The fastest of \p All with at least \p FloorDb; of those that are as fast
/// the most accurate, of these the one that changes least.
std::optional<std::size_t> recommend(const std::vector<Candidate> &All,
                                     TimeAxis A, double FloorDb);

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
