#include "Opening.h"

#include "vorion/support/Environment.h"

extern "C" {
#include "devices.h"
#include "pocl_util.h"

// clCreateContext.c has these.
extern pocl_lock_t pocl_context_handling_lock;
extern unsigned cl_context_count;
}

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace vorion {

namespace {

using Options = std::vector<std::pair<std::string, std::string>>;

std::mutex CallLock; ///< one call of openDevices() at a time

std::mutex Lock; ///< guards what follows
Options Given;
unsigned OpenMachines = 0;
/// What a call of openDevices() will return instead of printing it.
struct Failure {
  cl_int Status = CL_SUCCESS;
  std::string Text;
};
Failure *Caller = nullptr;

cl_int statusOf(vx_status Status) {
  switch (Status) {
  case VX_OK:
    return CL_SUCCESS;
  case VX_ERROR_ARGUMENT:
    return CL_INVALID_VALUE;
  case VX_ERROR_MEMORY:
    return CL_OUT_OF_HOST_MEMORY;
  case VX_ERROR_FILE:
    return CL_INVALID_PROPERTY;
  default:
    return CL_DEVICE_NOT_AVAILABLE;
  }
}

void tell(cl_int Status, const char *Text) {
  static std::string Printed;
  if (Caller)
    *Caller = {Status, Text};
  // Loaders and programs look for devices several times.
  else if (std::exchange(Printed, Text) != Text)
    fprintf(stderr, "vorion: error: %s\n", Text);
}

/// \p F to the caller of openDevices().
cl_int answer(const Failure &F, size_t Size, char *Problem) {
  if (Problem && Size > 0) {
    const size_t Bytes = std::min(F.Text.size(), Size - 1);
    memcpy(Problem, F.Text.data(), Bytes);
    Problem[Bytes] = '\0';
  }
  return F.Status;
}

cl_bool AreAvailable = CL_TRUE;

/// Closes the machines, unless a context may use them. PoCL then opens them
/// when it next looks for devices.
bool closeUnused() {
  POCL_LOCK(pocl_context_handling_lock);
  const bool IsUnused = cl_context_count == 0;
  if (IsUnused) {
    AreAvailable = CL_TRUE; // PoCL passes over those that are not
    pocl_uninit_devices();
  }
  POCL_UNLOCK(pocl_context_handling_lock);
  return IsUnused;
}

/// Makes \p Wanted what machines are opened with; false if some are in use
/// with other options. Open ones may only have been looked at: of several
/// platforms, Debian's loader (ocl-icd) counts the devices to sort them.
bool prepare(Options Wanted, Failure &F) {
  bool Reopens = false;
  {
    const std::lock_guard Guard(Lock);
    if (OpenMachines > 0 && Wanted == Given)
      return true;
    Reopens = OpenMachines > 0 || !AreAvailable;
  }
  if (Reopens && !closeUnused())
    return false;
  const std::lock_guard Guard(Lock);
  Given = std::move(Wanted);
  Caller = &F;
  return true;
}

} // namespace

cl_bool *availability() { return &AreAvailable; }

void DeviceCloser::operator()(vx_device *Device) const {
  vx_device_close(Device);
  const std::lock_guard Guard(Lock);
  --OpenMachines;
}

cl_int CL_API_CALL openDevices(cl_platform_id Platform, cl_uint NumOptions,
                               const cl_option_vorion *List, size_t Size,
                               char *Problem) {
  const std::lock_guard Call(CallLock);
  Failure F;
  Options Wanted;
  for (cl_uint I = 0; I < NumOptions; ++I) {
    if (!List || !List[I].name || !List[I].text)
      return answer({CL_INVALID_VALUE, "an option without name or text"}, Size,
                    Problem);
    Wanted.emplace_back(List[I].name, List[I].text);
  }
  if (!prepare(std::move(Wanted), F))
    return answer({CL_INVALID_OPERATION, "the devices are in use with other "
                                         "options, expected one set of options "
                                         "for all contexts"},
                  Size, Problem);
  cl_uint Devices = 0;
  const cl_int Status = POname(clGetDeviceIDs)(Platform, CL_DEVICE_TYPE_ALL, 0,
                                               nullptr, &Devices);
  const std::lock_guard Guard(Lock);
  Caller = nullptr;
  if (F.Status == CL_SUCCESS)
    F.Status = Status;
  return answer(F, Size, Problem);
}

Machine openMachine(const char *Config, cl_int &Status) {
  const std::lock_guard Guard(Lock);
  std::vector<vx_option> List;
  if (Config && *Config)
    List.push_back({"VORION_CONFIG", Config});
  // The last one of a name counts.
  for (const auto &[Name, Text] : Given)
    List.push_back({Name.c_str(), Text.c_str()});
  vx_device *Opened = nullptr;
  Status = statusOf(vx_device_open_with(
      List.data(), static_cast<uint32_t>(List.size()), &Opened));
  if (Status != CL_SUCCESS) {
    tell(Status, vx_last_error());
    return nullptr;
  }
  ++OpenMachines;
  return Machine(Opened);
}

bool hasOptionsOfProgram() {
  const std::lock_guard Guard(Lock);
  return !Given.empty();
}

bool isOptionSet(const char *Name) {
  const std::lock_guard Guard(Lock);
  return std::any_of(Given.begin(), Given.end(),
                     [&](const auto &O) { return O.first == Name; }) ||
         environmentVariable(Name) != nullptr;
}

} // namespace vorion
