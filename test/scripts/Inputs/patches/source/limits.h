#define MOST 7
