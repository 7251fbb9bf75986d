/// What tests of kernels share: a device, or a counted reason to skip.
#pragma once

#include "device/Launcher.h"

#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <vector>

namespace vorion::splat {

class OnDevice : public testing::Test {
protected:
  void SetUp() override {
    auto Opened = Device::open("");
    if (!Opened)
      GTEST_SKIP() << "no OpenCL device";
    Dev.emplace(std::move(*Opened));
  }

  template <typename T>
  cl::Buffer upload(Launcher &L, const std::vector<T> &Values) {
    const cl::Buffer B = L.allocate("values", sizeof(T) * Values.size());
    L.write("values", B, Values.data(), sizeof(T) * Values.size());
    return B;
  }
  template <typename T = uint32_t>
  std::vector<T> download(Launcher &L, const cl::Buffer &B, std::size_t Count) {
    std::vector<T> Values(Count);
    L.read("values", Values.data(), B, sizeof(T) * Count);
    EXPECT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
    return Values;
  }

  std::optional<Device> Dev;
  std::mt19937 Random{7};
};

} // namespace vorion::splat
