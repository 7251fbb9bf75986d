#include "Device.h"

#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>
#include <vector>

namespace vorion::splat {

namespace {

struct Candidate {
  cl::Device Handle;
  std::string Name;
};

std::vector<Candidate> allDevices() {
  std::vector<cl::Platform> Platforms;
  // No platform at all is an error code here and an empty list for us.
  if (cl::Platform::get(&Platforms) != CL_SUCCESS)
    return {};
  std::vector<Candidate> Found;
  for (const cl::Platform &P : Platforms) {
    std::vector<cl::Device> Devices;
    if (P.getDevices(CL_DEVICE_TYPE_ALL, &Devices) != CL_SUCCESS)
      continue;
    for (const cl::Device &D : Devices)
      Found.push_back({D, D.getInfo<CL_DEVICE_NAME>()});
  }
  return Found;
}

const Candidate *choose(const std::vector<Candidate> &All,
                        const std::string &Wanted) {
  const std::string Name = Wanted.empty() ? "Vorion" : Wanted;
  for (const Candidate &C : All)
    if (C.Name.find(Name) != std::string::npos)
      return &C;
  return Wanted.empty() && !All.empty() ? &All.front() : nullptr;
}

Error noDevice(const std::vector<Candidate> &All, const std::string &Wanted) {
  const char *Config = std::getenv("VORION_CONFIG");
  if (All.empty() && Config && *Config)
    return Error{"", fmt::format("no OpenCL device, expected a valid "
                                 "VORION_CONFIG, which is \"{}\", and a Vorion "
                                 "platform (source scripts/env.sh)",
                                 Config)};
  if (All.empty())
    return Error{"", "no OpenCL device, expected one of a Vorion platform "
                     "(source scripts/env.sh)"};
  std::vector<std::string> Names;
  Names.reserve(All.size());
  for (const Candidate &C : All)
    Names.push_back('"' + C.Name + '"');
  return Error{"",
               fmt::format("no OpenCL device is named like \"{}\", expected "
                           "part of one of {}",
                           Wanted, fmt::join(Names, ", ")),
               ExitCode::Usage};
}

} // namespace

Expected<Device> Device::open(const std::string &Wanted) {
  const std::vector<Candidate> All = allDevices();
  const Candidate *Chosen = choose(All, Wanted);
  if (!Chosen)
    return noDevice(All, Wanted);

  Device D;
  D.Handle = Chosen->Handle;
  D.Name = Chosen->Name;
  D.ComputeUnits = D.Handle.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  D.GlobalBytes = D.Handle.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  D.LargestAllocation = D.Handle.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();

  cl_int Status = CL_SUCCESS;
  D.Context = cl::Context(D.Handle, nullptr, nullptr, nullptr, &Status);
  if (Status != CL_SUCCESS)
    return clError("creating a context on " + D.Name, Status);
  for (const auto &[Queue, Properties] :
       {std::pair(&D.Queue, cl::QueueProperties::None),
        std::pair(&D.ProfiledQueue, cl::QueueProperties::Profiling)}) {
    *Queue = cl::CommandQueue(D.Context, D.Handle, Properties, &Status);
    if (Status != CL_SUCCESS)
      return clError("creating a queue on " + D.Name, Status);
  }

  const auto Extensions = D.Handle.getInfo<CL_DEVICE_EXTENSIONS>();
  if (Extensions.find(CL_VORION_EXTENSION_NAME) != std::string::npos)
    D.EventInfo = reinterpret_cast<clGetEventInfoVORION_fn>(
        clGetExtensionFunctionAddressForPlatform(
            D.Handle.getInfo<CL_DEVICE_PLATFORM>(), "clGetEventInfoVORION"));
  if (D.isVorion()) {
    // CL_DEVICE_PREFERRED_WORK_GROUP_SIZE_MULTIPLE, which OpenCL 1.2 lacks.
    constexpr cl_device_info GroupMultiple = 0x1067;
    std::size_t Lanes = 1;
    if (D.Handle.getInfo(GroupMultiple, &Lanes) == CL_SUCCESS)
      D.Lanes = static_cast<unsigned>(Lanes);
  }
  return D;
}

std::string Device::version() const {
  const cl::Platform Platform(Handle.getInfo<CL_DEVICE_PLATFORM>());
  return fmt::format("{}; driver {}; {}", Handle.getInfo<CL_DEVICE_VERSION>(),
                     Handle.getInfo<CL_DRIVER_VERSION>(),
                     Platform.getInfo<CL_PLATFORM_VERSION>());
}

std::optional<KernelCounters> Device::counters(const cl::Event &Event) const {
  if (!EventInfo)
    return std::nullopt;
  KernelCounters C;
  for (const CounterInfo &Counter : KernelCounterTable) {
    cl_ulong Got = 0;
    if (EventInfo(Event(), Counter.Token, sizeof(Got), &Got, nullptr) !=
        CL_SUCCESS)
      return std::nullopt;
    C.*Counter.Member = Got;
  }
  return C;
}

Expected<std::optional<TimeReport>>
Device::timeReport(const cl::Event &Event) const {
  std::optional<TimeReport> None;
  std::size_t Bytes = 0;
  if (!EventInfo || EventInfo(Event(), CL_EVENT_TIME_REPORT_VORION, 0, nullptr,
                              &Bytes) != CL_SUCCESS)
    return None;
  std::string Text(Bytes, '\0');
  if (Bytes == 0 || EventInfo(Event(), CL_EVENT_TIME_REPORT_VORION, Bytes,
                              Text.data(), nullptr) != CL_SUCCESS)
    return None;
  Text.pop_back(); // the terminator
  if (Text.empty())
    return None;
  auto Report = parseTimeReport(Text);
  if (!Report)
    return Report.error();
  return std::optional(std::move(*Report));
}

} // namespace vorion::splat
