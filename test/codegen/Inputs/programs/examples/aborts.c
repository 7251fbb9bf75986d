/* Fails on every machine, and so judges none. */
#include <stdlib.h>

int main(void) { abort(); }
