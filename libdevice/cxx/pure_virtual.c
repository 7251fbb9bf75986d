/* What calls of virtual functions reach that have no right result: of pure
   ones, while their object is constructed or destroyed, and of deleted ones
   (C++ ABI, 3.2.6). */
void __cxa_pure_virtual(void) { __builtin_trap(); }
void __cxa_deleted_virtual(void) { __builtin_trap(); }
