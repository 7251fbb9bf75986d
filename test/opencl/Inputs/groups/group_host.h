/* Makes C of random group kernels (group_kernel.py): every work-item is a
   coroutine that runs to its next barrier, in the order of local ids. */
#define _GNU_SOURCE
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <ucontext.h>

typedef unsigned char uchar;
typedef unsigned short ushort;
typedef unsigned int uint;
typedef unsigned long ulong;
typedef uint uint4 __attribute__((ext_vector_type(4)));
#define kernel static
#define global
#define local
#define LOCAL_ARRAY static
#define LOCAL_POINTER(name) static uint *name
#define CLK_LOCAL_MEM_FENCE 1
#define CLK_GLOBAL_MEM_FENCE 2
#define REQUIRED_SIZE(n)
#define put_by_switch(t, i, value) ((t)[i] = (value))
#define put_by_if(t, i, value) ((t)[i] = (value))
#define put_at(t, i, value) ((t)[i] = (value))

typedef void entry(uint *out, const uint *in, uint *t, uint k);

/* MAY_RETURN: whether work-items end before others of their group.
   LOCAL_WORDS: of the local memory that is an argument, for a work-item. */
enum { MAX_ITEMS = 64, STACK_BYTES = 1 << 16 };

static ucontext_t Scheduler, Items[MAX_ITEMS];
static char Stacks[MAX_ITEMS][STACK_BYTES];
static int Done[MAX_ITEMS];
static uint Item, Size, Group;
static struct {
  entry *run;
  uint *out, *t;
  const uint *in;
  uint k;
} Call;

static void barrier(int fence) {
  (void)fence;
  swapcontext(&Items[Item], &Scheduler);
}
static uint get_local_id(int d) { return d == 0 ? Item : 0; }
static uint get_local_size(int d) { return d == 0 ? Size : 1; }
static uint get_global_id(int d) { return d == 0 ? Group * Size + Item : 0; }
static uint get_group_id(int d) { return d == 0 ? Group : 0; }
static uint atomic_add(uint *p, uint v) {
  uint old = *p;
  *p += v;
  return old;
}
static uint atomic_max(uint *p, uint v) {
  uint old = *p;
  if (v > old)
    *p = v;
  return old;
}
static uint atomic_xor(uint *p, uint v) {
  uint old = *p;
  *p ^= v;
  return old;
}
static uint as_uint(float f) {
  union {
    float f;
    uint u;
  } both = {f};
  return both.u;
}

static void run_item(void) {
  Call.run(Call.out, Call.in, Call.t, Call.k);
  Done[Item] = 1;
}

/* Runs a group. Work-items that have ended take no part in the barriers of the
   others. Without MAY_RETURN the exit code is 1 if there are any: then the
   generator made no valid program. */
static void run_group(void) {
  memset(Done, 0, sizeof Done);
  for (uint i = 0; i < Size; i++) {
    getcontext(&Items[i]);
    Items[i].uc_stack.ss_sp = Stacks[i];
    Items[i].uc_stack.ss_size = STACK_BYTES;
    Items[i].uc_link = &Scheduler;
    makecontext(&Items[i], run_item, 0);
  }
  uint ended;
  do {
    ended = 0;
    for (Item = 0; Item < Size; Item++) {
      if (!Done[Item])
        swapcontext(&Scheduler, &Items[Item]);
      ended += Done[Item];
    }
    if (!MAY_RETURN && ended != 0 && ended != Size) {
      fprintf(stderr, "work-items part at a barrier\n");
      exit(1);
    }
  } while (ended != Size);
}

static void run_kernel(entry *run, uint size, uint groups, uint words,
                       const uint *in, uint k) {
  static uint out[1 << 16], t[LOCAL_WORDS * MAX_ITEMS];
  memset(out, 0, 4 * words);
  Size = size;
  for (Group = 0; Group < groups; Group++) {
    Call.run = run;
    Call.out = out;
    Call.in = in;
    Call.t = t;
    Call.k = k;
    run_group();
  }
  fwrite(out, 4, words, stdout);
}
