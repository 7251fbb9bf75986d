/// The controller's own order of requests.
#pragma once

#include "vorion/isasim/Policies.h"

namespace vorion::isasim::dram {

/// First ready, first come first served: of the requests whose next command may
/// be issued now, the oldest goes first, whatever that command is.
class FrFcfs final : public DramScheduler {
public:
  // A controller spends its time here, so that a candidate is one number: when
  // it can begin, and below that its order.
  uint64_t rank(const DramCandidate &C) const override {
    constexpr unsigned OrderBits = 38;
    return C.Ticks << OrderBits | C.Order;
  }
  bool capsRows() const override { return true; }
};

} // namespace vorion::isasim::dram
