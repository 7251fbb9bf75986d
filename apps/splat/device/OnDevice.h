/// The fixture of kernel tests: a device, or a skip that is counted.
#pragma once

#include "device/Values.h"

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

  template <typename T = uint32_t>
  std::vector<T> download(Launcher &L, const cl::Buffer &B, std::size_t Count) {
    auto Values = splat::download<T>(L, B, Count);
    EXPECT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
    return Values;
  }

  std::optional<Device> Dev;
  std::mt19937 Random{7};
};

} // namespace vorion::splat
