/// Which call of a page is its newest.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace vorion::splat {

/// Who waits for an answer.
struct Asker {
  std::string Page; ///< a name that no other page has
  /// Whether nobody waits any more; asked every few milliseconds.
  std::function<bool()> HasLeft;
};

/// A page that has asked for something newer does not want what it asked for
/// before. Pages do not hinder each other.
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

  /// The newest one of \p Page, until the next.
  Call begin(const std::string &Page);

private:
  std::mutex Lock;
  /// Of the pages that have calls.
  std::map<std::string, std::weak_ptr<std::atomic<uint64_t>>> Counts;
};

} // namespace vorion::splat
