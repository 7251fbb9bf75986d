#include "doctor/Host.h"

#include "vorion/support/File.h"
#include "vorion/support/Letters.h"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <system_error>

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
            "delete files there, or work on another disk"};
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
            fmt::format("{} of main memory are available, expected {}, which "
                        "the machine has by default",
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
          "this system does not say how much memory is available", ""};
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
            "the processor has an old AVX-512: the simulator uses it for the "
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
          "the processor is no x86-64, on which alone the simulator is tested",
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

Diagnosis examineCache(const std::string &Folder) {
  const std::string Mend = "set POCL_CACHE_DIR to a folder that you can write";
  if (Folder.empty())
    return {DiagnosisState::Note, "kernel cache",
            "no folder keeps compiled kernels, so every program compiles its "
            "own again",
            Mend};
  std::error_code Failed;
  fs::create_directories(Folder, Failed);
  if (Failed)
    return {DiagnosisState::Fault, "kernel cache",
            fmt::format("{}: {}", Folder, Failed.message()), Mend};
  if (auto Writable = checkWritable(Folder + "/doctor"); !Writable)
    return {DiagnosisState::Fault, "kernel cache",
            fmt::format("{}: {}", Folder, Writable.error().What), Mend};
  const Contents C = contentsOf(Folder);
  return {DiagnosisState::Well, "kernel cache",
          fmt::format("{} can be written, and has {}, {}", Folder,
                      counted(C.Files, "file"), mebibytes(C.Bytes)),
          ""};
}

} // namespace vorion::splat
