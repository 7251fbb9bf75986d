/// One device of the platform.
#pragma once

#include "CommandOrder.h"
#include "KernelCache.h"
#include "Opening.h"
#include "Worker.h"

#include <string>

namespace vorion {

struct VorionDevice {
  explicit VorionDevice(Machine Opened)
      : Opened(std::move(Opened)), Kernels(this->Opened.get()),
        Thread(this->Opened.get(), Kernels) {}
  Machine Opened;
  vx_device_info Info{};
  std::string BuildHash;
  KernelCache Kernels;
  HostOrder Host;
  Worker Thread;
};

inline VorionDevice &deviceOf(cl_device_id Device) {
  return *static_cast<VorionDevice *>(Device->data);
}

} // namespace vorion
