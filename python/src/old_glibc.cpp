// Two functions of glibc 2.35 that would keep a wheel from systems with 2.34. The linker gives all calls to these
// (--wrap).
#include <dlfcn.h>
#include <link.h>

#include <cstdint>

#if defined(__x86_64__)
#define CSGRT_OLDEST "GLIBC_2.2.5"
#else
#define CSGRT_OLDEST "GLIBC_2.17"
#endif
// The older version of the symbol has the same numbers on one system.
__asm__(".symver csgrt_oldest_hypot, hypot@" CSGRT_OLDEST);

extern "C" double csgrt_oldest_hypot(double x, double y);
extern "C" double __wrap_hypot(double x, double y) { return csgrt_oldest_hypot(x, y); }

#if defined(DLFO_STRUCT_HAS_EH_DBASE)
namespace {

struct Search {
    std::uintptr_t address;
    dl_find_object* found;
};

/// Whether that object holds the address. If so, where its table of frames is.
int look_into(dl_phdr_info* object, std::size_t, void* data) {
    const auto& search = *static_cast<Search*>(data);
    bool holds = false;
    void* frames = nullptr;
    for (int i = 0; i < object->dlpi_phnum; ++i) {
        const auto& part = object->dlpi_phdr[i];
        const std::uintptr_t begin = object->dlpi_addr + part.p_vaddr;
        if (part.p_type == PT_LOAD) holds |= search.address >= begin && search.address - begin < part.p_memsz;
        if (part.p_type == PT_GNU_EH_FRAME) frames = reinterpret_cast<void*>(begin);
    }
    if (!holds || !frames) return 0;
    search.found->dlfo_eh_frame = frames;
    return 1;
}

}  // namespace

/// All that libgcc's unwinder asks of it on x86-64 and aarch64 is the table of frames.
extern "C" int __wrap__dl_find_object(void* address, dl_find_object* found) {
    Search search{reinterpret_cast<std::uintptr_t>(address), found};
    return dl_iterate_phdr(look_into, &search) ? 0 : -1;
}
#endif
