#include "pocl_spirv.h"

#include "pocl_spirv_words.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* 1.4: the translator writes this version, though it does not read all of it.
 * It says itself what it does not know. */
#define NEWEST_VERSION 0x10400U

enum { DECORATION_SPEC_ID = 1, DECORATION_LINKAGE = 41 };
enum { CAPABILITY_SHADER = 1, CAPABILITY_KERNEL = 6 };
enum { ADDRESSING_PHYSICAL32 = 1, ADDRESSING_PHYSICAL64 = 2 };

/* What a device must have for a capability. */
typedef enum {
  FEATURE_DOUBLE,
  FEATURE_HALF,
  FEATURE_LONG_ATOMICS,
  FEATURE_IMAGES,
  FEATURE_SUBGROUPS,
  FEATURE_NONE /* no device has it */
} feature;

/* Capabilities without a row are every device's, or the translator's to
 * refuse. GenericPointer has none: OpenCL 1.2 needs it for events of copies,
 * and where all memories have one address space nothing is wrong with it. */
static const struct {
  uint32_t number;
  const char *name;
  feature needs;
} capabilities[] = {
    {9, "Float16", FEATURE_HALF},
    {10, "Float64", FEATURE_DOUBLE},
    {12, "Int64Atomics", FEATURE_LONG_ATOMICS},
    {13, "ImageBasic", FEATURE_IMAGES},
    {14, "ImageReadWrite", FEATURE_IMAGES},
    {15, "ImageMipmap", FEATURE_NONE},
    {17, "Pipes", FEATURE_NONE},
    {18, "Groups", FEATURE_SUBGROUPS},
    {19, "DeviceEnqueue", FEATURE_NONE},
    {20, "LiteralSampler", FEATURE_IMAGES},
    {43, "Sampled1D", FEATURE_IMAGES},
    {44, "Image1D", FEATURE_IMAGES},
    {46, "SampledBuffer", FEATURE_IMAGES},
    {47, "ImageBuffer", FEATURE_IMAGES},
    {58, "SubgroupDispatch", FEATURE_NONE},
    {59, "NamedBarrier", FEATURE_NONE},
    {60, "PipeStorage", FEATURE_NONE},
    {61, "GroupNonUniform", FEATURE_SUBGROUPS},
};

static int offers(cl_device_id device, feature needed) {
  switch (needed) {
  case FEATURE_DOUBLE:
    return device->double_fp_config != 0;
  case FEATURE_HALF:
    return device->half_fp_config != 0;
  case FEATURE_LONG_ATOMICS:
    return strstr(device->extensions, "cl_khr_int64_base_atomics") != NULL;
  case FEATURE_IMAGES:
    return device->image_support != CL_FALSE;
  case FEATURE_SUBGROUPS:
    return device->max_num_sub_groups != 0;
  case FEATURE_NONE:
    break;
  }
  return 0;
}

/* The first instruction of this kind at or after the word *at, which moves
 * there, or 0. */
static int find(const void *il, size_t length, uint32_t kind, size_t *at) {
  const size_t words = length / sizeof(uint32_t);
  for (; *at < words; *at += size_at(il, *at))
    if (kind_at(il, *at) == kind)
      return 1;
  return 0;
}

static int has_capability(const void *il, size_t length, uint32_t number) {
  size_t at = HEADER_WORDS;
  for (; find(il, length, OP_CAPABILITY, &at); at += size_at(il, at))
    if (word_at(il, at + 1) == number)
      return 1;
  return 0;
}

/* Words that an instruction has at least, as far as they are read here. */
static uint32_t least_words(uint32_t kind) {
  switch (kind) {
  case OP_CAPABILITY:
    return 2;
  case OP_MEMORY_MODEL:
  case OP_DECORATE:
    return 3;
  case OP_ENTRY_POINT:
  case OP_FUNCTION_CALL:
  case OP_VARIABLE:
    return 4;
  case OP_FUNCTION:
    return 5;
  default:
    return 1;
  }
}

/* The function or variable that the instruction at this word tells of, or 0. */
static uint32_t told_of(const void *il, size_t at) {
  switch (kind_at(il, at)) {
  case OP_ENTRY_POINT:
    return word_at(il, at + 2);
  case OP_FUNCTION_CALL:
    return word_at(il, at + 3);
  case OP_DECORATE:
    return word_at(il, at + 2) == DECORATION_LINKAGE ? word_at(il, at + 1) : 0;
  default:
    return 0;
  }
}

/* What is missing if the module ends before it is whole, or a null pointer.
 * Functions come last, and what is told of them comes before. */
