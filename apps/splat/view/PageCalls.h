/// Tracks the newest call of each page.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace vorion::splat {

/// The receiver of a response.
struct Asker {
  std::string Page; ///< a unique name
  /// Whether the receiver is gone; polled every few milliseconds.
  std::function<bool()> HasLeft;
};

/// A newer call of a page supersedes its earlier calls. Pages do not affect
/// each other.
class PageCalls {
public:
  class Call {
  public:
    bool isNewest() const { return Own == *Newest; }

  private:
    friend PageCalls;
    explicit Call(std::shared_ptr<std::atomic<uint64_t>> Of)
        : Newest(std::move(Of)), Own(++*Newest) {}
    std::shared_ptr<std::atomic<uint64_t>> Newest;
    uint64_t Own;
  };

  /// Starts a call of \p Page, which is the newest until the next one.
  Call begin(const std::string &Page);

private:
  std::mutex Lock;
  /// Counters of the pages with calls.
  std::map<std::string, std::weak_ptr<std::atomic<uint64_t>>> Counts;
};

} // namespace vorion::splat
