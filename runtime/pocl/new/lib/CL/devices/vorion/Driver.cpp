/// PoCL's device operations for a Vorion machine, except those on memory.

#include "Description.h"
#include "Device.h"
#include "Event.h"
#include "KnownPrograms.h"
#include "MemoryOperations.h"
#include "Messages.h"
#include "Opening.h"
#include "ProgramCompiler.h"
#include "ProgramKernels.h"
#include "Queue.h"
#include "vorion/support/Environment.h"

extern "C" {
#include "common.h"
#include "common_driver.h"
#include "config.h"
#include "devices.h"
#include "pocl_file_util.h"
#include "pocl_llvm.h"
#include "pocl_local_size.h"
#include "pocl_mem_management.h"
#include "pocl_timing.h"
#include "pocl_util.h"
}

#include <cstdio>
#include <cstdlib>
#include <cstring>

using namespace vorion;

namespace {

unsigned probe(pocl_device_ops *Ops) {
  const int Count = pocl_device_get_env_count(Ops->device_name);
  return Count < 0 ? 1 : Count;
}

/// Whatever names source lines needs programs with line numbers and PoCL's copy
/// of their source; both are PoCL's options, which it looks up at each build.
void keepSourceLines() {
  bool Wanted = false;
  for (const char *Name : {"VORION_PROFILE", "VORION_CHECK", "VORION_GDB",
                           "VORION_NUMERICS", "VORION_CAPTURE"})
    Wanted |= isOptionSet(Name);
  if (!Wanted)
    return;
  const char *Flags = environmentVariable("POCL_EXTRA_BUILD_FLAGS");
  setenv("POCL_EXTRA_BUILD_FLAGS",
         (std::string("-g ") + (Flags ? Flags : "")).c_str(), 1);
  setenv("POCL_LEAVE_KERNEL_COMPILER_TEMP_FILES", "1", 1);
}

cl_int init(unsigned, cl_device_id Device, const char *Parameters) {
  keepSourceLines();
  cl_int Status = CL_SUCCESS;
  Machine Opened = openMachine(Parameters, Status);
  if (!Opened)
    return Status;
  auto Own = std::make_unique<VorionDevice>(std::move(Opened));
  if (vx_device_get_info(Own->Opened.get(), &Own->Info) != VX_OK)
    return CL_DEVICE_NOT_AVAILABLE;
  const vx_device_info &Info = Own->Info;
  Own->BuildHash = "vorion-xvortex2-xvorion1-" + std::to_string(Info.lanes) +
                   "-" + Own->Kernels.tools().fingerprint();
  describeDevice(Device, Info);
  describeCompilation(Device, Info);
  static char Name[] = "Vorion";
  Device->long_name = Name;
  Device->available = availability();
  Device->data = Own.release();
  return CL_SUCCESS;
}

cl_int uninit(unsigned, cl_device_id Device) {
  // A forked process has no thread that could be ended.
  auto *const Own = static_cast<VorionDevice *>(Device->data);
  if (Own && !Own->Thread.isElsewhere())
    delete Own;
  Device->data = nullptr;
  return CL_SUCCESS;
}

cl_int reinit(unsigned Index, cl_device_id Device, const char *Parameters) {
  const cl_int Status = init(Index, Device, Parameters);
  // PoCL goes on after an error, with a device that has no machine.
  if (Status != CL_SUCCESS)
    *availability() = CL_FALSE;
  return Status;
}

char *buildHash(cl_device_id Device) {
  return strdup(deviceOf(Device).BuildHash.c_str());
}

/// What the front end needs to know beside the triple.
char *initBuild(void *Data) {
  const std::string Options =
      "-target-feature +m -target-feature +a -target-feature +f -D__VORION__=1 "
      // asm is a keyword.
      "-fgnu-keywords "
      // A fault names its line, whatever the options.
      "-debug-info-kind=line-tables-only -dwarf-version=4 "
      "\"-I" +
      static_cast<VorionDevice *>(Data)->Kernels.tools().includeFolder() + "\"";
  return strdup(Options.c_str());
}

void compileKernel(_cl_command_node *Command, cl_kernel Kernel,
                   cl_device_id Device, int Specialize) {
  // PoCL asks for this when a program's binary is wanted, and no error is
  // possible; it is in the build log too, and a run of the kernel fails its
  // event.
  if (!Command || Command->type != CL_COMMAND_NDRANGE_KERNEL)
    return;
  // A size that the source requires is the one to compile for; not so the
  // global offset of 0 that PoCL has filled in.
  if (!Specialize && Kernel->meta->reqd_wg_size[0] > 0) {
    Command->command.run.pc.global_offset[0] = 1;
    Specialize = 1;
  }
  const KernelCache::Problem Problem =
      deviceOf(Device).Kernels.compile(Command, Kernel, Specialize);
  if (!Problem.Text.empty())
    tellFailure(Kernel->context, Problem.status(), Problem.Text);
}

cl_int privateBytes(cl_device_id Device, cl_uint Index, cl_kernel Kernel,
                    cl_ulong *Bytes) {
  KernelCache::Problem Problem;
  *Bytes =
      deviceOf(Device).Kernels.privateBytes(Kernel, Device, Index, Problem);
  if (Problem.Text.empty())
    return CL_SUCCESS;
  tellFailure(Kernel->context, CL_OUT_OF_RESOURCES, Problem.Text);
  return CL_OUT_OF_RESOURCES;
}

/// A program's binary has the kernels that were started before. PoCL compiles
/// all others for groups of any size, too: no start asks for these, but
/// vorion-clang does.
int buildPoclBinary(cl_program Program, cl_uint Index) {
  if (environmentVariable("VORION_COMPILE_ALL") == nullptr)
    return CL_SUCCESS;
  return pocl_driver_build_poclbinary(Program, Index);
}

int freeProgram(cl_device_id Device, cl_program Program, unsigned Index) {
  if (Device->data)
    deviceOf(Device).Kernels.forget(Program);
  return pocl_driver_free_program(Device, Program, Index);
}

// What was loaded of a program's last build is of no use to the next, whose
// variables begin anew.

int buildSource(cl_program Program, cl_uint Index, cl_uint NumHeaders,
                const cl_program *Headers, const char **Names, int Link) {
  KernelCache &Kernels = deviceOf(Program->devices[Index]).Kernels;
  Kernels.forget(Program);
  if (NumHeaders == 0 && takeKnownProgram(Program, Index, Kernels.tools()))
    return CL_SUCCESS;
  const int Status = pocl_driver_build_source(Program, Index, NumHeaders,
                                              Headers, Names, Link);
  if (NumHeaders == 0 && Status == CL_SUCCESS)
    keepKnownProgram(Program, Index, Kernels.tools());
  return Status;
}

int buildBinary(cl_program Program, cl_uint Index, int Link, int Spir) {
  deviceOf(Program->devices[Index]).Kernels.forget(Program);
  // One of PoCL's has its kernels' images, or what they are compiled from.
  if (Program->pocl_binaries[Index])
    return CL_SUCCESS;
  return pocl_driver_build_binary(Program, Index, Link, Spir);
}

int setupMetadata(cl_device_id, cl_program Program, unsigned Index) {
  return takeKernels(Program, Index) || describeKernels(Program, Index);
}

// --- Commands and events. The lock of an event or queue is held by the caller
// --- where PoCL's documentation of the operation says so.

void submitReady(_cl_command_node *Node) {
  cl_event Event = Node->sync.event.event;
  if (pocl_command_is_ready(Event) && Event->status == CL_QUEUED) {
    pocl_update_event_submitted(Event);
    deviceOf(Node->device).Thread.push(Node);
  }
}

void submit(_cl_command_node *Node, cl_command_queue) {
  Worker::finishBeforeExit();
  Node->ready = 1;
  hostSends(Node->sync.event.event);
  submitReady(Node);
  POCL_UNLOCK_OBJ(Node->sync.event.event);
}

void notify(cl_device_id, cl_event Event, cl_event Finished) {
  _cl_command_node *Node = Event->command;
  if (Finished->status < CL_COMPLETE)
    Event->dependency_failed = 1;
  if (Node->ready)
    submitReady(Node);
}

void flush(cl_device_id, cl_command_queue) {}

/// The clock goes on with the host: what follows is sent behind all that.
void join(cl_device_id Device, cl_command_queue Queue) {
  POCL_LOCK_OBJ(Queue);
  while (Queue->command_count > 0)
    POCL_WAIT_COND(queueData(Queue).Finished, Queue->pocl_lock);
  POCL_UNLOCK_OBJ(Queue);
  if (!Device->data || deviceOf(Device).Info.dma_engines == 0)
    return;
  VorionDevice &Own = deviceOf(Device);
  Own.Thread.finish();
  vx_command_settle(Own.Opened.get());
}

void notifyQueueFinished(cl_command_queue Queue) {
  pthread_cond_broadcast(&queueData(Queue).Finished);
}

int initQueue(cl_device_id, cl_command_queue Queue) {
  Queue->data = new QueueData;
  return CL_SUCCESS;
}

int freeQueue(cl_device_id, cl_command_queue Queue) {
  delete &queueData(Queue);
  Queue->data = nullptr;
  return CL_SUCCESS;
}

/// Tells an event's times. With the clock on, a kernel takes as long as on the
/// machine.
void updateEvent(cl_device_id, cl_event Event) {
  if (!Event->data && Event->status == CL_QUEUED)
    Event->data = new EventData;
  const cl_ulong Now = pocl_gettimemono_ns();
  switch (Event->status) {
  case CL_QUEUED:
    Event->time_queue = Now;
    break;
  case CL_SUBMITTED:
    Event->time_submit = Now;
    break;
  case CL_RUNNING:
    Event->time_start = Now;
    break;
  default: {
    const EventData *Data = eventData(Event);
    const double Took = Data ? Data->DeviceSeconds : 0;
    // A program that turned the clock on knows.
    if (Took > 0 && Event->queue &&
        (Event->queue->properties & CL_QUEUE_PROFILING_ENABLE) != 0 &&
        !hasOptionsOfProgram())
      noteModelledTimes();
    Event->time_end =
        Took > 0 ? Event->time_start + static_cast<cl_ulong>(Took * 1e9) : Now;
  }
  }
}

void waitEvent(cl_device_id, cl_event Event) {
  POCL_LOCK_OBJ(Event);
  while (Event->status > CL_COMPLETE)
    POCL_WAIT_COND(eventData(Event)->Finished, Event->pocl_lock);
  hostWaited(Event);
  POCL_UNLOCK_OBJ(Event);
}

void notifyEventFinished(cl_event Event) {
  pthread_cond_broadcast(&eventData(Event)->Finished);
}

void freeEventData(cl_event Event) {
  delete eventData(Event);
  Event->data = nullptr;
}

template <typename T>
cl_int answer(const T &Is, size_t Size, void *Value, size_t *SizeRet) {
  if (Value && Size < sizeof(T))
    return CL_INVALID_VALUE;
  if (Value)
    memcpy(Value, &Is, sizeof(T));
  if (SizeRet)
    *SizeRet = sizeof(T);
  return CL_SUCCESS;
}

cl_int deviceInfo(cl_device_id Device, cl_device_info Name, size_t Size,
                  void *Value, size_t *SizeRet) {
  switch (Name) {
  case CL_DEVICE_WARPS_PER_CORE_VORION: {
    const cl_uint Warps = deviceOf(Device).Info.warps;
    return answer(Warps, Size, Value, SizeRet);
  }
  case CL_DEVICE_DMA_ENGINES_VORION: {
    const cl_uint Engines = deviceOf(Device).Info.dma_engines;
    return answer(Engines, Size, Value, SizeRet);
  }
  case CL_DEVICE_INTEGER_DOT_PRODUCT_CAPABILITIES_KHR: {
    const cl_device_integer_dot_product_capabilities_khr All =
        CL_DEVICE_INTEGER_DOT_PRODUCT_INPUT_4x8BIT_PACKED_KHR |
        CL_DEVICE_INTEGER_DOT_PRODUCT_INPUT_4x8BIT_KHR;
    return answer(All, Size, Value, SizeRet);
  }
  case CL_DEVICE_INTEGER_DOT_PRODUCT_ACCELERATION_PROPERTIES_8BIT_KHR:
  case CL_DEVICE_INTEGER_DOT_PRODUCT_ACCELERATION_PROPERTIES_4x8BIT_PACKED_KHR: {
    // They are products and sums of single bytes.
    const cl_device_integer_dot_product_acceleration_properties_khr None = {};
    return answer(None, Size, Value, SizeRet);
  }
  default:
    return CL_INVALID_VALUE;
  }
}

} // namespace

