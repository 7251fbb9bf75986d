#include "ProgramKernels.h"

extern "C" {
#include "pocl_cache.h"
#include "pocl_checked_file.h"
#include "pocl_file_util.h"
#include "pocl_util.h"
}

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

namespace vorion {

namespace {

std::string pathOf(cl_program Program, cl_uint Index) {
  char Folder[POCL_MAX_PATHNAME_LENGTH];
  pocl_cache_program_path(Folder, Program, Index);
  return std::string(Folder) + "/kernels";
}

// Everything is a number of 64 bits, or a text behind its length. One
// description serves both ways: visit() goes through all that is kept.

constexpr uint64_t NoText = ~uint64_t{0};

class Writer {
public:
  std::string Bytes;

  template <typename Number> void number(Number &Value) {
    raw(static_cast<uint64_t>(Value));
  }
  void text(char *&Text) {
    raw(Text ? strlen(Text) : NoText);
    if (Text)
      Bytes += Text;
  }
  template <typename Element> void array(Element *&, cl_uint &Size) {
    number(Size);
  }

private:
  void raw(uint64_t Value) {
    Bytes.append(reinterpret_cast<const char *>(&Value), sizeof(Value));
  }
};

/// Memory is what PoCL frees with the program.
class Reader {
public:
  Reader(const char *Bytes, size_t Size) : Next(Bytes), End(Bytes + Size) {}

  /// All bytes were read, and no more were asked for.
  bool isDone() const { return Next == End && !IsShort; }

  template <typename Number> void number(Number &Value) {
    Value = static_cast<Number>(raw());
  }
  void text(char *&Text) {
    const uint64_t Size = raw();
    Text = nullptr;
    if (Size == NoText)
      return;
    const size_t Given = std::min<uint64_t>(Size, End - Next);
    IsShort |= Given != Size;
    Text = strndup(Next, Given);
    Next += Given;
  }
  template <typename Element> void array(Element *&Elements, cl_uint &Size) {
    number(Size);
    // An element takes a number at least.
    if (Size > size_t(End - Next) / sizeof(uint64_t)) {
      IsShort = true;
      Size = 0;
    }
    Elements =
        Size ? static_cast<Element *>(calloc(Size, sizeof(Element))) : nullptr;
  }

private:
  uint64_t raw() {
    uint64_t Value = 0;
    if (size_t(End - Next) < sizeof(Value)) {
      IsShort = true;
      return 0;
    }
    memcpy(&Value, Next, sizeof(Value));
    Next += sizeof(Value);
    return Value;
  }

  const char *Next, *End;
  bool IsShort = false;
};

template <typename Archive>
void visit(Archive &A, pocl_argument_info &Argument) {
  A.text(Argument.type_name);
  A.text(Argument.name);
  A.number(Argument.address_qualifier);
  A.number(Argument.access_qualifier);
  A.number(Argument.type_qualifier);
  A.number(Argument.type);
  A.number(Argument.type_size);
  A.number(Argument.image_type);
  A.number(Argument.is_depth);
}

template <typename Archive>
void visit(Archive &A, pocl_kernel_metadata_t &Kernel) {
  A.text(Kernel.name);
  A.text(Kernel.attributes);
  A.array(Kernel.arg_info, Kernel.num_args);
  for (cl_uint I = 0; I != Kernel.num_args; ++I)
    visit(A, Kernel.arg_info[I]);
  A.number(Kernel.has_arg_metadata);
  A.array(Kernel.local_sizes, Kernel.num_locals);
  for (cl_uint I = 0; I != Kernel.num_locals; ++I)
    A.number(Kernel.local_sizes[I]);
  for (size_t &Size : Kernel.reqd_wg_size)
    A.number(Size);
  for (size_t &Size : Kernel.wg_size_hint)
    A.number(Size);
  A.number(Kernel.non_uniform_groups);
  for (char &Letter : Kernel.vectypehint)
    A.number(Letter);
}

struct Kernels {
  size_t VariableBytes = 0;
  pocl_kernel_metadata_t *All = nullptr;
  cl_uint Count = 0;
};

template <typename Archive> void visit(Archive &A, Kernels &K) {
  A.number(K.VariableBytes);
  A.array(K.All, K.Count);
  for (cl_uint I = 0; I != K.Count; ++I)
    visit(A, K.All[I]);
}

} // namespace

bool takeKernels(cl_program Program, cl_uint Index) {
  char *Bytes = nullptr;
  uint64_t Size = 0;
  if (pocl_read_checked_file(pathOf(Program, Index).c_str(), &Bytes, &Size) !=
      POCL_CHECKED_FILE_OK)
    return false;
  Reader In(Bytes, Size);
  Kernels Kept;
  visit(In, Kept);
  free(Bytes);
  Program->kernel_meta = Kept.All;
  Program->num_kernels = Kept.Count;
  for (cl_uint I = 0; I != Kept.Count; ++I)
    Kept.All[I].data =
        static_cast<void **>(calloc(Program->num_devices, sizeof(void *)));
  Program->global_var_total_size[Index] = Kept.VariableBytes;
  if (In.isDone())
    return true;
  for (cl_uint I = 0; I != Kept.Count; ++I)
    pocl_free_kernel_metadata(Program, I);
  POCL_MEM_FREE(Program->kernel_meta);
  Program->num_kernels = 0;
  Program->global_var_total_size[Index] = 0;
  return false;
}

void keepKernels(cl_program Program, cl_uint Index) {
  Kernels Known{Program->global_var_total_size[Index], Program->kernel_meta,
                static_cast<cl_uint>(Program->num_kernels)};
  Writer Out;
  visit(Out, Known);
  pocl_write_checked_file(pathOf(Program, Index).c_str(), Out.Bytes.data(),
                          Out.Bytes.size());
}

} // namespace vorion
