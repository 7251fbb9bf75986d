/* What a call of a pure virtual function reaches, while its object is
   constructed or destroyed (C++ ABI, 3.2.6). It has no right result. */
void __cxa_pure_virtual(void) { __builtin_trap(); }
