// Whether the reference is also compiled for processors with fma; others have it anyway, or never.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__FMA__)
#define CSGRT_DOUBLE_FMA
#endif
