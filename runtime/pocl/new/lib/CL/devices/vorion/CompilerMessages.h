/// What the driver and vorion-compiler send each other: a request with a
/// program and what to do with it, and an answer.
#pragma once

#include "KernelModule.h"
#include "MachineCode.h"
#include "ProgramFields.h"

#include <string>
#include <vector>

namespace vorion {

enum class CompilerTask {
  Build,   ///< compiles Source: as pocl_llvm_build_program()
  Link,    ///< links Binaries: as pocl_llvm_link_program(), or SPIR-V
  Kernels, ///< describes the kernels of the one binary
  Image,   ///< makes an image of a kernel of the one binary
  Triple,  ///< whether the one binary is of a target triple
  Objects, ///< links Objects, those of kernels, to an image
  Options, ///< checks MachineOptions: their errors are printed
};

struct NamedText {
  std::string Name, Text;
};
template <typename Archive> void visit(Archive &A, NamedText &Named) {
  A.text(Named.Name);
  A.text(Named.Text);
}

struct CompilerRequest {
  CompilerTask Task = CompilerTask::Build;
  std::string Folder; ///< the program's current one
  _cl_device_id Device{};
  /// What the device adds to a program's hash and to the compiler's options.
  std::string DeviceHash, DeviceOptions;

  // The program.
  std::string Options;
  cl_program_binary_type BinaryType = 0;
  bool FlushesDenorms = false;
  std::string Hash; ///< in the kernel cache; empty if it has none yet
  std::string Source;
  std::vector<NamedText> Headers;
  std::vector<std::string> Binaries;
  std::vector<NamedObject> Objects;
  std::string Triple;        ///< a part of it
  bool LinksLibrary = false; ///< of built-in functions
  bool IsNew = false;        ///< whether it gets a hash
  bool IsKept = true;        ///< in the kernel cache

  // The kernel.
  KernelDescription Kernel;
  bool IsSpecialized = false; ///< for its group size
  bool HasOffset = true;
  bool IsRangePart = false;
  bool IsOptimized = true;
  bool WantsImage = true; ///< or the object alone
  bool WantsObject = false, WantsBitcode = false;
  std::vector<std::string> MachineOptions; ///< of vorion-clang
};
template <typename Archive> void visit(Archive &A, CompilerRequest &Request) {
  A.number(Request.Task);
  A.text(Request.Folder);
  visit(A, Request.Device);
  A.text(Request.DeviceHash);
  A.text(Request.DeviceOptions);
  A.text(Request.Options);
  A.number(Request.BinaryType);
  A.number(Request.FlushesDenorms);
  A.text(Request.Hash);
  A.text(Request.Source);
  A.list(Request.Headers);
  A.list(Request.Binaries);
  A.list(Request.Objects);
  A.text(Request.Triple);
  A.number(Request.LinksLibrary);
  A.number(Request.IsNew);
  A.number(Request.IsKept);
  visit(A, Request.Kernel);
  A.number(Request.IsSpecialized);
  A.number(Request.HasOffset);
  A.number(Request.IsRangePart);
  A.number(Request.IsOptimized);
  A.number(Request.WantsImage);
  A.number(Request.WantsObject);
  A.number(Request.WantsBitcode);
  A.list(Request.MachineOptions);
}

struct CompilerAnswer {
  cl_int Status = CL_SUCCESS; ///< as PoCL's functions give it
  std::string Hash, Binary;   ///< of the program
  std::string Log;            ///< to be added to the program's
  std::string FileProblem;    ///< as pocl_file_problem() gives it; may be empty
  size_t VariableBytes = 0;   ///< of program scope
  std::string Kernels;        ///< ProgramKernels; empty if it has no library
  std::string Image;          ///< an ELF file; empty if the kernel has an error
  std::string Object, Bitcode;
  std::string Problem; ///< why there is no image: a line
  std::string Printed; ///< on standard error
};
template <typename Archive> void visit(Archive &A, CompilerAnswer &Answer) {
  A.number(Answer.Status);
  A.text(Answer.Hash);
  A.text(Answer.Binary);
  A.text(Answer.Log);
  A.text(Answer.FileProblem);
  A.number(Answer.VariableBytes);
  A.text(Answer.Kernels);
  A.text(Answer.Image);
  A.text(Answer.Object);
  A.text(Answer.Bitcode);
  A.text(Answer.Problem);
  A.text(Answer.Printed);
}

} // namespace vorion
