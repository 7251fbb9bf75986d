/// Prints the same on the device as on the host (cxx.test).

extern "C" int printf(const char *, ...);
extern "C" int atexit(void (*)(void));

namespace {

struct Named {
  const char *Name;
  int Value;
  Named(const char *Name, int Value) : Name(Name), Value(Value) {
    printf("+%s\n", Name);
  }
  ~Named() { printf("-%s\n", Name); }
};

Named First("first", 1);
Named Second("second", First.Value + 1);

__attribute__((constructor)) void construct() {
  printf("constructor function\n");
}
__attribute__((destructor)) void destroy() { printf("destructor function\n"); }

/// Shared by all lanes, of which one constructs it.
int local() {
  static Named Local("local", 77);
  return Local.Value;
}

struct Shape {
  virtual ~Shape() { printf("~Shape %d\n", Sides); }
  virtual int area() const = 0;
  int Sides = 0;
};
struct Square : Shape {
  explicit Square(int Size) : Size(Size) { Sides = 4; }
  ~Square() override { printf("~Square %d\n", Size); }
  int area() const override { return Size * Size; }
  int Size;
};
struct Removed : Shape {
  int area() const override { return -1; }
  virtual void remove() = delete;
};
struct Flag {
  virtual ~Flag() { printf("~Flag\n"); }
  virtual int colours() const { return 3; }
};
struct Banner final : Square, virtual Flag {
  Banner() : Square(5) {}
  ~Banner() override { printf("~Banner\n"); }
  int colours() const override { return Size; }
};

alignas(16) unsigned char Heap[1024];
unsigned Used;
Named *volatile Array; // or its making would be optimised away

} // namespace

// A program with its own operator new has its own operator delete.
void *operator new(decltype(sizeof 0) Size) {
  unsigned char *At = Heap + Used;
  Used += (Size + 15) / 16 * 16;
  return At;
}
void operator delete(void *At) noexcept {
  printf("delete %d\n", (unsigned char *)At >= Heap);
}

int main() {
#ifdef __riscv
  unsigned Hart;
  asm("csrr %0, mhartid" : "=r"(Hart));
#else
  unsigned Hart = 0;
#endif
  if (Hart == 0) {
    atexit([] {
      printf("at exit\n");
      atexit([] {
        static Named Late("late", 1);
        printf("registered at exit\n");
      });
    });
    Shape *Shapes[] = {new Square(3), new Banner};
    for (Shape *S : Shapes)
      printf("area %d\n", S->area());
    Flag *F = static_cast<Banner *>(Shapes[1]);
    printf("colours %d\n", F->colours());
    delete F;
    delete Shapes[0];
    Array = new Named[1]{{"array", 1}};
    delete[] Array;
    Square Automatic(2);
    Removed Last;
  }
  printf("local %d\n", local());
  return 0;
}
