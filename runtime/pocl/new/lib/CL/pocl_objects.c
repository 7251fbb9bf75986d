#include "pocl_objects.h"

#include <stdlib.h>
#include <string.h>

#include "pocl_cl.h"

/* Each chunk has twice as many objects as the one before it. */
#define FIRST_CHUNK_OBJECTS ((size_t)64)
#define MAX_CHUNKS 32
/* So many released objects wait at least before the first is used again. */
#define MIN_WAITING 1000

/* The beginning of an object, and what a released one holds. */
typedef struct slot {
  void *dispatch; /* stays: the loader reads it in the handles of programs */
  uint64_t kind;
  struct slot *next; /* released after this one */
} slot;

_Static_assert(offsetof(slot, kind) == offsetof(struct _cl_mem, kind),
               "objects begin otherwise");

typedef struct {
  size_t size; /* of an object */
  uintptr_t chunks[MAX_CHUNKS];
  unsigned num_chunks;
  size_t used; /* objects of the last chunk */
  slot *first, *last;
  size_t num_waiting;
} pool;

static pool pools[POCL_NUM_KINDS];
static pocl_lock_t lock = POCL_LOCK_INITIALIZER;

static size_t objects_of(unsigned chunk) {
  return FIRST_CHUNK_OBJECTS << chunk;
}

/* An object that was never used, NULL without memory. */
static slot *fresh(pool *p) {
  if (p->num_chunks == 0 || p->used == objects_of(p->num_chunks - 1)) {
    void *chunk = p->num_chunks < MAX_CHUNKS
                      ? calloc(objects_of(p->num_chunks), p->size)
                      : NULL;
    if (chunk == NULL)
      return NULL;
    p->chunks[p->num_chunks] = (uintptr_t)chunk;
    p->used = 0;
    /* those who look take no lock */
    __atomic_store_n(&p->num_chunks, p->num_chunks + 1, __ATOMIC_RELEASE);
  }
  return (slot *)(p->chunks[p->num_chunks - 1] + p->size * p->used++);
}

/* The object that was released first, NULL if none waits. */
static slot *released(pool *p) {
  slot *s = p->first;
  if (s != NULL) {
    p->first = s->next;
    --p->num_waiting;
  }
  return s;
}

void *pocl_new_object(uint64_t kind, size_t size) {
  pool *p = &pools[kind];
  POCL_LOCK(lock);
  p->size = size;
  slot *s = p->num_waiting > MIN_WAITING ? released(p) : fresh(p);
  if (s == NULL)
    s = released(p);
  POCL_UNLOCK(lock);
  if (s != NULL)
    memset(s, 0, size);
  return s;
}

void pocl_free_object(uint64_t kind, void *object) {
  slot *s = object;
  if (s == NULL)
    return;
  pool *p = &pools[kind];
  POCL_LOCK(lock);
  __atomic_store_n(&s->kind, POCL_KIND_NONE, __ATOMIC_RELEASE);
  s->next = NULL;
  if (p->first == NULL)
    p->first = s;
  else
    p->last->next = s;
  p->last = s;
  ++p->num_waiting;
  POCL_UNLOCK(lock);
}

int pocl_is_alive(uint64_t kind, const void *object) {
  const pool *p = &pools[kind];
  for (unsigned i = __atomic_load_n(&p->num_chunks, __ATOMIC_ACQUIRE);
       i-- > 0;) {
    const size_t place = (uintptr_t)object - p->chunks[i];
    if (place < objects_of(i) * p->size)
      return place % p->size == 0 &&
             __atomic_load_n(&((const slot *)object)->kind, __ATOMIC_ACQUIRE) ==
                 kind;
  }
  return 0;
}
