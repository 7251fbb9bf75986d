/// Replaces a program's allocation functions: large blocks lie in large pages
/// of the host. Linked into programs of ours alone, never into a library,
/// because the process of a library belongs to somebody else.
///
/// Scenes, uploads and pictures are blocks of many megabytes, most of which are
/// written once. In pages of 4 KiB, more than a third of the time from a
/// command to its picture went into page faults (docs/adr/0009-large-pages.md).

#include <algorithm>
#include <cstdlib>
#include <new>
#include <sys/mman.h>

namespace {

/// Of x86-64 hosts, and of most others.
constexpr std::size_t LargePage = std::size_t(2) << 20;

void *allocate(std::size_t Size) {
  if (Size < LargePage)
    return std::malloc(std::max<std::size_t>(Size, 1));
  void *const Block = std::aligned_alloc(LargePage, Size);
  // Of whole pages only, so that a block takes no more memory than it asked
  // for. Hosts that have no large pages say no, and nothing is lost.
  if (Block)
    ::madvise(Block, Size / LargePage * LargePage, MADV_HUGEPAGE);
  return Block;
}

} // namespace

void *operator new(std::size_t Size) {
  for (;;) {
    if (void *const Block = allocate(Size))
      return Block;
    const std::new_handler Handler = std::get_new_handler();
    if (!Handler)
      throw std::bad_alloc();
    Handler();
  }
}

void operator delete(void *Block) noexcept { std::free(Block); }

void operator delete(void *Block, std::size_t /*Size*/) noexcept {
  std::free(Block);
}
