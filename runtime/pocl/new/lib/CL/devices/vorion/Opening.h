/// How the platform's machines are opened: with the options that a program
/// gave, and who is told if one cannot be.
#pragma once

#include "vorion.h"

#include <CL/cl_vorion.h>
#include <vorion/runtime.h>

#include <memory>

namespace vorion {

struct DeviceCloser {
  void operator()(vx_device *Device) const;
};
using Machine = std::unique_ptr<vx_device, DeviceCloser>;

/// clOpenDevicesVORION of CL/cl_vorion.h.
cl_int CL_API_CALL openDevices(cl_platform_id Platform, cl_uint NumOptions,
                               const cl_option_vorion *Options, size_t Size,
                               char *Problem);

/// A machine, \p Config being empty or what VORION_CONFIG is without an option
/// of that name. Null: why has been told, and \p Status says what to return.
Machine openMachine(const char *Config, cl_int &Status);

/// Whether the devices have machines, all or none, for PoCL to look at.
cl_bool *availability();

/// Whether the program gave the devices options, rather than the environment.
bool hasOptionsOfProgram();

/// Whether the option \p Name, or else the environment's variable, is set.
bool isOptionSet(const char *Name);

} // namespace vorion