static const char *missing_at_end(const void *il, size_t length) {
  const size_t words = length / sizeof(uint32_t);
  size_t at = HEADER_WORDS;
  if (!find(il, length, OP_MEMORY_MODEL, &at))
    return "a memory model";
  unsigned char *is_there = calloc(MOST_RESULTS + 1, 1);
  if (!is_there)
    return NULL; /* the translator finds out */
  int is_inside = 0;
  for (at = HEADER_WORDS; at < words; at += size_at(il, at)) {
    const uint32_t kind = kind_at(il, at);
    if (kind == OP_FUNCTION || kind == OP_VARIABLE)
      is_there[word_at(il, at + 2) & MOST_RESULTS] = 1;
    if (kind == OP_FUNCTION || kind == OP_FUNCTION_END)
      is_inside = kind == OP_FUNCTION;
  }
  int is_whole = 1;
  for (at = HEADER_WORDS; at < words; at += size_at(il, at)) {
    const uint32_t result = told_of(il, at);
    is_whole &= result == 0 || is_there[result & MOST_RESULTS];
  }
  free(is_there);
  return is_inside   ? "the end of its last function"
         : !is_whole ? "a function or variable that it tells of"
                     : NULL;
}

int pocl_spirv_is_kernel_module(const void *il, size_t length,
                                char text[POCL_SPIRV_TEXT]) {
  const size_t words = length / sizeof(uint32_t);
  if (words < HEADER_WORDS || word_at(il, 0) != MAGIC) {
    snprintf(text, POCL_SPIRV_TEXT,
             "%zu bytes are no module of SPIR-V, expected its header", length);
    return 0;
  }
  if (length % sizeof(uint32_t) != 0) {
    snprintf(text, POCL_SPIRV_TEXT,
             "the module of SPIR-V has %zu bytes, expected whole words of 4",
             length);
    return 0;
  }
  for (size_t at = HEADER_WORDS; at < words;) {
    const uint32_t size = size_at(il, at);
    const uint32_t kind = kind_at(il, at);
    if (size < least_words(kind) || size > words - at) {
      snprintf(text, POCL_SPIRV_TEXT,
               "the module of SPIR-V is damaged: the instruction at byte %zu "
               "has %u words, %zu are left",
               at * sizeof(uint32_t), size, words - at);
      return 0;
    }
    at += size;
  }
  if (has_capability(il, length, CAPABILITY_KERNEL)) {
    const char *missing = missing_at_end(il, length);
    if (!missing)
      return 1;
    snprintf(text, POCL_SPIRV_TEXT,
             "the module of SPIR-V is cut off, expected %s behind byte %zu",
             missing, length);
    return 0;
  }
  snprintf(text, POCL_SPIRV_TEXT,
           has_capability(il, length, CAPABILITY_SHADER)
               ? "the module of SPIR-V is for Vulkan (capability Shader), "
                 "expected one for OpenCL (capability Kernel)"
               : "the module of SPIR-V has no capability Kernel, expected one "
                 "for OpenCL");
  return 0;
}

int pocl_spirv_is_offered(cl_device_id device, const void *il, size_t length,
                          char text[POCL_SPIRV_TEXT]) {
  if (word_at(il, 1) > NEWEST_VERSION) {
    snprintf(text, POCL_SPIRV_TEXT,
             "the module is of SPIR-V %u.%u, expected 1.4 at most",
             word_at(il, 1) >> 16 & 0xff, word_at(il, 1) >> 8 & 0xff);
    return 0;
  }
  size_t at = HEADER_WORDS;
  const uint32_t addressing = find(il, length, OP_MEMORY_MODEL, &at)
                                  ? word_at(il, at + 1)
                                  : ADDRESSING_PHYSICAL32;
  if (addressing != (device->address_bits == 32 ? ADDRESSING_PHYSICAL32
                                                : ADDRESSING_PHYSICAL64)) {
    snprintf(text, POCL_SPIRV_TEXT,
             "the module's addresses are %s, the device's have %u bits",
             addressing == ADDRESSING_PHYSICAL64   ? "Physical64"
             : addressing == ADDRESSING_PHYSICAL32 ? "Physical32"
                                                   : "not physical",
             device->address_bits);
    return 0;
  }
  for (size_t i = 0; i < sizeof(capabilities) / sizeof(capabilities[0]); ++i)
    if (has_capability(il, length, capabilities[i].number) &&
        !offers(device, capabilities[i].needs)) {
      snprintf(text, POCL_SPIRV_TEXT,
               "the module needs the capability %s, which the device does not "
               "offer",
               capabilities[i].name);
      return 0;
    }
  return 1;
}

static void set_word(void *il, size_t index, uint32_t word) {
  memcpy((char *)il + index * sizeof(word), &word, sizeof(word));
}

/* The constant whose result has this number gets the value. One of 64 bits has
 * two words, the lower first; a truth value has none, but two instructions. */
