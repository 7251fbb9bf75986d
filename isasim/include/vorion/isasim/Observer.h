/// What watches a run without changing it (docs/decisions.md, 9). Every
/// function does nothing by default.
#pragma once

#include "vorion/isasim/Result.h"

#include <cstdint>
#include <span>

namespace vorion::isasim {

/// A warp instruction that has been executed. Instructions that wait for other
/// cores are reported when they complete.
struct Commit {
  unsigned Core;
  unsigned Warp;
  uint32_t Pc;
  uint32_t Word;
  uint32_t LaneMask; ///< active lanes while it executed
  /// The destination register by lane, empty if there is none.
  std::span<const uint32_t> Result;
};

/// Called on the thread that called Machine::run, one call at a time.
class Observer {
public:
  virtual ~Observer() = default;
  virtual void commit(const Commit &) {}
  virtual void trap(const Trap &) {}
};

} // namespace vorion::isasim
