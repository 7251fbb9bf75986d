/// Parallel loops over the host's processors.
#pragma once

#include "vorion/support/HostProcessors.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace vorion {

/// Calls \p Work(I) once for each I below \p Count, on one thread per
/// processor, including the calling thread. The calls must be independent,
/// otherwise the result would depend on the host. If calls throw, one of the
/// exceptions is rethrown, and calls that have not started are skipped.
/// (reference/ has its own loop, because it does not depend on other
/// components.)
template <typename Function>
void inParallel(std::size_t Count, const Function &Work) {
  std::atomic<std::size_t> Next = 0;
  std::once_flag Once;
  std::exception_ptr First;
  const auto Share = [&] {
    try {
      for (std::size_t I = Next++; I < Count; I = Next++)
        Work(I);
    } catch (...) {
      std::call_once(Once, [&] { First = std::current_exception(); });
      Next = Count;
    }
  };
  const std::size_t Threads = std::min<std::size_t>(Count, hostProcessors());
  {
    std::vector<std::jthread> Others;
    for (std::size_t T = 1; T < Threads; ++T)
      Others.emplace_back(Share);
    Share();
  }
  if (First)
    std::rethrow_exception(First);
}

/// The same for chunks of at most \p Each consecutive indices:
/// \p Work(First, End).
template <typename Function>
void inParallelParts(std::size_t Count, std::size_t Each,
                     const Function &Work) {
  inParallel((Count + Each - 1) / Each, [&](std::size_t Part) {
    Work(Part * Each, std::min(Count, (Part + 1) * Each));
  });
}

} // namespace vorion