static void specialize_result(void *il, size_t length, uint32_t result,
                              uint64_t value) {
  for (size_t at = HEADER_WORDS; at < length / sizeof(uint32_t);
       at += size_at(il, at)) {
    const uint32_t size = size_at(il, at);
    const uint32_t kind = kind_at(il, at);
    if (kind < OP_SPEC_CONSTANT_TRUE || kind > OP_SPEC_CONSTANT || size < 3 ||
        word_at(il, at + 2) != result)
      continue;
    if (kind != OP_SPEC_CONSTANT)
      set_word(il, at,
               size << 16 |
                   (value ? OP_SPEC_CONSTANT_TRUE : OP_SPEC_CONSTANT_FALSE));
    for (uint32_t word = 3; kind == OP_SPEC_CONSTANT && word < size && word < 5;
         ++word)
      set_word(il, at + word, (uint32_t)(value >> 32 * (word - 3)));
  }
}

/* The next decoration at or after the word *at that makes a constant one of
 * specialization, or 0. */
static int find_spec_id(const void *il, size_t length, size_t *at) {
  for (; find(il, length, OP_DECORATE, at); *at += size_at(il, *at))
    if (size_at(il, *at) >= 4 && word_at(il, *at + 2) == DECORATION_SPEC_ID)
      return 1;
  return 0;
}

/* Gives the specialization constant with this SpecId its value, of as many bits
 * as it has. The translator has an option for this, but refuses values of 64
 * bits that have 17 digits. */
static void specialize(void *il, size_t length, uint32_t id, uint64_t value) {
  for (size_t at = HEADER_WORDS; find_spec_id(il, length, &at);
       at += size_at(il, at))
    if (word_at(il, at + 3) == id)
      specialize_result(il, length, word_at(il, at + 1), value);
}

/* The bytes of numbers of this type; 0 of another. */
static cl_uint bytes_of_type(const void *il, size_t length, uint32_t type) {
  for (size_t at = HEADER_WORDS; at < length / sizeof(uint32_t);
       at += size_at(il, at)) {
    const uint32_t kind = kind_at(il, at), size = size_at(il, at);
    if (kind < OP_TYPE_BOOL || kind > OP_TYPE_FLOAT || size < 2 ||
        word_at(il, at + 1) != type)
      continue;
    return kind == OP_TYPE_BOOL ? 1 : size > 2 ? word_at(il, at + 2) / 8 : 0;
  }
  return 0;
}

/* The bytes of the specialization constant whose result has this number; 0 of
 * another result. */
static cl_uint bytes_of_constant(const void *il, size_t length,
                                 uint32_t result) {
  for (size_t at = HEADER_WORDS; at < length / sizeof(uint32_t);
       at += size_at(il, at)) {
    const uint32_t kind = kind_at(il, at);
    if (kind >= OP_SPEC_CONSTANT_TRUE && kind <= OP_SPEC_CONSTANT &&
        size_at(il, at) >= 3 && word_at(il, at + 2) == result)
      return bytes_of_type(il, length, word_at(il, at + 1));
  }
  return 0;
}

int pocl_spirv_find_constants(cl_program program) {
  const void *il = program->program_il;
  const size_t length = program->program_il_size;
  size_t most = 0;
  for (size_t at = HEADER_WORDS; find_spec_id(il, length, &at);
       at += size_at(il, at))
    ++most;
  if (most == 0)
    return 0;
  program->spec_const_ids = calloc(most, sizeof(*program->spec_const_ids));
  program->spec_const_sizes = calloc(most, sizeof(*program->spec_const_sizes));
  program->spec_const_values =
      calloc(most, sizeof(*program->spec_const_values));
  program->spec_const_is_set =
      calloc(most, sizeof(*program->spec_const_is_set));
  if (!program->spec_const_ids || !program->spec_const_sizes ||
      !program->spec_const_values || !program->spec_const_is_set)
    return -1;
  for (size_t at = HEADER_WORDS; find_spec_id(il, length, &at);
       at += size_at(il, at)) {
    const cl_uint bytes = bytes_of_constant(il, length, word_at(il, at + 1));
    if (bytes == 0 || bytes > sizeof(*program->spec_const_values))
      continue;
    program->spec_const_ids[program->num_spec_consts] = word_at(il, at + 3);
    program->spec_const_sizes[program->num_spec_consts++] = bytes;
  }
  return 0;
}

void *pocl_spirv_specialized(cl_program program, size_t *length) {
  *length = program->program_il_size;
  void *il = pocl_spirv_common_forms(program->program_il, length);
  for (size_t i = 0; il && i < program->num_spec_consts; ++i)
    if (program->spec_const_is_set[i])
      specialize(il, *length, program->spec_const_ids[i],
                 program->spec_const_values[i]);
  return il;
}
