/// Where the instructions go: an annotated source listing.
#pragma once

#include "observe/SourceCosts.h"
#include "vorion/isasim/Observer.h"

#include <string>

namespace vorion::isasim {

class Profile : public Observer {
public:
  void runBegins(const RunStart &R) override {
    Places.select(R.Program);
    InterleavedStacks = R.Shape.Timing.Core.InterleavedStacks != 0;
  }
  void commit(const Commit &C) override;

  /// The listing of all runs so far: for every source file, each line with what
  /// it cost; code without line numbers by function.
  std::string report() const;
  /// The same of every instruction, as JSON.
  std::string json() const;

private:
  /// Of one instruction or of one line.
  struct Cost {
    uint64_t Warp = 0;      ///< warp instructions
    uint64_t Lanes = 0;     ///< the same times active lanes
    uint64_t Splits = 0;    ///< of these, vx_split
    uint64_t Divergent = 0; ///< of these, those that divided the lanes
    uint64_t Accesses = 0;  ///< loads, stores, atomics
    uint64_t Lines = 0;     ///< of memory that they asked for
    bool isNone() const { return Warp == 0; }
    Cost &operator+=(const Cost &Other);
  };
  unsigned linesOf(const Commit &C) const;
  static std::string row(const Cost &C, uint64_t Total);

  SourceCosts<Cost> Places;
  bool InterleavedStacks = true; ///< of the machine that runs
};

} // namespace vorion::isasim
