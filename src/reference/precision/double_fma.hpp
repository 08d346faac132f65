// Whether the reference is compiled a second time, for processors with fma. Other targets have fma in any case, or
// never.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__FMA__)
#define CSGRT_DOUBLE_FMA
#endif
