/// What machines are tried on: scenes with their views, and states of training.
#pragma once

#include "study/Provenance.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// What a machine does. Its speed at the one is no speed at the other.
enum class Work { Frames, Iterations };
inline constexpr std::array AllWork{Work::Frames, Work::Iterations};

constexpr std::string_view name(Work W) {
  return W == Work::Frames ? "frames" : "iterations";
}

/// A scene with its views, or a state of training.
struct Part {
  std::string Name; ///< empty for the scene of a command line
  Work Does = Work::Frames;
  double Weight = 1; ///< of each of its frames, or of an iteration
  Provenance From;   ///< what its tasks are made from
};

/// What one run of this program measures: a frame, or some iterations.
struct Task {
  std::size_t Of = 0; ///< place of its part
  std::string Name;   ///< "front", "guitar@front@small" or "chair"
  std::string View;   ///< "front"; empty for iterations
  int Width = 0, Height = 0;
  unsigned Iterations = 0; ///< that are timed
  /// The subcommand of splat, what it reads and how, and what it trains; not
  /// what it writes.
  std::vector<std::string> Words;
  Provenance From; ///< beside that of the part
};

struct Workload {
  std::vector<Part> Parts;
  std::vector<Task> Whole;
  /// The same in a smaller size, in the same order, with "@small" behind their
  /// names; what is small is as it is in Whole. Empty if all is.
  std::vector<Task> Small;

  bool has(Work W) const;
  /// Whether parts are told apart: those of a file have names.
  bool isNamed() const { return !Parts.front().Name.empty(); }
};

} // namespace vorion::splat
