/// Transfers arrays of numbers to a device and back.
#pragma once

#include "device/Launcher.h"

#include <vector>

namespace vorion::splat {

template <typename T>
cl::Buffer upload(Launcher &L, const std::vector<T> &Values) {
  const cl::Buffer B = L.allocate("values", sizeof(T) * Values.size());
  L.write("values", B, Values.data(), sizeof(T) * Values.size());
  return B;
}

/// The first \p Count values of \p B; undefined if the launcher has failed.
template <typename T>
std::vector<T> download(Launcher &L, const cl::Buffer &B, std::size_t Count) {
  std::vector<T> Values(Count);
  L.read("values", Values.data(), B, sizeof(T) * Count);
  return Values;
}

} // namespace vorion::splat
