/* Functions that are to run behind main(), the last first: of the C++ ABI
   (3.3.6), and atexit() of C. */
#include <stddef.h>
#include <stdint.h>
#include <vorion.h>

enum { MOST = 128 };

static struct {
  void (*run)(void *);
  void *object;
} functions[MOST];
static uint32_t count;

/* The program, of which there is one. */
void *const __dso_handle __attribute__((visibility("hidden"))) = NULL;

/* 0, or -1 if there are too many. */
int __cxa_atexit(void (*run)(void *), void *object, void *program) {
  (void)program;
  const uint32_t number = __atomic_fetch_add(&count, 1, __ATOMIC_RELAXED);
  if (number >= MOST)
    return -1;
  functions[number].run = run;
  functions[number].object = object;
  return 0;
}

/* One lane runs them. */
static void run_plain(void *function) {
  ((void (*)(void))vx_uniform((uint)function))();
}

int atexit(void (*function)(void)) {
  return __cxa_atexit(run_plain, (void *)function, NULL);
}

/* A function that one of them registers runs next. */
static void run_all(void) {
  if (count > MOST)
    count = MOST;
  while (count != 0) {
    const uint32_t last = --count;
    functions[last].run(functions[last].object);
  }
}

/* The first of the program's destructors (start/vorion.ld). */
__attribute__((section("vorion_exit"),
               used)) static void (*const run)(void) = run_all;
