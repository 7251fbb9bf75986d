/// A queue in an order that nearly all come in.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace vorion::isasim {

/// What \p IsBefore puts first leaves first. Others than a heap, it looks at
/// one element, the last, where those that come are in order already.
template <typename Element, typename IsBefore> class TimeQueue {
public:
  bool empty() const { return First == All.size(); }
  size_t size() const { return All.size() - First; }
  const Element &front() const { return All[First]; }
  void pop() {
    ++First;
    // What has left makes room when it is much more than what is here.
    if (First > size() + Spare) {
      All.erase(All.begin(), All.begin() + static_cast<std::ptrdiff_t>(First));
      First = 0;
    }
  }
  /// An element of \p Values, which is made where it stays if it comes in
  /// order: the host would wait for one that it has to copy at once.
  template <typename... Value> void push(Value &&...Values) {
    All.emplace_back(std::forward<Value>(Values)...);
    for (size_t N = All.size() - 1;
         N != First && IsBefore()(All[N], All[N - 1]); --N)
      std::swap(All[N], All[N - 1]);
  }

private:
  static constexpr size_t Spare = 64;
  std::vector<Element> All;
  size_t First = 0;
};

} // namespace vorion::isasim
