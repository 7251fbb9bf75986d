#include "view/PageCalls.h"

namespace vorion::splat {

PageCalls::Call PageCalls::begin(const std::string &Page) {
  const std::lock_guard Held(Lock);
  std::erase_if(Counts, [](const auto &Of) { return Of.second.expired(); });
  auto &Kept = Counts[Page];
  auto Count = Kept.lock();
  if (!Count)
    Kept = Count = std::make_shared<std::atomic<uint64_t>>(0);
  return Call(std::move(Count));
}

} // namespace vorion::splat
