/* cl_vorion: what a Vorion device offers beyond OpenCL.
 *
 * Present if "cl_vorion" is in CL_DEVICE_EXTENSIONS. The functions are found
 * with clGetExtensionFunctionAddressForPlatform, which gives NULL on a platform
 * without them; a program may include this header anywhere. */
#ifndef CL_VORION_H
#define CL_VORION_H

#include <CL/cl.h>
#include <CL/cl_vorion_counters.h>

#ifdef __cplusplus
extern "C" {
#endif

#define cl_vorion 1
#define CL_VORION_EXTENSION_NAME "cl_vorion"

/* What clGetEventInfoVORION tells about the event of a kernel that has ended:
 * each name of cl_vorion_counters.h is a cl_ulong, the sum over the cores and
 * rasterizers for this kernel alone. */

/* How long the kernel took on the machine, and why: JSON, a NUL-terminated
 * char[] (docs/model.md). Empty unless the environment's VORION_TIME or the
 * configuration turned the clock on when the platform was opened;
 * VORION_TIME=profiled does so for the kernels of queues that have
 * CL_QUEUE_PROFILING_ENABLE. */
#define CL_EVENT_TIME_REPORT_VORION 0x4F80

/* A line of a program's build log contains this, and the reason after it, if
 * compiled kernels could not be kept: the source may be good. Then
 * clBuildProgram gives CL_BUILD_PROGRAM_FAILURE, and a kernel that is compiled
 * when it is started ends with CL_OUT_OF_HOST_MEMORY. */
#define CL_KERNEL_CACHE_PROBLEM_VORION "kernel cache: "

/* As clGetEventInfo. CL_INVALID_EVENT: not an event of a kernel on a Vorion
 * device. CL_PROFILING_INFO_NOT_AVAILABLE: the kernel has not ended, or has
 * failed. CL_INVALID_VALUE: an unknown name, or size too small for the value.
 */
/* Parameters are named as in CL/cl.h.
 * NOLINTBEGIN(readability-identifier-naming) */
typedef cl_int(CL_API_CALL *clGetEventInfoVORION_fn)(cl_event event,
                                                     cl_uint name, size_t size,
                                                     void *value,
                                                     size_t *size_ret);
/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
