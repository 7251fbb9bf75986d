#include "doctor/Platform.h"

#include "device/Device.h"
#include "doctor/Variables.h"
#include "vorion/support/Environment.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <iterator>
#include <string_view>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace vorion::splat {

namespace fs = std::filesystem;

/// The command that makes the tools and the device known, of the tree that this
/// program belongs to.
static std::string sourceEnvironment() {
  std::error_code Failed;
  const fs::path Tree =
      fs::read_symlink("/proc/self/exe", Failed).parent_path().parent_path();
  // An installed tree, and build/dev of a repository.
  for (const fs::path &Script :
       {Tree / "share" / "vorion" / "env.sh",
        Tree.parent_path().parent_path() / "scripts" / "env.sh"})
    if (fs::exists(Script, Failed))
      return fmt::format("type: . {}", Script.string());
  return "type: . scripts/env.sh";
}

/// What mends that no device opens by \p Options, of which \p Problem is said:
/// its first words name the variable, or the option that gave its text.
static std::string fixOfOpening(std::string_view Problem,
                                const DeviceOptions &Options) {
  for (const KnownVariable &K : knownVariables()) {
    const std::string Option = Options.giver(K.Name);
    if (!Option.empty() && Problem.starts_with(Option + ": "))
      return fmt::format("correct {}", Option);
    if (Problem.starts_with(K.Name))
      return fmt::format("unset {}, or correct it", K.Name);
  }
  return sourceEnvironment();
}

std::string vendorsPlace() {
  const char *Set = environmentVariable("OCL_ICD_VENDORS");
  return Set ? Set : "/etc/OpenCL/vendors";
}

static std::vector<fs::path> icdFiles(const fs::path &Place) {
  std::error_code Failed;
  if (Place.extension() == ".icd" && fs::is_regular_file(Place, Failed))
    return {Place};
  std::vector<fs::path> Files;
  for (fs::directory_iterator It(Place, Failed), End; !Failed && It != End;
       It.increment(Failed))
    if (It->path().extension() == ".icd")
      Files.push_back(It->path());
  std::ranges::sort(Files);
  return Files;
}

static bool isLibrary(const fs::path &File) {
  constexpr std::string_view Mark = "\x7f"
                                    "ELF";
  std::string Begin(Mark.size(), 0);
  std::ifstream(File).read(Begin.data(), std::ssize(Begin));
  return Begin == Mark;
}

Vendors examineVendors(const std::string &Place) {
  Vendors V{{DiagnosisState::Well, "platform", "", ""}, {}};
  const auto Fault = [&](std::string Text) {
    V.Found = {DiagnosisState::Fault, "platform", std::move(Text),
               sourceEnvironment()};
    return V;
  };
  std::error_code Failed;
  if (!fs::exists(Place, Failed))
    return Fault(fmt::format(
        "{} does not exist, so programs find no OpenCL platform", Place));
  if (fs::is_regular_file(Place, Failed) && isLibrary(Place)) {
    V.Libraries.push_back(Place);
    V.Found.Text = fmt::format("{} is a library", Place);
    return V;
  }
  for (const fs::path &File : icdFiles(Place)) {
    std::ifstream Text(File);
    std::string Library;
    if (!std::getline(Text, Library) || Library.empty())
      return Fault(fmt::format("{} does not name a library", File.string()));
    // A name without a folder is the dynamic linker's to find.
    if (Library.find('/') != std::string::npos && !fs::exists(Library, Failed))
      return Fault(fmt::format("{} names {}, which does not exist",
                               File.string(), Library));
    V.Libraries.push_back(Library);
  }
  if (V.Libraries.empty())
    return Fault(
        Place + (fs::is_directory(Place, Failed)
                     ? " has no file *.icd, so programs find no OpenCL platform"
                     : " is neither a folder, nor a file *.icd, nor a "
                       "library"));
  V.Found.Text =
      fmt::format("{} names {}", Place, fmt::join(V.Libraries, ", "));
  return V;
}

Diagnosis examineTools(const std::string &Root,
                       const std::vector<std::string> &Libraries) {
  std::vector<fs::path> Places;
  if (!Root.empty())
    Places.emplace_back(Root);
  else
    for (const std::string &Library : Libraries) {
      // As the platform goes up from its own file (Tools.cpp of the device).
      std::error_code Failed;
      fs::path Folder = fs::canonical(Library, Failed).parent_path();
      for (int Up = 0; Up < 4 && Folder.has_relative_path(); ++Up) {
        Places.push_back(Folder);
        Folder = Folder.parent_path();
      }
    }
  for (const fs::path &Place : Places) {
    const auto IsThere = [&](const char *Tool) {
      return access((Place / "bin" / Tool).c_str(), X_OK) == 0;
    };
    if (IsThere("vorion-compiler"))
      return {DiagnosisState::Well, "compiler",
              fmt::format("{} has vorion-compiler", (Place / "bin").string()),
              ""};
  }
  return {DiagnosisState::Fault, "compiler",
          Root.empty()
              ? "no folder above the platform's library has bin/vorion-compiler"
              : fmt::format("VORION_ROOT is {}, which has no "
                            "bin/vorion-compiler",
                            Root),
          sourceEnvironment()};
}

