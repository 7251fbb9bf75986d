/* Copies of a group have ended when their function returns. */

void _CL_OVERLOADABLE wait_group_events(int count, private event_t *events) {}

void _CL_OVERLOADABLE wait_group_events(int count, generic event_t *events) {}
