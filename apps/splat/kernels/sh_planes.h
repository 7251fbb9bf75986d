// Coefficient k, of those that are there, of channel c of Gaussian i is in
// plane 3 k + c.
#define SH(k, c) sh[(3 * (k) + (c)) * count + i]
