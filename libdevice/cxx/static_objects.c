/* What runs around main() where static objects have constructors or
   destructors: start.S calls this in the place of main() then
   (start/vorion.ld). All lanes share a static object, so one lane constructs it
   while all others wait. */
#include <vorion.h>

typedef void function(void);

/* Of start/vorion.ld. */
extern function *const vorion_constructors[], *const vorion_constructors_end[];
extern function *const vorion_destructors[], *const vorion_destructors_end[];

int main(int argc, char **argv);

#define INLINE __attribute__((always_inline)) static inline
#define BEHIND __attribute__((section("vorion_static_objects")))

/* Of the lanes that are active: main() may have switched some off. */
INLINE int is_first(void) {
  return vx_core_id() == 0 &&
         vx_thread_id() == (uint)__builtin_ctz(vx_active_threads());
}

INLINE void wait_for_all_cores(void) { vx_bar(1u << 31, vx_num_cores()); }

/* Of program/exit.c, which programs without exit() do not have. */
extern volatile int vx_is_constructed __attribute__((weak));

/* Behind main() of all lanes, or exit(): one lane destroys the objects when all
   cores are here, unless this core does not want it. */
BEHIND void vx_end_static_objects(int destroys) {
  function *const *begin = vorion_destructors;
  function *const *end = vorion_destructors_end;
  if (begin == end)
    return;
  wait_for_all_cores();
  if (destroys && is_first())
    while (end != begin)
      (*--end)();
}

BEHIND int vx_main_with_static_objects(void) {
  function *const *begin = vorion_constructors;
  function *const *end = vorion_constructors_end;
  if (is_first()) {
    for (; begin != end; ++begin)
      (*begin)();
    if (&vx_is_constructed)
      vx_is_constructed = 1;
  }
  wait_for_all_cores();
  const int result = main(0, 0);
  vx_end_static_objects(1);
  return result;
}
