#include "timing/policy/Policy.h"

#include <mutex>

namespace vorion::isasim {

PolicyMakers &pluggedPolicies() {
  static PolicyMakers Makers;
  return Makers;
}

// Machines of a process may run at the same time.
static std::mutex Lock;
static std::string Fault;

void notePolicyFault(std::string What) {
  const std::scoped_lock Locked(Lock);
  if (Fault.empty())
    Fault = std::move(What);
}

std::string takePolicyFault() {
  const std::scoped_lock Locked(Lock);
  return std::exchange(Fault, {});
}

} // namespace vorion::isasim
