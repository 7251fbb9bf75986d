/* The atomics that OpenCL C has from C11. Those of OpenCL 1.2 are PoCL's.

   Q is the object's address space, T its type without "atomic_". A function
   comes with an order and a scope, with an order, and with neither. */

#ifdef cl_khr_int64_base_atomics
#define FOR_LONGS(M, ...) M(__VA_ARGS__, long) M(__VA_ARGS__, ulong)
#define FOR_DOUBLE(M, ...) __IF_FP64(M(__VA_ARGS__, double))
#else
#define FOR_LONGS(M, ...)
#define FOR_DOUBLE(M, ...)
#endif

#define FOR_SPACES(M) M(global) M(local) M(generic)
#define FOR_INTEGERS(M, ...)                                                   \
  M(__VA_ARGS__, int) M(__VA_ARGS__, uint) FOR_LONGS(M, __VA_ARGS__)
#define FOR_TYPES(M, ...)                                                      \
  FOR_INTEGERS(M, __VA_ARGS__) M(__VA_ARGS__, float) FOR_DOUBLE(M, __VA_ARGS__)

#define INIT(Q, T)                                                             \
  void _CL_OVERLOADABLE atomic_init(volatile Q atomic_##T *object, T value) {  \
    __opencl_atomic_init(object, value);                                       \
  }

#define STORE(Q, T)                                                            \
  void _CL_OVERLOADABLE atomic_store_explicit(volatile Q atomic_##T *object,   \
                                              T value, memory_order order,     \
                                              memory_scope scope) {            \
    __opencl_atomic_store(object, value, order, scope);                        \
  }                                                                            \
  void _CL_OVERLOADABLE atomic_store_explicit(volatile Q atomic_##T *object,   \
                                              T value, memory_order order) {   \
    __opencl_atomic_store(object, value, order, memory_scope_device);          \
  }                                                                            \
  void _CL_OVERLOADABLE atomic_store(volatile Q atomic_##T *object, T value) { \
    __opencl_atomic_store(object, value, memory_order_seq_cst,                 \
                          memory_scope_device);                                \
  }

#define LOAD(Q, T)                                                             \
  T _CL_OVERLOADABLE atomic_load_explicit(                                     \
      volatile Q atomic_##T *object, memory_order order, memory_scope scope) { \
    return __opencl_atomic_load(object, order, scope);                         \
  }                                                                            \
  T _CL_OVERLOADABLE atomic_load_explicit(volatile Q atomic_##T *object,       \
                                          memory_order order) {                \
    return __opencl_atomic_load(object, order, memory_scope_device);           \
  }                                                                            \
  T _CL_OVERLOADABLE atomic_load(volatile Q atomic_##T *object) {              \
    return __opencl_atomic_load(object, memory_order_seq_cst,                  \
                                memory_scope_device);                          \
  }

/* NAME begins with an underscore: min and max are macros of PoCL. */
#define CHANGE(Q, NAME, OPERAND, T)                                            \
  T _CL_OVERLOADABLE atomic##NAME##_explicit(                                  \
      volatile Q atomic_##T *object, OPERAND operand, memory_order order,      \
      memory_scope scope) {                                                    \
    return __opencl_atomic##NAME(object, operand, order, scope);               \
  }                                                                            \
  T _CL_OVERLOADABLE atomic##NAME##_explicit(                                  \
      volatile Q atomic_##T *object, OPERAND operand, memory_order order) {    \
    return __opencl_atomic##NAME(object, operand, order, memory_scope_device); \
  }                                                                            \
  T _CL_OVERLOADABLE atomic##NAME(volatile Q atomic_##T *object,               \
                                  OPERAND operand) {                           \
    return __opencl_atomic##NAME(object, operand, memory_order_seq_cst,        \
                                 memory_scope_device);                         \
  }
#define EXCHANGE(Q, T) CHANGE(Q, _exchange, T, T)
#define FETCH(Q, T)                                                            \
  CHANGE(Q, _fetch_add, T, T)                                                  \
  CHANGE(Q, _fetch_sub, T, T)                                                  \
  CHANGE(Q, _fetch_or, T, T)                                                   \
  CHANGE(Q, _fetch_xor, T, T)                                                  \
  CHANGE(Q, _fetch_and, T, T)                                                  \
  CHANGE(Q, _fetch_min, T, T)                                                  \
  CHANGE(Q, _fetch_max, T, T)

