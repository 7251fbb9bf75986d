/* Where the objects behind OpenCL's handles live. Their memory is never given
 * back and serves one kind of object alone. So a handle can be checked without
 * reading what it points to, if that is none of ours, and the handle of a
 * released object leads to memory that says so. */
#ifndef POCL_OBJECTS_H
#define POCL_OBJECTS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What an object is. Its first words are the loader's table and this. */
enum {
  POCL_KIND_NONE = 0, /* released, or not made yet */
  POCL_KIND_DEVICE,
  POCL_KIND_CONTEXT,
  POCL_KIND_QUEUE,
  POCL_KIND_COMMAND_BUFFER,
  POCL_KIND_MEM,
  POCL_KIND_PROGRAM,
  POCL_KIND_KERNEL,
  POCL_KIND_EVENT,
  POCL_KIND_SAMPLER,
  POCL_NUM_KINDS
};

/* Memory of zeros for an object; its kind is set when it is made. NULL if there
 * is none. The memory of an object that was released is taken again only after
 * a thousand others of its kind were released. */
void *pocl_new_object(uint64_t kind, size_t size);

/* Releases the memory of an object, which NULL has none of. What it held stays
 * until it is taken again. */
void pocl_free_object(uint64_t kind, void *object);

/* Whether a handle, which may be any number, is that of a living object of the
 * kind. Takes no lock. */
int pocl_is_alive(uint64_t kind, const void *object);

#ifdef __cplusplus
}
#endif

#endif
