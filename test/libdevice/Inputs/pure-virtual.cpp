/// A constructor calls a function that its class does not have (cxx.test).
struct Base {
  Base() { call(); }
  void call() { function(); }
  virtual void function() = 0;
};

struct Derived : Base {
  void function() override {}
};

int main() {
  Derived D;
  return 0;
}
