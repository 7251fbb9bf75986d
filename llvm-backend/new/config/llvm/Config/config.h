// LLVM's private configuration is not installed; the tools' sources need no
// more of it than this.
#include "llvm/Config/llvm-config.h"
