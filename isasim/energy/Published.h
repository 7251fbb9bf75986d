/// Energies and areas that others published, and what a technology says of the
/// same. Figures only: they check the technology and enter no estimate.
#pragma once

#include "vorion/isasim/Energy.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

struct PublishedFigure {
  std::string_view What; ///< with its unit, if it is not pJ
  std::string_view Node;
  double Volts;     ///< of their figure; ours is taken at the same
  double Low, High; ///< theirs, equal if there is one
  /// Ours: \c Count times a row of the technology, or what \c Events are worth.
  std::string_view Row;
  double Count;
  std::vector<EventCount> Events;
  std::string_view Source;
};
std::span<const PublishedFigure> publishedFigures();

/// Where the interval of 90 % of ours lies.
enum class Beside : uint8_t { Below, Within, Above };
std::string_view name(Beside B);
Beside besideOf(const Estimate &Ours, const PublishedFigure &Theirs);

/// What \p T says of the same; an error if it has no law at the voltage, or no
/// currents of the DRAM.
Expected<Estimate> oursOf(const PublishedFigure &Theirs, const Technology &T);

/// A table of all.
std::string publishedMarkdown(const Technology &T);

} // namespace vorion::isasim
