/// The functions of CL/cl_vorion.h by name.

#include "Event.h"
#include "Opening.h"

#include <CL/cl_vorion.h>

#include <cstring>

using namespace vorion;

void *pocl_vorion_extension_function(const char *Name) {
  // The types of the header, so that a function that differs does not compile.
  const clGetEventInfoVORION_fn EventInfo = getEventInfo;
  const clOpenDevicesVORION_fn OpenDevices = openDevices;
  if (strcmp(Name, "clGetEventInfoVORION") == 0)
    return reinterpret_cast<void *>(EventInfo);
  if (strcmp(Name, "clOpenDevicesVORION") == 0)
    return reinterpret_cast<void *>(OpenDevices);
  return nullptr;
}
