int counter;

int next(void) {
  return counter + 1;
}

int last(void) {
  return counter;
}
