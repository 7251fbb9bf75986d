/* The words of a module of SPIR-V, for those who read it here. The numbers are
 * those of the specification. */
#ifndef POCL_SPIRV_WORDS_H
#define POCL_SPIRV_WORDS_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define MAGIC 0x07230203U
#define HEADER_WORDS 5

enum {
  OP_UNDEF = 1,
  OP_MEMORY_MODEL = 14,
  OP_ENTRY_POINT = 15,
  OP_CAPABILITY = 17,
  OP_TYPE_BOOL = 20,
  OP_TYPE_INT = 21,
  OP_TYPE_FLOAT = 22,
  OP_TYPE_VECTOR = 23,
  OP_CONSTANT_FALSE = 42,
  OP_CONSTANT = 43,
  OP_CONSTANT_NULL = 46,
  OP_SPEC_CONSTANT_TRUE = 48,
  OP_SPEC_CONSTANT_FALSE = 49,
  OP_SPEC_CONSTANT = 50,
  OP_FUNCTION = 54,
  OP_FUNCTION_END = 56,
  OP_FUNCTION_CALL = 57,
  OP_VARIABLE = 59,
  OP_DECORATE = 71,
  OP_VECTOR_SHUFFLE = 79,
  OP_COMPOSITE_CONSTRUCT = 80,
  OP_COMPOSITE_EXTRACT = 81,
  OP_COMPOSITE_INSERT = 82
};

/* No number of a result is larger: the specification's universal limit. */
enum { MOST_RESULTS = 0x3fffff };

static inline uint32_t word_at(const void *il, size_t index) {
  uint32_t word;
  memcpy(&word, (const char *)il + index * sizeof(word), sizeof(word));
  return word;
}

/* Of the instruction that begins at this word: what it is, and its words. */
static inline uint32_t kind_at(const void *il, size_t at) {
  return word_at(il, at) & 0xffff;
}
static inline uint32_t size_at(const void *il, size_t at) {
  return word_at(il, at) >> 16;
}

#endif
