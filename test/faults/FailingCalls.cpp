// A library that LD_PRELOAD puts before libc: it makes one call of a program
// fail, as a full disk, a lost server or a machine without memory would.
//
// VORION_FAULT=KIND:N        the N-th call of KIND fails, once; 0 fails none
// VORION_FAULT_PROGRAM=NAME  of the program of this name; others run
// undisturbed VORION_FAULT_LOG=FILE      gets, when the program ends, a line
// "KIND COUNT" for
//                            every kind and, once a call failed, the line
//                            "failed PLACE ..." with the innermost callers
//
// With N = 0 and KIND = alloc the log has a line "place N" for each allocation
// of a place that had none before: callers' addresses decide what a place is.

#include "vorion/support/Hash.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>
#include <unwind.h>

namespace {

enum Kind { Open, Write, Close, Rename, Sync, Map, Alloc, Kinds };
constexpr std::array<const char *, Kinds> Names = {
    "open", "write", "close", "rename", "fsync", "mmap", "alloc"};
/// What the failing call says is wrong.
constexpr std::array<int, Kinds> Causes = {EMFILE, ENOSPC, EIO,   EXDEV,
                                           EIO,    ENOMEM, ENOMEM};

std::array<std::atomic<uint64_t>, Kinds> Counts;
bool IsOn = false;
Kind Wanted = Kinds;
uint64_t WantedNumber = 0;
int Log = -1;
/// What this library does itself is not counted.
thread_local bool IsInside = false;

struct Inside {
  bool WasInside = IsInside;
  Inside() { IsInside = true; }
  Inside(const Inside &) = delete;
  Inside &operator=(const Inside &) = delete;
  ~Inside() { IsInside = WasInside; }
};

void say(const char *Text, std::size_t Size) {
  if (Log >= 0)
    static_cast<void>(syscall(SYS_write, Log, Text, Size));
}

struct Callers {
  static constexpr std::size_t Most = 14;
  std::array<void *, Most> At{};
  std::size_t Count = 0;
};

_Unwind_Reason_Code addCaller(_Unwind_Context *Context, void *To) {
  auto &C = *static_cast<Callers *>(To);
  if (C.Count == Callers::Most)
    return _URC_END_OF_STACK;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): that is how it comes.
  C.At[C.Count++] = reinterpret_cast<void *>(_Unwind_GetIP(Context));
  return _URC_NO_REASON;
}

Callers callers() {
  Callers C;
  _Unwind_Backtrace(addCaller, &C);
  return C;
}

/// "splat+0x1234 libvorion-pocl.so+0x99 ...", without this library's own.
void printPlace() {
  const Callers C = callers();
  Dl_info Own{};
  dladdr(reinterpret_cast<void *>(&printPlace), &Own);
  std::array<char, 2048> Text{};
  std::size_t Size =
      static_cast<std::size_t>(snprintf(Text.data(), Text.size(), "failed"));
  for (std::size_t I = 0; I < C.Count && Size < Text.size() - 160; ++I) {
    Dl_info Info{};
    if (!dladdr(C.At[I], &Info) || !Info.dli_fname ||
        Info.dli_fbase == Own.dli_fbase)
      continue;
    const char *Slash = strrchr(Info.dli_fname, '/');
    Size += static_cast<std::size_t>(snprintf(
        Text.data() + Size, Text.size() - Size, " %.80s+0x%zx",
        Slash ? Slash + 1 : Info.dli_fname,
        static_cast<std::size_t>(static_cast<char *>(C.At[I]) -
                                 static_cast<char *>(Info.dli_fbase))));
  }
  Text[Size++] = '\n';
  say(Text.data(), Size);
}

/// Whether the callers of an allocation were seen before; a table that is never
/// full in a program of ours, and only says "seen" too often if it is.
bool isNewPlace() {
  static std::array<std::atomic<uint64_t>, 1 << 16> Seen;
  const Callers C = callers();
  const uint64_t Hash =
      vorion::fnv1a({reinterpret_cast<const char *>(C.At.data()),
                     C.Count * sizeof(C.At[0])}) |
      1;
  for (std::size_t I = 0, At = Hash % Seen.size(); I < Seen.size(); ++I) {
    uint64_t Free = 0;
    if (Seen[At].compare_exchange_strong(Free, Hash))
      return true;
    if (Free == Hash)
      return false;
    At = (At + 1) % Seen.size();
  }
  return false;
}

/// Counts a call; whether it is the one to fail, with errno set.
bool fails(Kind K) {
  if (!IsOn || IsInside)
    return false;
  const uint64_t Number = ++Counts[K];
  if (K != Wanted || (WantedNumber != 0 && Number != WantedNumber))
    return false;
  const Inside Here;
  if (WantedNumber == 0) {
    std::array<char, 32> Text{};
    if (K == Alloc && isNewPlace())
      say(Text.data(), static_cast<std::size_t>(
                           snprintf(Text.data(), Text.size(), "place %llu\n",
                                    static_cast<unsigned long long>(Number))));
    return false;
  }
  printPlace();
  errno = Causes[K];
  return true;
}

template <typename Function> Function next(const char *Name) {
  const Inside Here;
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, Name));
}

