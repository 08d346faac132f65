// Builtins: the functions of OpenCL C that kernels use, for kernels that clang compiles ahead of time for a processor
// (cmake/native_kernels.cmake). They replace a driver's library. kernels/shared/builtins.h lists them.
#define CSGRT_BUILTINS_H
#define INLINE static inline __attribute__((overloadable, always_inline))
#define PURE static inline __attribute__((overloadable, always_inline, const))

// ---- Which work-item runs. The loops of the kernels' entries (NATIVE_ENTRY) set it, for each thread (driver.cpp).
// ----
typedef struct {
    size_t id, size;
    const volatile uchar* stop;  // not 0: no more work-items begin
} WorkItem;
WorkItem* csgrt_native_item(void) __attribute__((const));
INLINE size_t get_global_id(uint dimension) { return csgrt_native_item()->id; }
INLINE size_t get_global_size(uint dimension) { return csgrt_native_item()->size; }

// ---- Integers ----
INLINE uint atomic_inc(volatile __global uint* p) {
    return __atomic_fetch_add((__global uint*)p, 1u, __ATOMIC_RELAXED);
}
INLINE uint atomic_add(volatile __global uint* p, uint x) {
    return __atomic_fetch_add((__global uint*)p, x, __ATOMIC_RELAXED);
}
PURE uint min(uint a, uint b) { return a < b ? a : b; }
PURE uint popcount(uint x) { return (uint)__builtin_popcount(x); }
PURE uint clz(uint x) { return x ? (uint)__builtin_clz(x) : 32u; }
PURE uint add_sat(uint a, uint b) { return a + b < a ? 0xffffffffu : a + b; }

// ---- Reals ----
PURE float sqrt(float x) { return __builtin_sqrtf(x); }
PURE double sqrt(double x) { return __builtin_sqrt(x); }
PURE float fabs(float x) { return __builtin_fabsf(x); }
PURE double fabs(double x) { return __builtin_fabs(x); }
PURE float floor(float x) { return __builtin_floorf(x); }
PURE double floor(double x) { return __builtin_floor(x); }
PURE float fma(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
// A number whose origin the compiler does not know. Otherwise clang 15 turns -fma(a, b, c) into fma(-a, b, -c)
// (aarch64's fnmadd): if a b + c is 0, the zero gets the other sign. src/kernel_host/math.hpp has the same for GCC.
#if defined(__aarch64__)
PURE double opaque(double x) {
    __asm("" : "+w"(x));
    return x;
}
#else
PURE double opaque(double x) { return x; }
#endif
PURE double fma(double a, double b, double c) { return opaque(__builtin_fma(a, b, c)); }
// The exact exponent of x > 0: from the exponent's bits or, for a subnormal number, from its leading zeros.
PURE int ilogb(double x) {
    const int e = (int)(as_ulong(x) >> 52 & 2047u);
    return e != 0 ? e - 1023 : -1011 - (int)__builtin_clzl(as_ulong(x) & 0xffffffffffffful);
}
// The C library's ldexp is exact except where it rounds to a subnormal number, and so is OpenCL's.
double csgrt_ldexp(double, int) __asm(CSGRT_LDEXP) __attribute__((const));
PURE double ldexp(double x, int e) { return csgrt_ldexp(x, e); }

// ---- Eight doubles. LLVM's own functions, in the width that the processor passes in one register: another width
// breaks their call. ----
#if defined(__AVX512F__)
double8 csgrt_sqrt(double8) __asm("llvm.sqrt.v8f64") __attribute__((const));
double8 csgrt_fma(double8, double8, double8) __asm("llvm.fma.v8f64") __attribute__((const));
PURE double8 sqrt(double8 x) { return csgrt_sqrt(x); }
PURE double8 fma(double8 a, double8 b, double8 c) { return csgrt_fma(a, b, c); }
#elif defined(__AVX__)
double4 csgrt_sqrt(double4) __asm("llvm.sqrt.v4f64") __attribute__((const));
double4 csgrt_fma(double4, double4, double4) __asm("llvm.fma.v4f64") __attribute__((const));
PURE double8 sqrt(double8 x) { return (double8)(csgrt_sqrt(x.lo), csgrt_sqrt(x.hi)); }
PURE double8 fma(double8 a, double8 b, double8 c) {
    return (double8)(csgrt_fma(a.lo, b.lo, c.lo), csgrt_fma(a.hi, b.hi, c.hi));
}
#else
double2 csgrt_sqrt(double2) __asm("llvm.sqrt.v2f64") __attribute__((const));
double2 csgrt_fma(double2, double2, double2) __asm("llvm.fma.v2f64") __attribute__((const));
PURE double8 sqrt(double8 x) {
    return (double8)(csgrt_sqrt(x.s01), csgrt_sqrt(x.s23), csgrt_sqrt(x.s45), csgrt_sqrt(x.s67));
}
PURE double8 fma(double8 a, double8 b, double8 c) {
    return (double8)(csgrt_fma(a.s01, b.s01, c.s01), csgrt_fma(a.s23, b.s23, c.s23), csgrt_fma(a.s45, b.s45, c.s45),
                     csgrt_fma(a.s67, b.s67, c.s67));
}
#endif
PURE double8 fabs(double8 x) { return as_double8(as_ulong8(x) & 0x7ffffffffffffffful); }
PURE double8 floor(double8 x) { return __builtin_elementwise_floor(x); }

// ---- Vectors ----
PURE int any(long8 x) { return __builtin_reduce_or(x) < 0; }
PURE float8 convert_float8(double8 x) { return __builtin_convertvector(x, float8); }
PURE float8 convert_float8(ulong8 x) { return __builtin_convertvector(x, float8); }
PURE float8 convert_float8(uint8 x) { return __builtin_convertvector(x, float8); }
PURE int8 convert_int8(long8 x) { return __builtin_convertvector(x, int8); }
PURE char8 convert_char8(int8 x) { return __builtin_convertvector(x, char8); }
PURE long8 convert_long8(int8 x) { return __builtin_convertvector(x, long8); }
// Vectors in memory are aligned like a single element.
#define MEMORY_FUNCTIONS(T, V, N, SPACE)                          \
    INLINE V vload##N(size_t offset, const SPACE T* p) {          \
        V values;                                                 \
        __builtin_memcpy(&values, p + N * offset, sizeof values); \
        return values;                                            \
    }                                                             \
    INLINE void vstore##N(V values, size_t offset, SPACE T* p) {  \
        __builtin_memcpy(p + N * offset, &values, sizeof values); \
    }
MEMORY_FUNCTIONS(float, float8, 8, __private)
MEMORY_FUNCTIONS(double, double8, 8, __private)
MEMORY_FUNCTIONS(uint, uint8, 8, __private)
MEMORY_FUNCTIONS(ulong, ulong8, 8, __private)
MEMORY_FUNCTIONS(float, float8, 8, __global)
MEMORY_FUNCTIONS(double, double8, 8, __global)
MEMORY_FUNCTIONS(uint, uint8, 8, __global)
MEMORY_FUNCTIONS(ulong, ulong8, 8, __global)
MEMORY_FUNCTIONS(float, float4, 4, __global)
#undef MEMORY_FUNCTIONS
#undef INLINE
#undef PURE