void pocl_vorion_init_device_ops(pocl_device_ops *Ops) {
  Ops->device_name = "vorion";
  Ops->probe = probe;
  Ops->init = init;
  Ops->uninit = uninit;
  Ops->reinit = reinit;
  Ops->build_hash = buildHash;
  Ops->get_device_info_ext = deviceInfo;
  Ops->init_build = initBuild;

  setMemoryOperations(Ops);

  Ops->build_source = buildSource;
  Ops->link_program = pocl_driver_link_program;
  Ops->build_binary = buildBinary;
  Ops->build_poclbinary = buildPoclBinary;
  Ops->setup_metadata = setupMetadata;
  Ops->supports_binary = pocl_driver_supports_binary;
  Ops->free_program = freeProgram;
  Ops->compile_kernel = compileKernel;
  Ops->kernel_private_bytes = privateBytes;
  Ops->compute_local_size = pocl_default_local_size_optimizer;

  Ops->submit = submit;
  Ops->notify = notify;
  Ops->broadcast = pocl_broadcast;
  Ops->flush = flush;
  Ops->join = join;
  Ops->init_queue = initQueue;
  Ops->free_queue = freeQueue;
  Ops->notify_cmdq_finished = notifyQueueFinished;
  Ops->update_event = updateEvent;
  Ops->get_synchronized_timestamps = pocl_driver_get_synchronized_timestamps;
  Ops->wait_event = waitEvent;
  Ops->notify_event_finished = notifyEventFinished;
  Ops->free_event_data = freeEventData;
}
