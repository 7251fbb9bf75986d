#include "isasim/Shape.h"

#include <utility>

using std::swap;

static std::string twice(std::string Text) {
  std::string Moved = std::move(Text);
  return Moved + Text;
}

std::string use() { return nameOf(twice("a")); }
