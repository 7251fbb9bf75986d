/// A queue in an order that nearly all come in.
#pragma once

#include <cstddef>
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
    // What has left makes room when it is more than what is here.
    if (First > size()) {
      All.erase(All.begin(), All.begin() + static_cast<std::ptrdiff_t>(First));
      First = 0;
    }
  }
  void push(const Element &E) {
    auto Position = All.end();
    const auto Front = All.begin() + static_cast<std::ptrdiff_t>(First);
    while (Position != Front && IsBefore()(E, *(Position - 1)))
      --Position;
    All.insert(Position, E);
  }

private:
  std::vector<Element> All;
  size_t First = 0;
};

} // namespace vorion::isasim
