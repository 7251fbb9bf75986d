/* Macros that use another macro once for every length of a vector. */
#ifndef VORION_SIZES_H
#define VORION_SIZES_H

/* M(number of elements, ...) */
#define FOR_VECTORS(M, ...)                                                    \
  M(2, __VA_ARGS__)                                                            \
  M(3, __VA_ARGS__)                                                            \
  M(4, __VA_ARGS__)                                                            \
  M(8, __VA_ARGS__)                                                            \
  M(16, __VA_ARGS__)

/* The number is empty for a scalar. */
#define FOR_SIZES(M, ...) M(, __VA_ARGS__) FOR_VECTORS(M, __VA_ARGS__)

#endif
