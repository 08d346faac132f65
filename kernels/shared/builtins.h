// The functions of OpenCL C that kernels use. A compiler that is kept from reading its own declarations of all
// functions (src/device/program.cpp) reads these. The attributes are as Khronos's specification has them: a function
// whose result depends on its arguments alone is const; a function that all work-items of a group must reach together
// is convergent.
#ifndef CSGRT_SHARED_BUILTINS_H
#define CSGRT_SHARED_BUILTINS_H

#define OVERLOADED __attribute__((overloadable))
#define PURE __attribute__((overloadable, const))

PURE size_t get_global_id(uint dimension);
PURE size_t get_global_size(uint dimension);
PURE size_t get_group_id(uint dimension);
PURE size_t get_local_id(uint dimension);
OVERLOADED __attribute__((convergent)) void barrier(cl_mem_fence_flags flags);
OVERLOADED uint atomic_inc(volatile __global uint* counter);
OVERLOADED uint atomic_inc(volatile __local uint* counter);
OVERLOADED uint atomic_add(volatile __global uint* sum, uint more);
OVERLOADED uint atomic_add(volatile __local uint* sum, uint more);
OVERLOADED uint atomic_or(volatile __local uint* bits, uint more);
PURE uint min(uint a, uint b);
PURE uint popcount(uint bits);
PURE uint clz(uint bits);
PURE uint add_sat(uint a, uint b);
PURE int any(long8 lanes);

#define REAL_FUNCTIONS(T) \
    PURE T sqrt(T x);     \
    PURE T fabs(T x);     \
    PURE T floor(T x);    \
    PURE T fma(T a, T b, T c);
REAL_FUNCTIONS(float)
REAL_FUNCTIONS(double)
REAL_FUNCTIONS(double8)
#undef REAL_FUNCTIONS
PURE int ilogb(float x);
PURE int ilogb(double x);
PURE float ldexp(float x, int exponent);
PURE double ldexp(double x, int exponent);
PURE float fmin(float a, float b);
PURE float fmax(float a, float b);

PURE float8 convert_float8(double8 x);
PURE float8 convert_float8(ulong8 x);
PURE float8 convert_float8(uint8 x);
PURE int8 convert_int8(long8 x);
PURE char8 convert_char8(int8 x);
PURE long8 convert_long8(int8 x);
#define MEMORY_FUNCTIONS(T)                                               \
    OVERLOADED T##8 vload8(size_t offset, const __private T* from);       \
    OVERLOADED T##8 vload8(size_t offset, const __global T* from);        \
    OVERLOADED void vstore8(T##8 values, size_t offset, __private T* to); \
    OVERLOADED void vstore8(T##8 values, size_t offset, __global T* to);
MEMORY_FUNCTIONS(float)
MEMORY_FUNCTIONS(double)
MEMORY_FUNCTIONS(uint)
MEMORY_FUNCTIONS(ulong)
OVERLOADED void vstore4(float4 values, size_t offset, __global float* to);
#undef MEMORY_FUNCTIONS
#undef OVERLOADED
#undef PURE

#endif
