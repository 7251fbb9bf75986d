/// One random sequence of OpenCL calls, valid and invalid: no code that the
/// standard does not list for the function, and afterwards a kernel must still
/// run.
///
/// Handles that were released are used again, too. The standard leaves that
/// undefined; here the code must be one that it lists for a wrong handle.
#pragma once

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace vorion::test {

/// Of every command that moves what is in buffers.
inline constexpr std::initializer_list<cl_int> TransferCodes = {
    CL_INVALID_COMMAND_QUEUE,
    CL_INVALID_CONTEXT,
    CL_INVALID_MEM_OBJECT,
    CL_INVALID_VALUE,
    CL_INVALID_EVENT_WAIT_LIST,
    CL_MISALIGNED_SUB_BUFFER_OFFSET,
    CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST,
    CL_MEM_OBJECT_ALLOCATION_FAILURE,
    CL_MEM_COPY_OVERLAP,
    CL_INVALID_OPERATION};

/// The functions that call OpenCL stand in a file for each kind of object:
/// Queues.cpp, Buffers.cpp, Programs.cpp, Events.cpp and Queries.cpp.
class Sequence {
public:
  /// The same \p Seed makes the same calls.
  explicit Sequence(uint64_t Seed) : Random(Seed) {}

  /// Makes \p Calls calls. What went wrong, or nothing.
  std::string run(unsigned Calls);

private:
  // --- chance

  unsigned below(unsigned N) { return static_cast<unsigned>(Random() % N); }
  bool chance(unsigned Percent) { return below(100) < Percent; }
  template <typename T> T any(std::initializer_list<T> Of) {
    return *(Of.begin() + below(static_cast<unsigned>(Of.size())));
  }
  /// One of \p From, seldom (or where there is none) a null handle or one that
  /// was released.
  template <typename T> T pick(const std::vector<T> &From) {
    const std::vector<T> &Gone = std::get<std::vector<T>>(Released);
    if (!Gone.empty() && chance(From.empty() ? 50 : 3))
      return Gone[below(unsigned(Gone.size()))];
    return From.empty() || chance(3) ? T() : From[below(unsigned(From.size()))];
  }
  std::size_t size() {
    return any<std::size_t>({0, 1, 3, 4, 16, 64, 100, 128, 256, 1000, 4096,
                             std::size_t(below(5000)), SIZE_MAX, SIZE_MAX - 3,
                             std::size_t(1) << 31, std::size_t(1) << 33});
  }
  std::size_t fitting() { return chance(85) ? 4 * below(64) : size(); }
  cl_bool blocking() { return chance(50) ? CL_TRUE : CL_FALSE; }

  // --- results

  /// \p Status is a code that \p Function may give: one of \p Allowed or of
  /// those that every function may.
  bool check(const char *Function, cl_int Status,
             std::initializer_list<cl_int> Allowed);
  template <typename T>
  void made(const char *Function, std::vector<T> &Into, T Made, cl_int Status,
            std::initializer_list<cl_int> Allowed) {
    const bool Good = check(Function, Status, Allowed);
    if (Good != (Made != nullptr))
      Wrong = std::string(Function) + " gave code " + std::to_string(Status) +
              (Made ? " with" : " without") + " an object";
    if (Made)
      Into.push_back(Made);
  }

  /// A wait list of a few events for one call.
  struct WaitList {
    std::vector<cl_event> Events;
    cl_uint Count = 0;
    const cl_event *List = nullptr;
  };
  WaitList waitList();
  /// A blocking call would wait for a user event that nobody sets.
  cl_bool blockingUnless(const WaitList &W);
  void enqueued(const char *Function, cl_int Status, cl_event Event,
                std::initializer_list<cl_int> Allowed);
  cl_event *wanted(cl_event &Event) { return chance(60) ? &Event : nullptr; }

  // --- calls

  void newContext();
  void newQueue();
  void synchronize();

  void newBuffer();
  void newSubBuffer();
  void readOrWrite();
  void rectangle();
  void copyOrFill();
  void map();
  void unmap();

  void newProgram();
  void build();
  void newKernel();
  void setArgument();
  void start();

  void userEvent();
  void callback();

  void query();

  template <typename T>
  void drop(const char *Function, std::vector<T> &From, cl_int (*Release)(T),
            cl_int Code) {
    if (From.empty())
      return;
    const std::size_t I = below(unsigned(From.size()));
    const T Object = From[I];
    From.erase(From.begin() + std::ptrdiff_t(I));
    check(Function, Release(Object), {Code});
    std::get<std::vector<T>>(Released).push_back(Object);
  }
  void release();

  /// One of these.
  void call();

  /// Sets what is open, waits for everything, releases it, and runs a kernel.
  void finish();
  bool hasRightSum();

  struct Mapping {
    cl_command_queue Queue;
    cl_mem Buffer;
    void *Pointer;
  };

  std::mt19937_64 Random;
  cl_platform_id Platform = nullptr;
  cl_device_id Device = nullptr;
  std::vector<unsigned char> Host;
  std::vector<cl_context> Contexts;
  std::vector<cl_command_queue> Queues;
  std::vector<cl_mem> Buffers;
  std::vector<cl_program> Programs;
  std::vector<cl_kernel> Kernels;
  std::vector<cl_event> Events, Unset;
  std::tuple<std::vector<cl_context>, std::vector<cl_command_queue>,
             std::vector<cl_mem>, std::vector<cl_program>,
             std::vector<cl_kernel>, std::vector<cl_event>>
      Released;
  std::vector<Mapping> Mappings;
  unsigned Pending = 0; ///< user events that are open
  std::string Wrong;
};

} // namespace vorion::test
