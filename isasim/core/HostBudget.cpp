#include "core/HostBudget.h"

#include <fmt/format.h>

namespace vorion::isasim {

void HostBudget::beginRun() {
  Begin = std::chrono::steady_clock::now();
  StopRequested = false;
  Running = true;
}

double HostBudget::secondsSoFar() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - Begin)
      .count();
}

bool HostBudget::isOver() const {
  return StopRequested.load(std::memory_order_relaxed) || isLate();
}

std::string HostBudget::reason() const {
  if (StopRequested.load(std::memory_order_relaxed))
    return "stopped by the host program";
  if (isLate())
    return fmt::format("watchdog: the run took longer than {} s", Watchdog);
  return {};
}

} // namespace vorion::isasim
