#include "Sample.h"

#include <cstdio>

namespace sample {

Device::Device(const std::string &Source) {
  std::vector<cl::Platform> Platforms;
  try {
    cl::Platform::get(&Platforms);
  } catch (const cl::Error &) {
    Platforms.clear(); // an error to some loaders, an empty list to others
  }
  if (Platforms.empty())
    throw cl::Error(CL_PLATFORM_NOT_FOUND_KHR,
                    "no OpenCL platform, expected one (see splat doctor)");
  std::vector<cl::Device> Devices;
  try {
    Platforms[0].getDevices(CL_DEVICE_TYPE_ALL, &Devices);
  } catch (const cl::Error &E) {
    // A platform of Vorion has said why, as of a wrong VORION_SET.
    throw cl::Error(E.err(), "no OpenCL device, expected one that a platform "
                             "opens (see the messages above, or splat doctor)");
  }
  Chosen = Devices[0];
  Context = cl::Context(Chosen);
  Queue = cl::CommandQueue(Context, Chosen);
  Program = cl::Program(Context, Source);
  try {
    Program.build();
  } catch (const cl::Error &) {
    std::fputs(Program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(Chosen).c_str(),
               stderr);
    throw;
  }
  GetEventInfo = reinterpret_cast<clGetEventInfoVORION_fn>(
      clGetExtensionFunctionAddressForPlatform(Platforms[0](),
                                               "clGetEventInfoVORION"));
}

void Device::count(const cl::Event &Done) {
  cl_ulong W = 0, L = 0;
  if (GetEventInfo &&
      GetEventInfo(Done(), CL_EVENT_WARP_INSTRUCTIONS_VORION, sizeof(W), &W,
                   nullptr) == CL_SUCCESS &&
      GetEventInfo(Done(), CL_EVENT_LANE_INSTRUCTIONS_VORION, sizeof(L), &L,
                   nullptr) == CL_SUCCESS) {
    Warps += W;
    Lanes += L;
  }
}

int run(const char *Name, const char *Source,
        const std::function<bool(Device &)> &Body) {
  try {
    Device D(Source);
    const bool Agree = Body(D);
    std::printf("%s on %s: %s", Name, D.name().c_str(),
                Agree ? "matches the host" : "WRONG");
    if (D.warpInstructions())
      std::printf(", %llu warp instructions, %.1f lanes each",
                  static_cast<unsigned long long>(D.warpInstructions()),
                  static_cast<double>(D.laneInstructions()) /
                      static_cast<double>(D.warpInstructions()));
    std::printf("\n");
    return Agree ? 0 : 1;
  } catch (const cl::Error &E) {
    std::fprintf(stderr, "%s: error: %s (%d)\n", Name, E.what(), E.err());
    return 1;
  }
}

} // namespace sample
