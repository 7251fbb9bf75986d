#include "pocl_spirv_words.h"

#include "pocl_spirv.h"

#include <stdlib.h>

/* Lanes of a vector. */
enum { MOST_LANES = 16 };
/* As a component of a shuffle: any value. */
#define UNDEFINED 0xffffffffU

/* A type of values, or with the kind 0 none that is of interest here. */
typedef struct {
  uint32_t kind;
  uint32_t size;    /* bits of a number, lanes of a vector */
  uint32_t element; /* of a vector: the number of its lanes' type */
} value_type;

/* What is known of results, by number. */
typedef struct {
  uint32_t count;
  value_type *types; /* of a type */
  uint32_t *type_of; /* of a value: its type's number, if that is of interest */
} results;

typedef struct {
  uint32_t *words; /* a null pointer once there was no memory */
  size_t count;
  size_t room;
} growing;

static void append(growing *out, uint32_t word) {
  if (out->words && out->count == out->room) {
    out->room *= 2;
    uint32_t *more = realloc(out->words, out->room * sizeof(*more));
    if (!more)
      free(out->words);
    out->words = more;
  }
  if (out->words)
    out->words[out->count++] = word;
}

static void append_head(growing *out, uint32_t kind, size_t words) {
  append(out, (uint32_t)words << 16 | kind);
}

static value_type type_with(const results *all, uint32_t number) {
  const value_type none = {0, 0, 0};
  return number < all->count ? all->types[number] : none;
}

static uint32_t type_number_of(const results *all, uint32_t value) {
  return value < all->count ? all->type_of[value] : 0;
}

/* Types are declared before values, and behind all that only names or decorates
 * them. So an instruction whose first operand is such a type has a result. */
static void learn(results *all, const void *il, size_t at) {
  const uint32_t kind = kind_at(il, at), size = size_at(il, at);
  if (size < 2)
    return;
  const uint32_t first = word_at(il, at + 1);
  if (kind >= OP_TYPE_BOOL && kind <= OP_TYPE_VECTOR) {
    const uint32_t of_lanes = kind == OP_TYPE_VECTOR;
    if (first < all->count && (kind == OP_TYPE_BOOL || size > 2 + of_lanes)) {
      all->types[first].kind = kind;
      all->types[first].size =
          kind == OP_TYPE_BOOL ? 1 : word_at(il, at + 2 + of_lanes);
      all->types[first].element = of_lanes ? word_at(il, at + 2) : 0;
    }
  } else if (size > 2 && type_with(all, first).kind != 0 &&
             word_at(il, at + 2) < all->count)
    all->type_of[word_at(il, at + 2)] = first;
}

/* A null of a scalar, as the constant 0. Whether it was one. */
static int append_scalar_null(growing *out, const results *all, const void *il,
                              size_t at) {
  if (kind_at(il, at) != OP_CONSTANT_NULL || size_at(il, at) != 3)
    return 0;
  const value_type type = type_with(all, word_at(il, at + 1));
  if (type.kind == 0 || type.kind == OP_TYPE_VECTOR || type.size > 64)
    return 0;
  const int is_bool = type.kind == OP_TYPE_BOOL;
  const uint32_t digits = is_bool ? 0 : type.size > 32 ? 2 : 1;
  append_head(out, is_bool ? OP_CONSTANT_FALSE : OP_CONSTANT, 3 + digits);
  append(out, word_at(il, at + 1));
  append(out, word_at(il, at + 2));
  for (uint32_t i = 0; i < digits; ++i)
    append(out, 0);
  return 1;
}

/* A shuffle of vectors with different numbers of lanes, as one that widens the
 * narrower vector, and a shuffle of equally wide ones. Whether it was one. */
static int append_uneven_shuffle(growing *out, const results *all,
                                 const void *il, size_t at, uint32_t *unused) {
  if (kind_at(il, at) != OP_VECTOR_SHUFFLE || size_at(il, at) < 5)
    return 0;
  uint32_t vectors[2], lanes[2];
  for (int i = 0; i < 2; ++i) {
    vectors[i] = word_at(il, at + 3 + i);
    const value_type type = type_with(all, type_number_of(all, vectors[i]));
    lanes[i] = type.kind == OP_TYPE_VECTOR ? type.size : 0;
    if (lanes[i] == 0 || lanes[i] > MOST_LANES)
      return 0;
  }
  if (lanes[0] == lanes[1])
    return 0;
  const int narrow = lanes[1] < lanes[0];
  const uint32_t wide = lanes[!narrow];
  const uint32_t widened = (*unused)++;
  append_head(out, OP_VECTOR_SHUFFLE, 5 + wide);
  append(out, type_number_of(all, vectors[!narrow]));
  append(out, widened);
  append(out, vectors[narrow]);
  append(out, vectors[narrow]);
  for (uint32_t lane = 0; lane < wide; ++lane)
    append(out, lane < lanes[narrow] ? lane : UNDEFINED);
  append(out, word_at(il, at));
  append(out, word_at(il, at + 1));
  append(out, word_at(il, at + 2));
  append(out, narrow == 0 ? widened : vectors[0]);
  append(out, narrow == 1 ? widened : vectors[1]);
  for (uint32_t word = 5; word < size_at(il, at); ++word) {
    const uint32_t lane = word_at(il, at + word);
    append(out, lane >= lanes[0] && lane != UNDEFINED ? lane - lanes[0] + wide
                                                      : lane);
  }
  return 1;
}

