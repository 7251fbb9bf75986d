/* The Vorion device driver, as PoCL's device table sees it. */
#ifndef POCL_VORION_H
#define POCL_VORION_H

#include "pocl_cl.h"

#ifdef __cplusplus
extern "C" {
#endif

void pocl_vorion_init_device_ops(struct pocl_device_ops *ops);

/* The function of CL/cl_vorion.h that has this name, or NULL. */
void *pocl_vorion_extension_function(const char *name);

/* The command of one event waits for that of another. The caller has the locks
 * of both. */
void pocl_vorion_add_dependency(cl_event waiting, cl_event on);

#ifdef __cplusplus
}
#endif

#endif
