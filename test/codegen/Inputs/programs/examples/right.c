#include <assert.h>
#include <string.h>

volatile unsigned Word = 0x01020304;

int main(void) {
  char text[8];
  assert(__builtin_bswap32(Word) == 0x04030201);
  assert(strcmp(strcpy(text, "abc"), "abc") == 0);
  exit(0);
}
