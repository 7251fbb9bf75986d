#include "device/OpenCl.h"

#include <array>
#include <fmt/format.h>
#include <utility>

namespace vorion::splat {

std::string statusName(cl_int Status) {
  static constexpr auto Names =
      std::to_array<std::pair<cl_int, std::string_view>>({
          {CL_DEVICE_NOT_FOUND, "CL_DEVICE_NOT_FOUND"},
          {CL_DEVICE_NOT_AVAILABLE, "CL_DEVICE_NOT_AVAILABLE"},
          {CL_COMPILER_NOT_AVAILABLE, "CL_COMPILER_NOT_AVAILABLE"},
          {CL_MEM_OBJECT_ALLOCATION_FAILURE,
           "CL_MEM_OBJECT_ALLOCATION_FAILURE"},
          {CL_OUT_OF_RESOURCES, "CL_OUT_OF_RESOURCES"},
          {CL_OUT_OF_HOST_MEMORY, "CL_OUT_OF_HOST_MEMORY"},
          {CL_BUILD_PROGRAM_FAILURE, "CL_BUILD_PROGRAM_FAILURE"},
          {CL_INVALID_BUFFER_SIZE, "CL_INVALID_BUFFER_SIZE"},
          {CL_INVALID_BUILD_OPTIONS, "CL_INVALID_BUILD_OPTIONS"},
          {CL_INVALID_KERNEL_ARGS, "CL_INVALID_KERNEL_ARGS"},
          {CL_INVALID_WORK_GROUP_SIZE, "CL_INVALID_WORK_GROUP_SIZE"},
          {CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST,
           "CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST"},
      });
  for (const auto &[Code, Name] : Names)
    if (Code == Status)
      return std::string(Name);
  return fmt::format("OpenCL error {}", Status);
}

Error clError(std::string_view What, cl_int Status) {
  const bool NoMemory = Status == CL_MEM_OBJECT_ALLOCATION_FAILURE ||
                        Status == CL_OUT_OF_RESOURCES ||
                        Status == CL_OUT_OF_HOST_MEMORY ||
                        Status == CL_INVALID_BUFFER_SIZE;
  return Error{"",
               fmt::format("{} failed: {}{}", What, statusName(Status),
                           !NoMemory ? ""
                           : Status == CL_OUT_OF_HOST_MEMORY
                               ? ", the host is out of memory"
                               : ", the device is out of memory"),
               NoMemory ? ExitCode::LimitReached : ExitCode::Internal};
}

} // namespace vorion::splat
