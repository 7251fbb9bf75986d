// Which depths are drawn. Written so that a NaN is none by both rules.
#pragma once

// The near plane's depth.
#pragma vorion choice float NEAR_LIMIT
// INRIA's rule: what lies in the near plane is not drawn.
#pragma vorion choice flag NEAR_IS_LEFT_OUT

#ifdef NEAR_IS_LEFT_OUT
#define KEEP_DEPTH(z) ((z) > NEAR_LIMIT)
#else
#define KEEP_DEPTH(z) ((z) >= NEAR_LIMIT)
#endif