__attribute__((constructor)) void begin() {
  const char *Program = getenv("VORION_FAULT_PROGRAM");
  const char *Fault = getenv("VORION_FAULT");
  if (!Program || !Fault || strcmp(Program, program_invocation_short_name) != 0)
    return;
  const char *Colon = strchr(Fault, ':');
  for (int K = 0; Colon && K < Kinds; ++K)
    if (strncmp(Fault, Names[K], static_cast<std::size_t>(Colon - Fault)) == 0)
      Wanted = static_cast<Kind>(K);
  if (Wanted == Kinds)
    return;
  WantedNumber = strtoull(Colon + 1, nullptr, 10);
  if (const char *File = getenv("VORION_FAULT_LOG"))
    Log = static_cast<int>(syscall(SYS_openat, AT_FDCWD, File,
                                   O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC,
                                   0666));
  // The unwinder reads its tables at its first use.
  static_cast<void>(callers());
  IsOn = true;
}

__attribute__((destructor)) void end() {
  IsOn = false;
  std::array<char, 64> Text{};
  for (int K = 0; K < Kinds; ++K)
    say(Text.data(), static_cast<std::size_t>(snprintf(
                         Text.data(), Text.size(), "%s %llu\n", Names[K],
                         static_cast<unsigned long long>(Counts[K].load()))));
}

} // namespace

// Each has the C library's declaration; one name is one function. The mode is
// the variable argument of those that open.
#define VORION_OPEN(NAME)                                                      \
  extern "C" int NAME(const char *Path, int Flags, ...) {                      \
    static const auto Real = next<int (*)(const char *, int, mode_t)>(#NAME);  \
    va_list More;                                                              \
    va_start(More, Flags);                                                     \
    const mode_t Mode =                                                        \
        (Flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(More, mode_t) : 0;       \
    va_end(More);                                                              \
    return fails(Open) ? -1 : Real(Path, Flags, Mode);                         \
  }
VORION_OPEN(open)
VORION_OPEN(open64)
// NOLINTBEGIN(bugprone-macro-parentheses): a type and a list of parameters.
#define VORION_CALL(KIND, FAILURE, RESULT, NAME, PARAMETERS, ARGUMENTS)        \
  extern "C" RESULT NAME PARAMETERS {                                          \
    static const auto Real = next<RESULT(*) PARAMETERS>(#NAME);                \
    return fails(KIND) ? FAILURE : Real ARGUMENTS;                             \
  }
VORION_CALL(Open, nullptr, FILE *, fopen, (const char *A, const char *B),
            (A, B))
VORION_CALL(Open, nullptr, FILE *, fopen64, (const char *A, const char *B),
            (A, B))
VORION_CALL(Write, -1, ssize_t, write, (int A, const void *B, size_t C),
            (A, B, C))
VORION_CALL(Write, -1, ssize_t, writev, (int A, const iovec *B, int C),
            (A, B, C))
VORION_CALL(Rename, -1, int, rename, (const char *A, const char *B), (A, B))
VORION_CALL(Sync, -1, int, fsync, (int A), (A))
VORION_CALL(Map, MAP_FAILED, void *, mmap,
            (void *A, size_t B, int C, int D, int E, off_t F),
            (A, B, C, D, E, F))
VORION_CALL(Map, MAP_FAILED, void *, mmap64,
            (void *A, size_t B, int C, int D, int E, off_t F),
            (A, B, C, D, E, F))

// NOLINTEND(bugprone-macro-parentheses)

// Closed all the same, as the kernel does it.
extern "C" int close(int File) {
  static const auto Real = next<int (*)(int)>("close");
  const bool Failed = fails(Close);
  const int Result = Real(File);
  if (Failed)
    errno = Causes[Close];
  return Failed ? -1 : Result;
}

// What the stream still holds goes to a device that is full.
extern "C" int fclose(FILE *File) {
  static const auto Real = next<int (*)(FILE *)>("fclose");
  const bool Failed = fails(Close);
  const int Result = Real(File);
  if (Failed)
    errno = Causes[Close];
  return Failed ? EOF : Result;
}
extern "C" int fflush(FILE *File) {
  static const auto Real = next<int (*)(FILE *)>("fflush");
  if (!File || !fails(Write))
    return Real(File);
  const Inside Here;
  const int Full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
  dup2(Full, fileno(File));
  ::close(Full);
  Real(File);
  errno = Causes[Write];
  return EOF;
}

// glibc's own names: dlsym, which finds all others, allocates.
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *__libc_realloc(void *, size_t);
void *__libc_memalign(size_t, size_t);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void *malloc(size_t Size) {
  return fails(Alloc) ? nullptr : __libc_malloc(Size);
}
void *calloc(size_t Count, size_t Size) {
  return fails(Alloc) ? nullptr : __libc_calloc(Count, Size);
}
void *realloc(void *Old, size_t Size) {
  return fails(Alloc) ? nullptr : __libc_realloc(Old, Size);
}
void *memalign(size_t Alignment, size_t Size) {
  return fails(Alloc) ? nullptr : __libc_memalign(Alignment, Size);
}
void *aligned_alloc(size_t Alignment, size_t Size) {
  return memalign(Alignment, Size);
}
int posix_memalign(void **To, size_t Alignment, size_t Size) {
  void *Made = memalign(Alignment, Size);
  if (!Made)
    return ENOMEM;
  *To = Made;
  return 0;
}
}