/* Of intptr_t and uintptr_t, with an operand of the other sign. */
#define MIXED(Q, OPERAND, T)                                                   \
  CHANGE(Q, _fetch_or, OPERAND, T)                                             \
  CHANGE(Q, _fetch_xor, OPERAND, T)                                            \
  CHANGE(Q, _fetch_and, OPERAND, T)                                            \
  CHANGE(Q, _fetch_min, OPERAND, T)

/* E: the address space of what is expected. STRENGTH: _strong or _weak. */
#define COMPARE(Q, E, STRENGTH, T)                                             \
  bool _CL_OVERLOADABLE atomic_compare_exchange##STRENGTH##_explicit(          \
      volatile Q atomic_##T *object, E T *expected, T desired,                 \
      memory_order success, memory_order failure, memory_scope scope) {        \
    T seen = *expected;                                                        \
    const bool same = __opencl_atomic_compare_exchange_strong(                 \
        object, &seen, desired, success, failure, scope);                      \
    *expected = seen;                                                          \
    return same;                                                               \
  }                                                                            \
  bool _CL_OVERLOADABLE atomic_compare_exchange##STRENGTH##_explicit(          \
      volatile Q atomic_##T *object, E T *expected, T desired,                 \
      memory_order success, memory_order failure) {                            \
    return atomic_compare_exchange##STRENGTH##_explicit(                       \
        object, expected, desired, success, failure, memory_scope_device);     \
  }                                                                            \
  bool _CL_OVERLOADABLE atomic_compare_exchange##STRENGTH(                     \
      volatile Q atomic_##T *object, E T *expected, T desired) {               \
    return atomic_compare_exchange##STRENGTH##_explicit(                       \
        object, expected, desired, memory_order_seq_cst, memory_order_seq_cst, \
        memory_scope_device);                                                  \
  }
#define COMPARES(Q, T)                                                         \
  COMPARE(Q, global, _strong, T)                                               \
  COMPARE(Q, local, _strong, T)                                                \
  COMPARE(Q, private, _strong, T)                                              \
  COMPARE(Q, generic, _strong, T)                                              \
  COMPARE(Q, global, _weak, T)                                                 \
  COMPARE(Q, local, _weak, T)                                                  \
  COMPARE(Q, private, _weak, T)                                                \
  COMPARE(Q, generic, _weak, T)

#define FLAG(Q)                                                                \
  bool _CL_OVERLOADABLE atomic_flag_test_and_set_explicit(                     \
      volatile Q atomic_flag *object, memory_order order,                      \
      memory_scope scope) {                                                    \
    return __opencl_atomic_exchange(object, 1, order, scope);                  \
  }                                                                            \
  bool _CL_OVERLOADABLE atomic_flag_test_and_set_explicit(                     \
      volatile Q atomic_flag *object, memory_order order) {                    \
    return __opencl_atomic_exchange(object, 1, order, memory_scope_device);    \
  }                                                                            \
  bool _CL_OVERLOADABLE atomic_flag_test_and_set(                              \
      volatile Q atomic_flag *object) {                                        \
    return __opencl_atomic_exchange(object, 1, memory_order_seq_cst,           \
                                    memory_scope_device);                      \
  }                                                                            \
  void _CL_OVERLOADABLE atomic_flag_clear_explicit(                            \
      volatile Q atomic_flag *object, memory_order order,                      \
      memory_scope scope) {                                                    \
    __opencl_atomic_store(object, 0, order, scope);                            \
  }                                                                            \
  void _CL_OVERLOADABLE atomic_flag_clear_explicit(                            \
      volatile Q atomic_flag *object, memory_order order) {                    \
    __opencl_atomic_store(object, 0, order, memory_scope_device);              \
  }                                                                            \
  void _CL_OVERLOADABLE atomic_flag_clear(volatile Q atomic_flag *object) {    \
    __opencl_atomic_store(object, 0, memory_order_seq_cst,                     \
                          memory_scope_device);                                \
  }

#define ALL_OF(Q)                                                              \
  FOR_TYPES(INIT, Q)                                                           \
  FOR_TYPES(STORE, Q)                                                          \
  FOR_TYPES(LOAD, Q)                                                           \
  FOR_TYPES(EXCHANGE, Q)                                                       \
  FOR_TYPES(COMPARES, Q)                                                       \
  FOR_INTEGERS(FETCH, Q)                                                       \
  /* uintptr_t and ptrdiff_t */                                                \
  CHANGE(Q, _fetch_add, int, uint)                                             \
  CHANGE(Q, _fetch_sub, int, uint)                                             \
  MIXED(Q, int, uint)                                                          \
  MIXED(Q, uint, int)                                                          \
  FLAG(Q)
FOR_SPACES(ALL_OF)
