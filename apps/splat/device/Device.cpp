#include "device/Device.h"

#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mutex>
#include <utility>
#include <vector>

namespace vorion::splat {

namespace {

struct Candidate {
  cl::Device Handle;
  std::string Name;
};

/// Opens the devices of \p P with \p Options if it is a Vorion platform. The
/// error says why it has none.
Expected<Success> openPlatform(const cl::Platform &P,
                               const DeviceOptions &Options) {
  const auto Open = reinterpret_cast<clOpenDevicesVORION_fn>(
      clGetExtensionFunctionAddressForPlatform(P(), "clOpenDevicesVORION"));
  if (!Open)
    return Success{};
  std::vector<cl_option_vorion> List;
  for (const auto &[Name, Text] : Options.commandLine())
    List.push_back({Name.c_str(), Text.c_str()});
  std::array<char, 4096> Problem{};
  const cl_int Status = Open(P(), static_cast<cl_uint>(List.size()),
                             List.data(), Problem.size(), Problem.data());
  if (Status == CL_SUCCESS)
    return Success{};
  if (Problem[0] == '\0')
    return clError("opening the Vorion device", Status);
  return Error{"", Options.inOurWords(Problem.data()),
               Status == CL_OUT_OF_HOST_MEMORY ? ExitCode::LimitReached
               : Status == CL_INVALID_PROPERTY ? ExitCode::InputFile
                                               : ExitCode::Usage};
}

/// All devices that can be opened; \p Problem is why a platform has none.
std::vector<Candidate> allDevices(const DeviceOptions &Options,
                                  std::optional<Error> &Problem) {
  std::vector<cl::Platform> Platforms;
  // No platform at all is an error code here and an empty list for us.
  if (cl::Platform::get(&Platforms) != CL_SUCCESS)
    return {};
  std::vector<Candidate> Found;
  for (const cl::Platform &P : Platforms) {
    if (auto Opened = openPlatform(P, Options); !Opened) {
      Problem = Opened.error();
      continue;
    }
    std::vector<cl::Device> Devices;
    if (P.getDevices(CL_DEVICE_TYPE_ALL, &Devices) != CL_SUCCESS)
      continue;
    for (const cl::Device &D : Devices)
      Found.push_back({D, D.getInfo<CL_DEVICE_NAME>()});
  }
  return Found;
}

/// Null if there is none, or if the one that was meant could not be opened:
/// \p IsBroken says that a platform has a problem.
const Candidate *choose(const std::vector<Candidate> &All,
                        const std::string &Wanted, bool IsBroken) {
  const std::string Name = Wanted.empty() ? "Vorion" : Wanted;
  for (const Candidate &C : All)
    if (C.Name.find(Name) != std::string::npos)
      return &C;
  return Wanted.empty() && !IsBroken && !All.empty() ? &All.front() : nullptr;
}

Error noDevice(const std::vector<Candidate> &All, const std::string &Wanted) {
  if (All.empty())
    return Error{
        "",
        fmt::format("no OpenCL device, expected one of a Vorion platform {}",
                    SeeDoctor)};
  std::vector<std::string> Names;
  Names.reserve(All.size());
  for (const Candidate &C : All)
    Names.push_back('"' + C.Name + '"');
  return Error{
      "",
      fmt::format("no name of an OpenCL device contains \"{}\", expected "
                  "part of one of {}",
                  Wanted, fmt::join(Names, ", ")),
      ExitCode::Usage};
}

} // namespace

void loadPlatforms() {
  std::vector<cl::Platform> Platforms;
  cl::Platform::get(&Platforms);
}

/// What the platform tells of commands that fail, on threads of its own.
struct Device::Messages {
  std::mutex Lock;
  std::string Last;

  static void CL_CALLBACK receive(const char *Text, const void * /*Status*/,
                                  std::size_t /*Bytes*/, void *Data) {
    auto &M = *static_cast<Messages *>(Data);
    const std::lock_guard Held(M.Lock);
    M.Last = Text;
  }
};

Device::Device() : Received(std::make_shared<Messages>()) {}

std::string Device::takeMessage() const {
  const std::lock_guard Held(Received->Lock);
  return std::exchange(Received->Last, {});
}

Expected<Device> Device::open(const std::string &Wanted,
                              const DeviceOptions &Options) {
  std::optional<Error> Problem;
  const std::vector<Candidate> All = allDevices(Options, Problem);
  const Candidate *Chosen = choose(All, Wanted, Problem.has_value());
  if (!Chosen)
    return Problem ? *Problem : noDevice(All, Wanted);

  Device D;
  D.Options = Options;
  D.Handle = Chosen->Handle;
  D.Name = Chosen->Name;
  D.ComputeUnits = D.Handle.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  D.GlobalBytes = D.Handle.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  D.LargestAllocation = D.Handle.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();

  cl_int Status = CL_SUCCESS;
  D.Context = cl::Context(D.Handle, nullptr, Messages::receive,
                          D.Received.get(), &Status);
  if (Status != CL_SUCCESS)
    return clError("creating a context on " + D.Name, Status);
  for (const auto &[Queue, Properties] :
       {std::pair(&D.Queue, cl::QueueProperties::None),
        std::pair(&D.CopyQueue, cl::QueueProperties::None),
        std::pair(&D.ProfiledQueue, cl::QueueProperties::Profiling)}) {
    *Queue = cl::CommandQueue(D.Context, D.Handle, Properties, &Status);
    if (Status != CL_SUCCESS)
      return clError("creating a queue on " + D.Name, Status);
  }

  // What getInfo() gives is an object or its number, by the header's version.
  const cl::Platform Platform(D.Handle.getInfo<CL_DEVICE_PLATFORM>());
  const auto Extensions = D.Handle.getInfo<CL_DEVICE_EXTENSIONS>();
  if (Extensions.find(CL_VORION_EXTENSION_NAME) != std::string::npos)
    D.EventInfo = reinterpret_cast<clGetEventInfoVORION_fn>(
        clGetExtensionFunctionAddressForPlatform(Platform(),
                                                 "clGetEventInfoVORION"));
  if (D.isVorion()) {
    // CL_DEVICE_PREFERRED_WORK_GROUP_SIZE_MULTIPLE, which OpenCL 1.2 lacks.
    constexpr cl_device_info GroupMultiple = 0x1067;
    std::size_t Lanes = 1;
    if (D.Handle.getInfo(GroupMultiple, &Lanes) == CL_SUCCESS)
      D.Lanes = static_cast<unsigned>(Lanes);
    cl_uint Warps = 1;
    if (D.Handle.getInfo(CL_DEVICE_WARPS_PER_CORE_VORION, &Warps) == CL_SUCCESS)
      D.WarpsPerCore = Warps;
    cl_uint Engines = 0;
    if (D.Handle.getInfo(CL_DEVICE_DMA_ENGINES_VORION, &Engines) == CL_SUCCESS)
      D.CopiesOverlap = Engines != 0;
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
