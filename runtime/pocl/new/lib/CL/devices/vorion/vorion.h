/* The Vorion device driver, as PoCL's device table sees it. */
#ifndef POCL_VORION_H
#define POCL_VORION_H

#include "pocl_cl.h"

#ifdef __cplusplus
extern "C" {
#endif

void pocl_vorion_init_device_ops(struct pocl_device_ops *ops);

/* clGetEventInfoVORION of CL/cl_vorion.h. */
cl_int CL_API_CALL pocl_vorion_get_event_info(cl_event event, cl_uint name,
                                              size_t size, void *value,
                                              size_t *size_ret);

#ifdef __cplusplus
}
#endif

#endif
