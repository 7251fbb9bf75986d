/// The workload of a study: scenes with their views, and training states.
#pragma once

#include "study/Provenance.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// The kinds of work of a machine, whose rates are not comparable.
enum class Work { Frames, Iterations };
inline constexpr std::array AllWork{Work::Frames, Work::Iterations};

constexpr std::string_view name(Work W) {
  return W == Work::Frames ? "frames" : "iterations";
}

/// A scene with its views, or a training state.
struct Part {
  std::string Name; ///< empty for the scene on the command line
  Work Does = Work::Frames;
  double Weight = 1; ///< of each frame or iteration
  Provenance From;   ///< common provenance of its tasks
};

/// The work of one run: a frame, or some iterations.
struct Task {
  std::size_t Of = 0; ///< index of its part
  std::string Name;   ///< "front", "guitar@front@small" or "chair"
  std::string View;   ///< "front"; empty for iterations
  int Width = 0, Height = 0;
  unsigned Iterations = 0; ///< number of timed iterations
  /// The subcommand of splat and its arguments, except those for outputs.
  std::vector<std::string> Words;
  Provenance From; ///< in addition to that of the part
};

struct Workload {
  std::vector<Part> Parts;
  std::vector<Task> Whole;
  /// The same tasks at a smaller size, in the same order, with "@small" after
  /// their names. Tasks that are small in Whole are unchanged. Empty if all
  /// are.
  std::vector<Task> Small;

  bool has(Work W) const;
  /// Whether parts have names, which those of a file have.
  bool isNamed() const { return !Parts.front().Name.empty(); }
};

} // namespace vorion::splat
