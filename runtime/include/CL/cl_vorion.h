/* cl_vorion_simulation: what a Vorion device offers beyond OpenCL.
 *
 * Present if its name is in CL_DEVICE_EXTENSIONS. The functions are found
 * with clGetExtensionFunctionAddressForPlatform, which gives NULL on a platform
 * without them; a program may include this header anywhere. */
#ifndef CL_VORION_H
#define CL_VORION_H

#include <CL/cl.h>
#include <CL/cl_vorion_counters.h>

#ifdef __cplusplus
extern "C" {
#endif

#define cl_vorion_simulation 1
#define CL_VORION_EXTENSION_NAME "cl_vorion_simulation"
/* What it was called before, kept in this version alone. A program that looks
 * for the old name in CL_DEVICE_EXTENSIONS finds the beginning of the new one:
 * the standard wants a part behind the vendor's, so the old one is not listed.
 */
#define cl_vorion 1

/* What clGetEventInfoVORION tells about the event of a kernel that has ended:
 * each name of cl_vorion_counters.h is a cl_ulong, the sum over the cores and
 * rasterizers for this kernel alone. */

/* How long the kernel took on the machine, and why: JSON, a NUL-terminated
 * char[] (docs/model.md). Empty unless the option VORION_TIME or the
 * configuration turned the clock on when the devices were opened;
 * VORION_TIME=profiled does so for the kernels of queues that have
 * CL_QUEUE_PROFILING_ENABLE. */
#define CL_EVENT_TIME_REPORT_VORION 0x4F80

/* For clGetDeviceInfo: a cl_uint, how many work-groups a compute unit runs at
 * the same time. A compute unit is a core. It runs fewer if their local memory
 * does not fit together, and one if the kernel uses the rasterizer. */
#define CL_DEVICE_WARPS_PER_CORE_VORION 0x4F81

/* A line of a program's build log contains this, and the reason after it, if
 * compiled kernels could not be kept: the source may be good. Then
 * clBuildProgram gives CL_BUILD_PROGRAM_FAILURE, and a kernel that is compiled
 * when it is started ends with CL_OUT_OF_HOST_MEMORY. */
#define CL_KERNEL_CACHE_PROBLEM_VORION "kernel cache: "

/* Messages. The platform tells of a kernel that fails through the function that
 * the program gave clCreateContext: the first argument is the text, the second
 * the cl_int that the kernel's event ends with. Without such a function it
 * writes the text to standard error. */

/* Parameters are named as in CL/cl.h.
 * NOLINTBEGIN(readability-identifier-naming) */

/* What devices are opened with: the name of one of the environment's variables
 * that they read (VORION_SET, VORION_TIME, VORION_TRACE and others,
 * docs/debugging.md), and its text. */
typedef struct cl_option_vorion {
  const char *name;
  const char *text;
} cl_option_vorion;

/* Opens the platform's devices, which clGetDeviceIDs else does, with options
 * that go before the environment's variables of their names. Devices that are
 * open with other options, but of which there is no context, are opened anew;
 * those with a context stay as they are. problem, if not NULL,
 * receives why they cannot be opened, NUL-terminated and cut off at size;
 * nothing is printed then.
 * CL_INVALID_VALUE: an option that there is not.
 * CL_INVALID_OPERATION: there is a context, and the devices are open with other
 * options.
 * CL_OUT_OF_HOST_MEMORY: no room for a machine's memory.
 * CL_DEVICE_NOT_AVAILABLE: an option whose text is wrong.
 * CL_INVALID_PROPERTY: a file that an option names cannot be read or written,
 * or is malformed. */
typedef cl_int(CL_API_CALL *clOpenDevicesVORION_fn)(
    cl_platform_id platform, cl_uint num_options,
    const cl_option_vorion *options, size_t size, char *problem);

/* As clGetEventInfo. CL_INVALID_EVENT: not an event of a kernel on a Vorion
 * device. CL_PROFILING_INFO_NOT_AVAILABLE: the kernel has not ended, or has
 * failed. CL_INVALID_VALUE: an unknown name, or size too small for the value.
 */
typedef cl_int(CL_API_CALL *clGetEventInfoVORION_fn)(cl_event event,
                                                     cl_uint name, size_t size,
                                                     void *value,
                                                     size_t *size_ret);
/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
