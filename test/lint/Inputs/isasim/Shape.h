#pragma once
#include <optional>
#include <string>

struct Shape {
  std::optional<int> Part{};
};

inline std::string nameOf(const std::string name) { return name; }
