#include "device/Launcher.h"

#include "device/Kernels.h"
#include "io/Hash.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Environment.h"
#include "vorion/support/File.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace vorion::splat {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point Start) {
  return std::chrono::duration<double>(Clock::now() - Start).count();
}

/// What the compiler is told.
std::string optionsOf(const ProgramSpec &Spec) {
  std::string Options;
  for (const std::string &Define : Spec.Defines)
    Options += (Options.empty() ? "-D" : " -D") + Define;
  return Options;
}

/// From \p Words in \p Log to the end of the line; empty if it lacks them.
std::string lineFrom(std::string_view Words, const std::string &Log) {
  const std::size_t At = Log.find(Words);
  return At == std::string::npos ? std::string()
                                 : Log.substr(At, Log.find('\n', At) - At);
}

/// The file that kept program \p Name from being compiled, if \p Log tells of
/// one: the platform's of its cache, clang's of any other. Its source may be
/// good.
std::optional<Error> fileError(const std::string &Name,
                               const std::string &Log) {
  if (std::string Cache = lineFrom(CL_KERNEL_CACHE_PROBLEM_VORION, Log);
      !Cache.empty())
    return Error{"", std::move(Cache)};
  if (const std::string NoCompiler =
          lineFrom("cannot find bin/vorion-compiler", Log);
      !NoCompiler.empty())
    return Error{"",
                 fmt::format("kernel program '{}' cannot be compiled: {} {}",
                             Name, NoCompiler, SeeDoctor)};
  constexpr std::string_view Missing = "'vorion.h' file not found";
  for (const std::string_view Words :
       {std::string_view("cannot open file '"),
        std::string_view("error reading '"), Missing}) {
    const std::string Unread = lineFrom(Words, Log);
    if (Unread.empty())
      continue;
    const char *Root =
        Words == Missing ? environmentVariable("VORION_ROOT") : nullptr;
    return Error{
        "",
        fmt::format("kernel program '{}' cannot be compiled: {}, "
                    "expected readable files{} {}",
                    Name, Unread,
                    Root ? fmt::format(" below VORION_ROOT, '{}'", Root) : "",
                    SeeDoctor)};
  }
  return std::nullopt;
}

double mebibytes(uint64_t Bytes) {
  return static_cast<double>(Bytes) / (1024.0 * 1024.0);
}

} // namespace

Launcher::Launcher(const Device &D, std::string Folder,
                   std::function<void(std::string_view)> Listener,
                   ProgramCache *Shared)
    : Dev(D), KernelFolder(std::move(Folder)), Progress(std::move(Listener)),
      Shared(Shared) {}

void Launcher::endStage() {
  if (!Stages.empty())
    Stages.back().Seconds = secondsSince(StageStart);
}

void Launcher::beginStage(Stage Kind) {
  if (Failure)
    return;
  endStage();
  Stages.push_back({Kind, 0, {}, 0, 0});
  StageStart = Clock::now();
  if (Progress)
    Progress(name(Kind));
}

std::vector<StageReport> Launcher::takeStages() {
  endStage();
  return std::exchange(Stages, {});
}

Expected<std::string> Launcher::sourceOf(const ProgramSpec &Spec) const {
  // No operation may be fused or reordered: the paths, the reference and the
  // rasterizer round alike (docs/abi.md).
  const auto Text = programText(Spec.File, KernelFolder);
  return Text ? "#pragma OPENCL FP_CONTRACT OFF\n" + *Text : Text;
}

std::string Launcher::keyOf(const std::string &Source,
                            const std::string &Options) const {
  return fnv1a64(fmt::format("{}\n{}\n{}\n{}", Dev.name(), Dev.version(),
                             Options, Source));
}

bool Launcher::wasBuilt(const ProgramSpec &Spec) const {
  const auto Source = sourceOf(Spec);
  return Source && Record.has(keyOf(*Source, optionsOf(Spec)));
}

