// OpenCL table: the functions of OpenCL that csgrt calls. There are two tables: the OpenCL loader's, which is loaded
// when it is first needed (opencl_loader.hpp), and the native device's, whose kernels are in this library
// (native/driver.hpp). Callers need not know which table they use.
#pragma once

#include <CL/cl.h>

namespace csgrt {

// clang-format would indent the list further at each run.
// clang-format off
#define CSGRT_OPENCL_FUNCTIONS(F)                                                                                     \
    F(GetPlatformIDs) F(GetPlatformInfo) F(GetDeviceIDs) F(GetDeviceInfo)                                             \
    F(CreateContext) F(ReleaseContext)                                                                                \
    F(CreateCommandQueue) F(RetainCommandQueue) F(ReleaseCommandQueue) F(Flush) F(Finish)                             \
    F(CreateBuffer) F(ReleaseMemObject)                                                                               \
    F(CreateProgramWithSource) F(CreateProgramWithBinary) F(BuildProgram) F(ReleaseProgram) F(GetProgramInfo)         \
    F(GetProgramBuildInfo)                                                                                            \
    F(CreateKernel) F(ReleaseKernel) F(GetKernelInfo) F(SetKernelArg)                                                 \
    F(EnqueueNDRangeKernel) F(EnqueueWriteBuffer) F(EnqueueReadBuffer) F(EnqueueReadBufferRect) F(EnqueueFillBuffer)  \
    F(EnqueueMapBuffer) F(EnqueueUnmapMemObject) F(EnqueueMarkerWithWaitList)                                         \
    F(WaitForEvents) F(ReleaseEvent) F(GetEventInfo) F(GetEventProfilingInfo)
// clang-format on

/// Function pointers, named as in OpenCL without "cl". An object may be used only with the table that made it.
struct OpenCl {
#define CSGRT_MEMBER(name) decltype(&::cl##name) name = nullptr;
    CSGRT_OPENCL_FUNCTIONS(CSGRT_MEMBER)
#undef CSGRT_MEMBER
};

}  // namespace csgrt
