/* Each lane puts the address of a variable of its own where all lanes look. */
#include <assert.h>

int *volatile Pointer;

int main(void) {
  int own = 5;
  Pointer = &own;
  assert(Pointer == &own);
  return 0;
}
