/* An OpenCL platform of somebody else, with one device "Other" that does
 * nothing: for what programs and Debian's loader (ocl-icd) do where there is
 * another platform beside ours. Built with -DABORTS it ends a program that
 * looks for devices, as PoCL's CPU device does where /sys is missing. */
#include <CL/cl_icd.h>
#include <stdlib.h>
#include <string.h>

static cl_icd_dispatch Dispatch;
struct _cl_platform_id {
  cl_icd_dispatch *Dispatch;
} Platform = {&Dispatch};
struct _cl_device_id {
  cl_icd_dispatch *Dispatch;
} Device = {&Dispatch};

static cl_int answer(const void *Value, size_t Bytes, size_t Size, void *To,
                     size_t *SizeRet) {
  if (SizeRet)
    *SizeRet = Bytes;
  if (To && Size < Bytes)
    return CL_INVALID_VALUE;
  if (To)
    memcpy(To, Value, Bytes);
  return CL_SUCCESS;
}

static cl_int answerText(const char *Text, size_t Size, void *To,
                         size_t *SizeRet) {
  return answer(Text, strlen(Text) + 1, Size, To, SizeRet);
}

static cl_int CL_API_CALL getPlatformInfo(cl_platform_id P,
                                          cl_platform_info Name, size_t Size,
                                          void *To, size_t *SizeRet) {
  switch (Name) {
  case CL_PLATFORM_EXTENSIONS:
    return answerText("cl_khr_icd", Size, To, SizeRet);
  case CL_PLATFORM_ICD_SUFFIX_KHR:
    return answerText("other", Size, To, SizeRet);
  case CL_PLATFORM_VERSION:
    return answerText("OpenCL 1.2", Size, To, SizeRet);
  default:
    return answerText("Other", Size, To, SizeRet);
  }
}

static cl_int CL_API_CALL getDeviceIds(cl_platform_id P, cl_device_type Type,
                                       cl_uint Most, cl_device_id *To,
                                       cl_uint *Count) {
#ifdef ABORTS
  abort();
#endif
  if (Count)
    *Count = 1;
  if (To && Most > 0)
    *To = &Device;
  return CL_SUCCESS;
}

static cl_int CL_API_CALL getDeviceInfo(cl_device_id D, cl_device_info Name,
                                        size_t Size, void *To,
                                        size_t *SizeRet) {
  const cl_platform_id Of = &Platform;
  switch (Name) {
  case CL_DEVICE_NAME:
    return answerText("Other", Size, To, SizeRet);
  case CL_DEVICE_VERSION:
    return answerText("OpenCL 1.2", Size, To, SizeRet);
  case CL_DEVICE_PLATFORM:
    return answer(&Of, sizeof(Of), Size, To, SizeRet);
  default:
    return CL_INVALID_VALUE;
  }
}

static cl_int CL_API_CALL keepDevice(cl_device_id D) { return CL_SUCCESS; }

static void *CL_API_CALL getExtension(cl_platform_id P, const char *Name) {
  return NULL;
}

static cl_int CL_API_CALL getPlatformIds(cl_uint Most, cl_platform_id *To,
                                         cl_uint *Count) {
  Dispatch.clGetPlatformIDs = getPlatformIds;
  Dispatch.clGetPlatformInfo = getPlatformInfo;
  Dispatch.clGetDeviceIDs = getDeviceIds;
  Dispatch.clGetDeviceInfo = getDeviceInfo;
  Dispatch.clRetainDevice = keepDevice;
  Dispatch.clReleaseDevice = keepDevice;
  Dispatch.clGetExtensionFunctionAddressForPlatform = getExtension;
  if (Count)
    *Count = 1;
  if (To && Most > 0)
    *To = &Platform;
  return CL_SUCCESS;
}

CL_API_ENTRY void *CL_API_CALL clGetExtensionFunctionAddress(const char *Name) {
  return strcmp(Name, "clIcdGetPlatformIDsKHR") ? NULL : (void *)getPlatformIds;
}

CL_API_ENTRY cl_int CL_API_CALL clGetPlatformInfo(cl_platform_id P,
                                                  cl_platform_info Name,
                                                  size_t Size, void *To,
                                                  size_t *SizeRet) {
  return getPlatformInfo(P, Name, Size, To, SizeRet);
}