/* Puts values into a composite, one after the other. */
typedef struct {
  growing *out;
  uint32_t type;
  uint32_t composite; /* what is put together so far */
  uint32_t index;     /* of the next value */
} inserting;

static void insert(inserting *to, uint32_t value, uint32_t result) {
  append_head(to->out, OP_COMPOSITE_INSERT, 6);
  append(to->out, to->type);
  append(to->out, result);
  append(to->out, value);
  append(to->out, to->composite);
  append(to->out, to->index++);
  to->composite = result;
}

static uint32_t append_lane(growing *out, uint32_t type, uint32_t vector,
                            uint32_t lane, uint32_t result) {
  append_head(out, OP_COMPOSITE_EXTRACT, 5);
  append(out, type);
  append(out, result);
  append(out, vector);
  append(out, lane);
  return result;
}

/* Lanes that a part of a vector brings; of another composite, 0. */
static uint32_t lanes_in(const results *all, uint32_t type, uint32_t part) {
  const value_type parts = type_with(all, type_number_of(all, part));
  const int are_lanes = type_with(all, type).kind == OP_TYPE_VECTOR &&
                        parts.kind == OP_TYPE_VECTOR &&
                        parts.size <= MOST_LANES;
  return are_lanes ? parts.size : 0;
}

/* A composite of values, as insertions into one of any values. Parts of a
 * vector may be vectors, whose lanes follow each other. Whether it was one. */
static int append_composite(growing *out, const results *all, const void *il,
                            size_t at, uint32_t *unused) {
  const uint32_t size = size_at(il, at);
  if (kind_at(il, at) != OP_COMPOSITE_CONSTRUCT || size < 4)
    return 0;
  const uint32_t type = word_at(il, at + 1), result = word_at(il, at + 2);
  inserting to = {out, type, (*unused)++, 0};
  append_head(out, OP_UNDEF, 3);
  append(out, type);
  append(out, to.composite);
  for (uint32_t word = 3; word < size; ++word) {
    const uint32_t part = word_at(il, at + word);
    const uint32_t lanes = lanes_in(all, type, part);
    const int is_last = word + 1 == size;
    if (lanes == 0)
      insert(&to, part, is_last ? result : (*unused)++);
    for (uint32_t lane = 0; lane < lanes; ++lane) {
      const uint32_t value = append_lane(out, type_with(all, type).element,
                                         part, lane, (*unused)++);
      insert(&to, value, is_last && lane + 1 == lanes ? result : (*unused)++);
    }
  }
  return 1;
}

void *pocl_spirv_common_forms(const void *il, size_t *length) {
  const size_t words = *length / sizeof(uint32_t);
  uint32_t unused = word_at(il, 3);
  results all;
  all.count = unused <= MOST_RESULTS ? unused : MOST_RESULTS + 1;
  all.types = calloc((size_t)all.count + 1, sizeof(*all.types));
  all.type_of = calloc((size_t)all.count + 1, sizeof(*all.type_of));
  growing out = {NULL, 0, words + 1};
  if (all.types && all.type_of)
    out.words = malloc(out.room * sizeof(*out.words));
  for (size_t word = 0; word < HEADER_WORDS; ++word)
    append(&out, word_at(il, word));
  for (size_t at = HEADER_WORDS; out.words && at < words;
       at += size_at(il, at)) {
    learn(&all, il, at);
    if (!append_scalar_null(&out, &all, il, at) &&
        !append_uneven_shuffle(&out, &all, il, at, &unused) &&
        !append_composite(&out, &all, il, at, &unused))
      for (uint32_t word = 0; word < size_at(il, at); ++word)
        append(&out, word_at(il, at + word));
  }
  free(all.types);
  free(all.type_of);
  if (out.words)
    out.words[3] = unused;
  *length = out.count * sizeof(*out.words);
  return out.words;
}