/// The signal that ends a process which looks for the devices of \p Library; 0
/// for none.
static int signalOf(const std::string &Library) {
  std::fflush(nullptr); // the child would write it again
  const pid_t Child = fork();
  if (Child == 0) {
    // What it says is no line of the doctor's.
    const int Nowhere = open("/dev/null", O_WRONLY);
    dup2(Nowhere, STDOUT_FILENO);
    dup2(Nowhere, STDERR_FILENO);
    setenv("OCL_ICD_VENDORS", Library.c_str(), 1);
    std::vector<cl::Platform> Platforms;
    cl::Platform::get(&Platforms);
    for (const cl::Platform &P : Platforms) {
      std::vector<cl::Device> Devices;
      P.getDevices(CL_DEVICE_TYPE_ALL, &Devices);
    }
    _exit(0);
  }
  int Status = 0;
  if (Child < 0 || waitpid(Child, &Status, 0) != Child)
    return 0;
  return WIFSIGNALED(Status) ? WTERMSIG(Status) : 0;
}

Diagnoses examineLibraries(const std::vector<std::string> &Libraries) {
  Diagnoses Found;
  for (const std::string &Library : Libraries)
    if (const int Signal = signalOf(Library); Signal != 0)
      Found.push_back(
          {DiagnosisState::Fault, "platform",
           fmt::format("{} crashes programs that query its devices ({})",
                       Library, strsignal(Signal)),
           fmt::format("{}, or remove the package of that library",
                       sourceEnvironment())});
  return Found;
}

namespace {

constexpr const char *Source = "kernel void doctor(global uint *out) {"
                               "  out[get_global_id(0)] = 3 * get_global_id(0);"
                               "}";
constexpr cl_uint Items = 64;

/// Why the kernel does not run; empty if it does.
std::string runKernel(const Device &D) {
  cl::Program Program(D.context(), Source);
  if (const cl_int Status = Program.build({D.handle()}); Status != CL_SUCCESS) {
    const auto Log = Program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(D.handle());
    return "does not compile: " +
           (Log.empty() ? statusName(Status) : Log.substr(0, Log.find('\n')));
  }
  std::array<cl_uint, Items> Values{};
  cl_int Status = CL_SUCCESS;
  const cl::Buffer Out(D.context(), CL_MEM_READ_WRITE, sizeof(Values), nullptr,
                       &Status);
  cl::Kernel Kernel(Program, "doctor");
  if (Status == CL_SUCCESS)
    Status = Kernel.setArg(0, Out);
  if (Status == CL_SUCCESS)
    Status = D.queue().enqueueNDRangeKernel(
        Kernel, cl::NullRange, cl::NDRange(Items), cl::NDRange(16));
  if (Status == CL_SUCCESS)
    Status = D.queue().enqueueReadBuffer(Out, CL_TRUE, 0, sizeof(Values),
                                         Values.data());
  if (Status != CL_SUCCESS) {
    const std::string Message = D.takeMessage();
    return "does not run: " + (Message.empty()
                                   ? statusName(Status)
                                   : Message.substr(0, Message.find('\n')));
  }
  for (cl_uint I = 0; I < Items; ++I)
    if (Values[I] != 3 * I)
      return fmt::format("computes 3 x {} as {}", I, Values[I]);
  return {};
}

} // namespace

Diagnoses examineDevice(const DeviceOptions &Options) {
  const auto D = Device::open("", Options);
  if (!D) {
    std::string Why = D.error().What;
    if (Why.ends_with(SeeDoctor))
      Why.resize(Why.size() - SeeDoctor.size() - 1);
    std::string Fix = fixOfOpening(Why, Options);
    return {{DiagnosisState::Fault, "device", std::move(Why), std::move(Fix)}};
  }
  if (!D->isVorion())
    return {{DiagnosisState::Fault, "device",
             fmt::format("the OpenCL device is \"{}\", not Vorion", D->name()),
             sourceEnvironment()}};
  Diagnoses Found{
      {DiagnosisState::Well, "device",
       fmt::format("\"{}\" with {} of {} and {} MiB of memory", D->name(),
                   counted(D->computeUnits(), "core"),
                   counted(D->lanes(), "lane"), D->globalBytes() >> 20),
       ""}};
  if (const std::string Problem = runKernel(*D); !Problem.empty())
    Found.push_back(
        {DiagnosisState::Fault, "kernel", "a small kernel " + Problem,
         "fix the problems above; if there are none, build or install "
         "again"});
  else
    Found.push_back(
        {DiagnosisState::Well, "kernel",
         "a small kernel compiles, runs and computes the right values", ""});
  return Found;
}

} // namespace vorion::splat
