// One function for each way in which lanes come apart (resources.test).

int way(int x, int *p) {
  if (x)
    p[0] = 3;
  return 5;
}

int own(int n) {
  volatile int counts[4] = {1, 2, 3, 4};
  int sum = 0;
  int i = 0;
  do
    sum += ++i;
  while (counts[i & 3] < n);
  return sum;
}

int leaves(int *p) {
  int sum = 0;
  while (p[sum] > 0) {
    if (p[sum] == 7)
      return 1;
    sum += p[sum];
  }
  return sum;
}

void together(int *p) {
  for (int i = 0; i < 100; ++i)
    p[i] = i;
}

int other(int x);

int keeps(int x) { return other(x) + x; }