void Launcher::recordBuilds() const {
  for (const std::string &Key : BuiltKeys)
    Record.add(Key);
}

std::unique_ptr<CompileNotice>
Launcher::noticeOf(const std::string &What,
                   std::function<bool()> IsCompiling) const {
  return Progress
             ? std::make_unique<CompileNotice>(What, std::move(IsCompiling))
             : nullptr;
}

void Launcher::build(const ProgramSpec &Spec) {
  if (Failure)
    return;
  auto Source = sourceOf(Spec);
  if (!Source) {
    Failure = Source.error();
    return;
  }
  const std::string Options = optionsOf(Spec);
  if (Shared) {
    const auto Built = Shared->find({*Source, Options});
    if (Built != Shared->end()) {
      Programs[Spec.File] = Built->second;
      return;
    }
  }
  cl_int Status = CL_SUCCESS;
  cl::Program Program(Dev.context(), *Source, false, &Status);
  if (Status == CL_SUCCESS) {
    const auto Notice = noticeOf(Spec.name(), [] { return true; });
    Status = Program.build(Dev.handle(), Options.c_str());
  }
  if (Status != CL_SUCCESS) {
    if (Status == CL_OUT_OF_HOST_MEMORY) {
      Failure = clError("compiling kernel program " + Spec.name(), Status);
      return;
    }
    BuildLog = Program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(Dev.handle());
    if (auto File = fileError(Spec.name(), BuildLog)) {
      Failure = std::move(File);
      BuildLog.clear(); // it says the same
      return;
    }
    // Sources of the user's folder are input; our own must compile anywhere.
    Failure =
        Error{KernelFolder,
              fmt::format("kernel program '{}' does not compile for {} "
                          "({}), expected valid OpenCL C",
                          Spec.name(), Dev.name(), statusName(Status)),
              KernelFolder.empty() ? ExitCode::Internal : ExitCode::InputFile};
    return;
  }
  Programs[Spec.File] = Program;
  BuiltKeys.push_back(keyOf(*Source, Options));
  if (Shared)
    Shared->emplace(std::pair(std::move(*Source), Options), Program);
}

void Launcher::launch(const cl::Kernel &K, const std::string &Name,
                      const cl::NDRange &Global, const cl::NDRange &Local) {
  // OpenCL 1.2 has no launches of nothing.
  if (std::any_of(Global.get(), Global.get() + Global.dimensions(),
                  [](std::size_t Items) { return Items == 0; }))
    return;
  const Clock::time_point Start = Clock::now();
  cl::Event Done;
  cl_int Status = Dev.queue(Profiled).enqueueNDRangeKernel(
      K, cl::NullRange, Global, Local, before(), &Done);
  if (Status != CL_SUCCESS) {
    Failure = memoryError("starting kernel " + Name, Status);
    return;
  }
  setLast(Done);
  {
    // A kernel is compiled when it is started first; then it runs.
    std::unique_ptr<CompileNotice> Notice;
    if (Started.insert(Name).second)
      Notice = noticeOf(Name, [&Done] {
        return Done.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>() > CL_RUNNING;
      });
    Status = Done.wait();
  }
  const auto Outcome = Done.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>();
  if (Status != CL_SUCCESS || Outcome < 0) {
    Failure = launchError(Name, Outcome < 0 ? Outcome : Status);
    return;
  }
  const double Seconds = secondsSince(Start);
  auto Time = Dev.timeReport(Done);
  if (!Time) {
    Failure = Time.error();
    return;
  }
  if (*Time && !TimeChecked && Dev.timeCheck()) {
    TimeChecked = true;
    if (const auto Fits = Dev.timeCheck()(**Time); !Fits) {
      Failure = Fits.error();
      return;
    }
  }
  account({Name, 1, Seconds, Dev.counters(Done), std::move(*Time)});
}

/// Adds the remedy if device memory is exhausted.
Error Launcher::memoryError(std::string_view What, cl_int Status) const {
  Error E = clError(What, Status);
  if (E.Code == ExitCode::LimitReached && Status != CL_OUT_OF_HOST_MEMORY)
    E.What += ", expected " + Remedy;
  return E;
}

