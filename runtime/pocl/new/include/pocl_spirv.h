/* What of a module of SPIR-V is seen and set before it is translated: whether
 * it is one for OpenCL, whether a device offers what it needs, its
 * specialization constants, forms that the translator does not read. */
#ifndef POCL_SPIRV_H
#define POCL_SPIRV_H

#include <stddef.h>
#include <stdint.h>

#include "pocl_cl.h"

/* Room for the texts below. */
#define POCL_SPIRV_TEXT 256

/* Whether the bytes are a module for OpenCL, whole down to each instruction's
 * length. If not, text says what is wrong. */
int pocl_spirv_is_kernel_module(const void *il, size_t length,
                                char text[POCL_SPIRV_TEXT]);

/* Whether the device offers what such a module says that it needs: version,
 * size of addresses, capabilities. If not, text names the first that it does
 * not. */
int pocl_spirv_is_offered(cl_device_id device, const void *il, size_t length,
                          char text[POCL_SPIRV_TEXT]);

/* Fills in the program's specialization constants, which its module declares.
 * 0 on success, -1 without memory. */
int pocl_spirv_find_constants(cl_program program);

/* The program's module as the compiler gets it, to be freed: in common forms,
 * with the values of the specialization constants that were set. A null pointer
 * without memory. */
void *pocl_spirv_specialized(cl_program program, size_t *length);

/* The same module, to be freed, with what llvm-spirv-15 does not read written
 * in forms that it does: nulls of scalars as constants, shuffles of vectors
 * with different numbers of lanes as those of equal ones, composites of values
 * as insertions. length becomes the new length in bytes. A null pointer without
 * memory. */
void *pocl_spirv_common_forms(const void *il, size_t *length);

#endif
