kernel void first(global uint *p) {
  p[0] = 1;
  while (1)
    ;
}
kernel void wait(global uint *p) {
  p[0] = 7;
  for (;;) {
    if (p[0] == 9)
      break;
    p[1]++;
  }
  p[2] = 3;
}