Error Launcher::launchError(const std::string &Name, cl_int Status) const {
  const std::string Message = Dev.takeMessage();
  // Compiled when it is started: what is wrong are files, not the kernel.
  if (Status == CL_OUT_OF_HOST_MEMORY && !Message.empty())
    return Error{"", Message};
  if (!Message.empty())
    printNote(fmt::format("vorion: error: {}\n", Message));
  if (Status == CL_MEM_OBJECT_ALLOCATION_FAILURE)
    return memoryError("running kernel " + Name, Status);
  return Error{"",
               fmt::format("kernel '{}' failed on {} ({}), expected it to "
                           "complete",
                           Name, Dev.name(), statusName(Status)),
               ExitCode::Trap};
}

void Launcher::account(KernelReport Report) {
  std::vector<KernelReport> &Kernels = Stages.back().Kernels;
  const auto Known =
      std::ranges::find(Kernels, Report.Name, &KernelReport::Name);
  if (Known == Kernels.end()) {
    Kernels.push_back(std::move(Report));
    return;
  }
  ++Known->Launches;
  Known->Seconds += Report.Seconds;
  if (Known->Counters && Report.Counters)
    *Known->Counters += *Report.Counters;
  if (Known->Time && Report.Time)
    *Known->Time += *Report.Time;
  else
    Known->Time.reset();
}

namespace {

/// Told by OpenCL when a buffer is gone.
struct Release {
  std::shared_ptr<std::atomic<uint64_t>> InUse;
  uint64_t Bytes;
};
void CL_CALLBACK releaseBuffer(cl_mem /*Buffer*/, void *Data) {
  const std::unique_ptr<Release> R(static_cast<Release *>(Data));
  *R->InUse -= R->Bytes;
}

/// The remedies if the device does not have \p Bytes; one is \p Remedy.
std::string remedyFor(uint64_t Bytes, const std::string &Remedy) {
  // The platform keeps 1/32 of the machine's memory for launches.
  const uint64_t Wanted = Bytes / 31 * 32;
  return Wanted >> 32
             ? fmt::format("expected {}, because a device's addresses have 32 "
                           "bits",
                           Remedy)
             : fmt::format("expected {}, or at least {} as global_bytes of "
                           "VORION_CONFIG",
                           Remedy, ((Wanted >> 20) + 1) << 20);
}

} // namespace

cl::Buffer Launcher::allocate(std::string_view What, uint64_t Bytes) {
  if (Failure)
    return {};
  // OpenCL has no empty buffers.
  const uint64_t Size = std::max<uint64_t>(Bytes, 4);
  if (Size > Dev.largestAllocation() || *InUse + Size > Dev.globalBytes()) {
    Failure = Error{
        "",
        fmt::format("the {} need {:.1f} MiB in addition to {:.1f} MiB in use, "
                    "but {} has {:.1f} MiB of memory, at most {:.1f} MiB for "
                    "one buffer, {}",
                    What, mebibytes(Size), mebibytes(*InUse), Dev.name(),
                    mebibytes(Dev.globalBytes()),
                    mebibytes(Dev.largestAllocation()),
                    remedyFor(*InUse + Size, Remedy)),
        ExitCode::LimitReached};
    return {};
  }
  cl_int Status = CL_SUCCESS;
  cl::Buffer B(Dev.context(), CL_MEM_READ_WRITE, Size, nullptr, &Status);
  if (Status != CL_SUCCESS) {
    Failure = memoryError(
        fmt::format("allocating {:.1f} MiB for the {}", mebibytes(Size), What),
        Status);
    return {};
  }
  MostBytes = std::max(MostBytes, *InUse += Size);
  auto R = std::make_unique<Release>(Release{InUse, Size});
  if (B.setDestructorCallback(releaseBuffer, R.get()) == CL_SUCCESS)
    R.release(); // NOLINT(bugprone-unused-return-value): the callback's now
  return B;
}

