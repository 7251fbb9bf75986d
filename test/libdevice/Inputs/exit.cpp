/// Ends in the way that MODE names, in some lanes, while static objects exist.
extern "C" {
int printf(const char *, ...);
int atexit(void (*)(void));
[[noreturn]] void exit(int);
[[noreturn]] void _Exit(int);
[[noreturn]] void abort();
}

#include <vorion.h>

namespace {

#ifdef OBJECTS
struct Object {
  Object() {
    printf("+object\n");
#ifdef IN_CONSTRUCTOR
    exit(4);
#endif
  }
  ~Object() { printf("-object\n"); }
} Static;
#endif

__attribute__((noinline)) void run(unsigned Core, unsigned Lane, int Depth) {
  if (Depth > 0)
    return run(Core, Lane, Depth - 1);
  if (Core == CORE && Lane % 3 == LANE) {
    printf("ends\n");
    MODE;
  }
  for (volatile int I = 0; I != 100; ++I) {
  }
}

} // namespace

int main() {
#ifdef REGISTERED
  if (vx_core_id() == 0 && vx_thread_id() == 0)
    atexit([] { printf("registered\n"); });
#endif
  run(vx_core_id(), vx_thread_id(), static_cast<int>(vx_thread_id() % 2));
#ifdef OFF
  vx_tmc(6);
#endif
  printf("main of a core returns\n");
  return 0;
}
