uint factor(uint i) { return 3 * i; }
