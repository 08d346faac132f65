// hypot has a version of its own from glibc 2.35 on: alone it would keep a wheel from systems with 2.34. The older
// version of the symbol has the same numbers on one system. The linker gives all calls to this (--wrap=hypot).
#if defined(__x86_64__)
#define CSGRT_OLDEST "GLIBC_2.2.5"
#else
#define CSGRT_OLDEST "GLIBC_2.17"
#endif
__asm__(".symver csgrt_oldest_hypot, hypot@" CSGRT_OLDEST);

extern "C" double csgrt_oldest_hypot(double x, double y);
extern "C" double __wrap_hypot(double x, double y) { return csgrt_oldest_hypot(x, y); }
