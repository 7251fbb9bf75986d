/* The memory functions that the compiler calls by itself. Words where both
   addresses allow it (misaligned accesses trap), bytes elsewhere. */

#include <stddef.h>
#include <stdint.h>

typedef uint32_t __attribute__((may_alias)) word;

static int aligned(const void *a, const void *b) {
  return (((uintptr_t)a | (uintptr_t)b) % sizeof(word)) == 0;
}

void *memcpy(void *restrict to, const void *restrict from, size_t size) {
  unsigned char *t = to;
  const unsigned char *f = from;
  if (aligned(t, f))
    for (; size >= sizeof(word); size -= sizeof(word)) {
      *(word *)t = *(const word *)f;
      t += sizeof(word);
      f += sizeof(word);
    }
  for (; size; --size)
    *t++ = *f++;
  return to;
}

void *memmove(void *to, const void *from, size_t size) {
  /* Unsigned: also true where to lies before from. */
  if ((uintptr_t)to - (uintptr_t)from >= size)
    return memcpy(to, from, size);
  unsigned char *t = (unsigned char *)to + size;
  const unsigned char *f = (const unsigned char *)from + size;
  if (aligned(t, f))
    for (; size >= sizeof(word); size -= sizeof(word)) {
      t -= sizeof(word);
      f -= sizeof(word);
      *(word *)t = *(const word *)f;
    }
  for (; size; --size)
    *--t = *--f;
  return to;
}

void *memset(void *to, int value, size_t size) {
  unsigned char *t = to;
  const word repeated = (unsigned char)value * 0x01010101u;
  if (aligned(t, t))
    for (; size >= sizeof(word); size -= sizeof(word)) {
      *(word *)t = repeated;
      t += sizeof(word);
    }
  for (; size; --size)
    *t++ = (unsigned char)value;
  return to;
}

int memcmp(const void *left, const void *right, size_t size) {
  const unsigned char *l = left, *r = right;
  for (; size; --size, ++l, ++r)
    if (*l != *r)
      return *l - *r;
  return 0;
}

size_t strlen(const char *text) {
  size_t size = 0;
  while (text[size])
    ++size;
  return size;
}
