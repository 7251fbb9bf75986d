/// Work that is shared among the host's processors.
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

/// Calls \p Work(I) once for each I below \p Count, on one thread a processor,
/// of which the caller's is one. The calls must not depend on each other, or
/// the result would depend on the host. If some of them throw, one of their
/// exceptions is the caller's, and calls that had not begun then are left out.
/// (reference/ has a loop of its own, because it uses nothing of ours.)
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

/// The same for parts of at most \p Each consecutive numbers:
/// \p Work(First, End).
template <typename Function>
void inParallelParts(std::size_t Count, std::size_t Each,
                     const Function &Work) {
  inParallel((Count + Each - 1) / Each, [&](std::size_t Part) {
    Work(Part * Each, std::min(Count, (Part + 1) * Each));
  });
}

} // namespace vorion