void Launcher::countCopy(uint64_t Bytes) {
  ++Stages.back().Copies;
  Stages.back().CopiedBytes += Bytes;
}

void Launcher::checkCopy(std::string_view What, std::string_view Way,
                         cl_int Status) {
  if (Status != CL_SUCCESS)
    Failure = memoryError(
        fmt::format("copying the {} {} the device", What, Way), Status);
}

void Launcher::write(std::string_view What, const cl::Buffer &To,
                     const void *From, uint64_t Bytes) {
  if (Failure || Bytes == 0)
    return;
  countCopy(Bytes);
  cl::Event Done;
  checkCopy(What, "to",
            Dev.queue().enqueueWriteBuffer(To, CL_TRUE, 0, Bytes, From,
                                           before(), &Done));
  setLast(Done);
}

void Launcher::read(std::string_view What, void *To, const cl::Buffer &From,
                    uint64_t Bytes, uint64_t Offset) {
  if (Failure || Bytes == 0)
    return;
  countCopy(Bytes);
  cl::Event Done;
  checkCopy(What, "from",
            Dev.queue().enqueueReadBuffer(From, CL_TRUE, Offset, Bytes, To,
                                          before(), &Done));
  setLast(Done);
}

cl_int Launcher::mapped(const cl::Buffer &B, uint64_t Words,
                        const std::function<void(std::span<float>)> &Use) {
  countCopy(4 * Words);
  const cl::CommandQueue &Queue = Dev.queue();
  cl_int Status = CL_SUCCESS;
  void *const At =
      Queue.enqueueMapBuffer(B, CL_TRUE, CL_MAP_WRITE_INVALIDATE_REGION, 0,
                             4 * Words, before(), nullptr, &Status);
  if (Status != CL_SUCCESS)
    return Status;
  Use({static_cast<float *>(At), Words});
  cl::Event Done;
  Status = Queue.enqueueUnmapMemObject(B, At, nullptr, &Done);
  if (Status != CL_SUCCESS)
    return Status;
  setLast(Done);
  return Done.wait();
}

void Launcher::writeInPlace(std::string_view What, const cl::Buffer &To,
                            uint64_t Words,
                            const std::function<void(std::span<float>)> &Fill) {
  if (!Failure && Words != 0)
    checkCopy(What, "to", mapped(To, Words, Fill));
}

void Launcher::readInPlace(
    std::string_view What, const cl::Buffer &From, uint64_t Words,
    const std::function<void(std::span<const float>)> &Use) {
  finishReading(startReading(What, From, Words), Use);
}

PendingRead Launcher::startReading(std::string_view What,
                                   const cl::Buffer &From, uint64_t Words) {
  PendingRead Read{std::string(What), From, {}, nullptr, Words};
  if (Failure || Words == 0)
    return Read;
  countCopy(4 * Words);
  cl_int Status = CL_SUCCESS;
  Read.At = static_cast<const float *>(Dev.copyQueue().enqueueMapBuffer(
      From, CL_FALSE, CL_MAP_READ, 0, 4 * Words, before(), &Read.Done,
      &Status));
  checkCopy(What, "from", Status);
  return Read;
}

void Launcher::finishReading(
    const PendingRead &Read,
    const std::function<void(std::span<const float>)> &Use) {
  if (Failure || !Read.At)
    return;
  cl_int Status = Read.Done.wait();
  if (Status == CL_SUCCESS) {
    Use({Read.At, Read.Words});
    cl::Event Done;
    Status = Dev.copyQueue().enqueueUnmapMemObject(
        Read.From, const_cast<float *>(Read.At), nullptr, &Done);
    if (Status == CL_SUCCESS)
      Status = Done.wait();
  }
  checkCopy(Read.What, "from", Status);
}

void Launcher::settle() {
  if (!Failure)
    checkCopy("data", "to", Dev.queue().finish());
}

} // namespace vorion::splat
