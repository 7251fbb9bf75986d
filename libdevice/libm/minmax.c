/* The lesser and the greater double. A NaN gives way to a number. */

double fmin(double x, double y) { return __builtin_isnan(y) || x < y ? x : y; }

double fmax(double x, double y) { return __builtin_isnan(y) || x > y ? x : y; }
