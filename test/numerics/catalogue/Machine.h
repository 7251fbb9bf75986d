/// Renders cases on the OpenCL device, building each program once.
#pragma once

#include "HardCase.h"
#include "device/Launcher.h"

namespace vorion::test {

class Machine {
public:
  /// The device that `splat render` takes by default.
  static Expected<Machine> open(const splat::DeviceOptions &Options = {});

  /// \p KernelFolder as of `splat render --kernels`; empty for splat's own.
  /// \p Layers: with depths, normals and, where they can be, pixel lists.
  Expected<splat::RenderResult> render(const HardCase &C,
                                       const splat::RenderOptions &O,
                                       const std::string &KernelFolder,
                                       bool Layers = false);

  /// For what is not a picture, with the same kernels and programs kept.
  splat::Launcher launcher(const std::string &KernelFolder) {
    return {Dev, KernelFolder, {}, &Programs};
  }

private:
  explicit Machine(splat::Device D) : Dev(std::move(D)) {}

  splat::Device Dev;
  splat::ProgramCache Programs;
};

} // namespace vorion::test
