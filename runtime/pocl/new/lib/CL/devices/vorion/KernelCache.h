/// Kernels as loadable images: compiled once for each group size, kept in
/// PoCL's cache folder, and loaded into the device once.
#pragma once

#include "Tools.h"
#include "vorion.h"

#include <vorion/runtime.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

namespace vorion {

struct ImageDeleter {
  void operator()(vx_image *Image) const { vx_image_free(Image); }
};

/// One kernel, compiled for one group size, in the device.
struct LoadedKernel {
  std::unique_ptr<vx_image, ImageDeleter> Image;
  uint32_t Number = 0; ///< of the kernel in the image
  vx_kernel_info Info{};
  std::string Path; ///< of the image
};

class KernelCache {
public:
  KernelCache(vx_device *Device) : Device(Device) {}

  const Tools &tools() const { return ToolSet; }

  /// Why there is no image of a kernel.
  struct Problem {
    enum class Cause {
      Kernel,    ///< it has an error, or the compiler has
      Files,     ///< the cache cannot be used
      Resources, ///< the compiler lacks memory, or cannot be started
    };
    std::string Text; ///< empty if nothing is wrong
    Cause Of = Cause::Kernel;

    /// What a command that needed the image ends with.
    cl_int status() const {
      return Of == Cause::Kernel ? CL_BUILD_PROGRAM_FAILURE
                                 : CL_OUT_OF_HOST_MEMORY;
    }
  };

  /// Makes the image of the command's kernel in the cache folder, for its group
  /// size if \p Specialize, else for any, unless they are there. What goes
  /// wrong is also added to the build log.
  Problem compile(_cl_command_node *Command, cl_kernel Kernel, bool Specialize);

  /// Asks the compiler for the command's kernel in the same way. \p Request is
  /// one for an image of its program, and says what is wanted of it.
  Problem ask(_cl_command_node *Command, cl_kernel Kernel, bool Specialize,
              CompilerRequest &Request, CompilerAnswer &Answer);

  /// The command's kernel, compiled for its group size, or for any if not
  /// \p Specialize, and loaded; null and \p P on failure. Valid until the next
  /// call of forget().
  const LoadedKernel *get(_cl_command_node *Command, Problem &P,
                          bool Specialize = true);

  /// The private memory of a work-item of \p Kernel in bytes: its stack, and
  /// what it keeps across barriers. The most that the group sizes need for
  /// which it is loaded; if there are none, it is compiled. Device \p Index of
  /// its program is \p Id.
  cl_ulong privateBytes(cl_kernel Kernel, cl_device_id Id, cl_uint Index,
                        Problem &P);

  /// The variables of program scope of \p Program, which \p Kernel uses. None
  /// if there is no memory for them. Valid until the next call of forget().
  std::optional<uint32_t> variables(cl_program Program,
                                    const LoadedKernel &Kernel);

  /// Unloads the kernels of a program that is being freed or built again, and
  /// frees its variables.
  void forget(cl_program Program);

private:
  static std::string imagePath(_cl_command_node *Command, cl_kernel Kernel,
                               bool Specialize);
  /// What is wrong about the command's kernel, in the build log too: this
  /// thread's pocl_file_problem(), if there is one.
  static Problem problem(_cl_command_node *Command, cl_kernel Kernel,
                         std::string Text, Problem::Cause Of);
  Problem make(_cl_command_node *Command, cl_kernel Kernel, bool Specialize,
               const std::string &ImagePath);

  struct LoadedProgram {
    std::unordered_map<std::string, LoadedKernel> Kernels; ///< by path
    uint32_t Variables = 0; ///< the memory's address; 0: not needed yet
  };

  vx_device *Device;
  Tools ToolSet;
  std::mutex CompileLock; ///< also guards Loaded
  std::unordered_map<cl_program, LoadedProgram> Loaded;
};

} // namespace vorion
