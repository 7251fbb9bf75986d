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

static int is_first(void) { return vx_core_id() == 0 && vx_thread_id() == 0; }

static void wait_for_all_cores(void) { vx_bar(1u << 31, vx_num_cores()); }

__attribute__((section("vorion_static_objects"))) int
vx_main_with_static_objects(void) {
  function *const *begin = vorion_constructors;
  function *const *end = vorion_constructors_end;
  if (is_first())
    for (; begin != end; ++begin)
      (*begin)();
  wait_for_all_cores();
  const int result = main(0, 0);
  begin = vorion_destructors;
  end = vorion_destructors_end;
  if (begin == end)
    return result;
  wait_for_all_cores();
  if (is_first())
    while (end != begin)
      (*--end)();
  return result;
}
