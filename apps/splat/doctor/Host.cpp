#include "doctor/Host.h"

#include "vorion/support/File.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Trust.h"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <system_error>
#include <utility>

namespace vorion::splat {

namespace fs = std::filesystem;

static constexpr uint64_t MiB = uint64_t{1} << 20;
/// A render of the demo leaves some MiB of kernels and a picture.
static constexpr uint64_t LeastDisk = 100 * MiB;
/// The machine's memory by default; a run takes what a program uses of it.
static constexpr uint64_t LeastMemory = 1024 * MiB;

static std::string mebibytes(uint64_t Bytes) {
  return fmt::format("{} MiB", Bytes / MiB);
}

Diagnosis examineDisk(const std::string &Folder, uint64_t FreeBytes) {
  if (FreeBytes < LeastDisk)
    return {DiagnosisState::Fault, "disk",
            fmt::format("{} has {} free, expected {}", Folder,
                        mebibytes(FreeBytes), mebibytes(LeastDisk)),
            "delete files there, or use another disk"};
  return {DiagnosisState::Well, "disk",
          fmt::format("{} has {} free", Folder, mebibytes(FreeBytes)), ""};
}

Diagnosis examineDisk(const std::string &Folder) {
  std::error_code Failed;
  const fs::space_info Space = fs::space(Folder, Failed);
  if (Failed)
    return {DiagnosisState::Fault, "disk",
            fmt::format("{}: {}", Folder, Failed.message()),
            "work in a folder that you can read"};
  return examineDisk(Folder, Space.available);
}

Diagnosis examineMemory(uint64_t AvailableBytes) {
  if (AvailableBytes < LeastMemory)
    return {DiagnosisState::Fault, "memory",
            fmt::format("{} of main memory are available, expected {}, the "
                        "default memory of the machine",
                        mebibytes(AvailableBytes), mebibytes(LeastMemory)),
            "end other programs"};
  return {
      DiagnosisState::Well, "memory",
      fmt::format("{} of main memory are available", mebibytes(AvailableBytes)),
      ""};
}

Diagnosis examineMemory() {
  std::ifstream File("/proc/meminfo");
  for (std::string Word; File >> Word;) {
    uint64_t KiB = 0;
    if (Word == "MemAvailable:" && File >> KiB)
      return examineMemory(KiB * 1024);
  }
  return {DiagnosisState::Note, "memory",
          "this system does not report the available memory", ""};
}

Diagnosis examineVectors() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    // What the translator needs besides (docs/adr/0008-translator.md).
    if (__builtin_cpu_supports("avx512cd") &&
        __builtin_cpu_supports("avx512vpopcntdq"))
      return {DiagnosisState::Well, "vectors",
              "the processor has AVX-512, which the simulator uses", ""};
    return {DiagnosisState::Well, "vectors",
            "the processor has an early AVX-512: the simulator uses it for the "
            "rasterizers, and AVX2 for the cores",
            ""};
  }
  if (__builtin_cpu_supports("x86-64-v3"))
    return {DiagnosisState::Well, "vectors",
            "the processor has AVX2, which the simulator uses", ""};
  return {DiagnosisState::Note, "vectors",
          "the processor has no AVX2: results are the same, but the simulator "
          "is slower",
          ""};
#else
  return {DiagnosisState::Note, "vectors",
          "the processor is not an x86-64, the only one on which the simulator "
          "is tested",
          ""};
#endif
}

namespace {

struct Contents {
  uint64_t Files = 0, Bytes = 0;
};

/// What can be counted: others may write there at the same time.
Contents contentsOf(const std::string &Folder) {
  Contents C;
  std::error_code Failed;
  for (fs::recursive_directory_iterator It(Folder, Failed), End;
       !Failed && It != End; It.increment(Failed)) {
    std::error_code Gone;
    if (const auto Size = It->file_size(Gone); !Gone) {
      ++C.Files;
      C.Bytes += Size;
    }
  }
  return C;
}

} // namespace

static std::string sizeText(const std::string &Folder) {
  const Contents C = contentsOf(Folder);
  return fmt::format("has {}, {}", counted(C.Files, "file"),
                     mebibytes(C.Bytes));
}

Diagnoses examineCache(const KernelCacheFolder &Cache) {
  const auto Said = [](DiagnosisState State, std::string Text) {
    return Diagnosis{
        State, "kernel cache", std::move(Text),
        State == DiagnosisState::Well
            ? ""
            : "set POCL_CACHE_DIR to a folder that only you can write"};
  };
  if (!Cache.Problem.empty())
    return {Said(DiagnosisState::Fault, Cache.Problem)};
  Diagnoses Found;
  for (const std::string &Why : Cache.PassedOver)
    Found.push_back(Said(DiagnosisState::Note, Why));
  if (Cache.Path.empty())
    Found.push_back(Said(DiagnosisState::Note,
                         "no cache folder for compiled kernels, so "
                         "every program compiles its own again"));
  else if (auto Writable = checkWritable(Cache.Path + "/doctor"); !Writable)
    Found.push_back(
        Said(DiagnosisState::Fault,
             fmt::format("{}: {}", Cache.Path, Writable.error().What)));
  else
    Found.push_back(Said(DiagnosisState::Well,
                         fmt::format("{} can be written, and {}", Cache.Path,
                                     sizeText(Cache.Path))));
  return Found;
}

Diagnosis examineSystemCache(const std::string &Folder) {
  Diagnosis Found{DiagnosisState::Well, "system cache", "", ""};
  const auto Fault = [&Found](std::string Text, std::string Fix) {
    Found.State = DiagnosisState::Fault;
    Found.Text = std::move(Text);
    Found.Fix = std::move(Fix);
    return Found;
  };
  std::error_code Failed;
  if (!fs::exists(Folder, Failed)) {
    Found.Text = fmt::format(
        "{} does not exist; root can create it for all users", Folder);
    return Found;
  }
  if (std::string Why = whyUntrusted(Folder, 0); !Why.empty())
    return Fault(fmt::format("{}, so {} is not read", Why, Folder),
                 "make root its owner, and writable only by root");
  if (fs::directory_iterator Unread(Folder, Failed); Failed)
    return Fault(fmt::format("{}: {}", Folder, Failed.message()),
                 fmt::format("type, as root: chmod -R a+rX {}", Folder));
  Found.Text = fmt::format("{} {}", Folder, sizeText(Folder));
  return Found;
}

} // namespace vorion::splat
