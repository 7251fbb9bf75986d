#ifndef ASSERT_H
#define ASSERT_H
#include <stdlib.h>
#define assert(condition) ((condition) ? (void)0 : abort())
#endif
