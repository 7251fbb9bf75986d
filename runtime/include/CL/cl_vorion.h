/* cl_vorion_simulation: the OpenCL extension of Vorion devices.
 *
 * A device supports it if CL_DEVICE_EXTENSIONS contains the name. Functions are
 * queried by clGetExtensionFunctionAddressForPlatform, which returns NULL on
 * other platforms, so that this header does not depend on the platform. */
#ifndef CL_VORION_H
#define CL_VORION_H

#include <CL/cl.h>
#include <CL/cl_vorion_counters.h>

#ifdef __cplusplus
extern "C" {
#endif

#define cl_vorion_simulation 1
#define CL_VORION_EXTENSION_NAME "cl_vorion_simulation"
/* The former name, defined only in this version. It is not listed in
 * CL_DEVICE_EXTENSIONS, because the standard requires a name after the vendor's
 * prefix. A substring search for it finds the prefix of the new name. */
#define cl_vorion 1

/* Parameters of clGetEventInfoVORION, for events of completed kernels. Each
 * name of cl_vorion_counters.h is a cl_ulong: the counter of this kernel,
 * summed over cores and rasterizers. */

/* Report of the kernel's simulated time: JSON, a NUL-terminated char[]
 * (docs/model.md). Empty unless the option VORION_TIME or the configuration
 * enabled the clock when the devices were opened. VORION_TIME=profiled enables
 * it for kernels on queues with CL_QUEUE_PROFILING_ENABLE. */
#define CL_EVENT_TIME_REPORT_VORION 0x4F80

/* Parameter of clGetDeviceInfo: a cl_uint, the maximum number of work-groups
 * that run concurrently on a compute unit (core). The number is smaller if
 * their local memory does not fit, and 1 if the kernel uses the rasterizer. */
#define CL_DEVICE_WARPS_PER_CORE_VORION 0x4F81

/* Parameter of clGetDeviceInfo: a cl_uint, the number of DMA engines, with
 * which copies can overlap kernels in simulated time. 0 without the clock, or
 * if it has constants for launches and copies (docs/model.md). */
#define CL_DEVICE_DMA_ENGINES_VORION 0x4F82

/* If compiled kernels could not be stored, a line of the build log contains
 * this text, followed by the reason. The source may be correct. clBuildProgram
 * then returns CL_BUILD_PROGRAM_FAILURE, and a kernel that is compiled at its
 * start fails with CL_OUT_OF_HOST_MEMORY. */
#define CL_KERNEL_CACHE_PROBLEM_VORION "kernel cache: "

/* Messages. The platform reports a failed kernel by the callback of
 * clCreateContext: errinfo is the message, private_info the cl_int status of
 * the kernel's event. Without a callback, it prints the message to standard
 * error.
 */

/* Parameters are named as in CL/cl.h.
 * NOLINTBEGIN(readability-identifier-naming) */

/* An option of devices: the name of an environment variable (VORION_SET,
 * VORION_TIME, VORION_TRACE and others, docs/debugging.md) and its value. */
typedef struct cl_option_vorion {
  const char *name;
  const char *text;
} cl_option_vorion;

/* Opens the platform's devices with options, which override the environment
 * variables of their names. Otherwise, clGetDeviceIDs opens the devices.
 * Devices that are open with other options are reopened, unless they have a
 * context. If problem is not NULL, it receives the reason of a failure,
 * NUL-terminated and truncated to size bytes, and nothing is printed.
 * CL_INVALID_VALUE: unknown option.
 * CL_INVALID_OPERATION: the devices have a context and are open with other
 * options.
 * CL_OUT_OF_HOST_MEMORY: the memory of a machine cannot be allocated.
 * CL_DEVICE_NOT_AVAILABLE: an option has an invalid value.
 * CL_INVALID_PROPERTY: a file that an option names cannot be read or written,
 * or is malformed. */
typedef cl_int(CL_API_CALL *clOpenDevicesVORION_fn)(
    cl_platform_id platform, cl_uint num_options,
    const cl_option_vorion *options, size_t size, char *problem);

/* Analogous to clGetEventInfo. CL_INVALID_EVENT: not the event of a kernel on a
 * Vorion device. CL_PROFILING_INFO_NOT_AVAILABLE: the kernel has not completed,
 * or has failed. CL_INVALID_VALUE: unknown name, or size too small. */
typedef cl_int(CL_API_CALL *clGetEventInfoVORION_fn)(cl_event event,
                                                     cl_uint name, size_t size,
                                                     void *value,
                                                     size_t *size_ret);
/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
