/* Stands for CoreMark's header: what a port is asked for. */
#include "core_portme.h"

#if HAS_PRINTF
#define ee_printf printf
#endif
#if HAS_FLOAT
typedef double secs_ret;
#endif

void start_time(void);
void stop_time(void);
CORE_TICKS get_time(void);
secs_ret time_in_secs(CORE_TICKS ticks);
