#include "leaves_first.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <set>
#include <vector>

#ifdef __GLIBC__

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <unistd.h>

namespace csgrt::cli {

namespace {

/// A file of which parts are read: some hundred bytes of a library of 30 MiB.
class PartialFile {
public:
    explicit PartialFile(const std::string& path) : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
    ~PartialFile() {
        if (file_ >= 0) close(file_);
    }
    PartialFile(const PartialFile&) = delete;
    PartialFile& operator=(const PartialFile&) = delete;

    /// `count` values from byte `at` on; fewer at the end of the file.
    template <class T>
    std::vector<T> read(std::uint64_t at, std::size_t count) const {
        std::vector<T> values(count);
        const ssize_t bytes = pread(file_, values.data(), count * sizeof(T), static_cast<off_t>(at));
        values.resize(bytes > 0 ? static_cast<std::size_t>(bytes) / sizeof(T) : 0);
        return values;
    }

private:
    int file_;
};

using ElfHeader = ElfW(Ehdr);
using ElfSegment = ElfW(Phdr);
using ElfEntry = ElfW(Dyn);

bool is_of_this_machine(const ElfHeader& header) {
    constexpr unsigned char word = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
    return std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 && header.e_ident[EI_CLASS] == word &&
           header.e_phentsize == sizeof(ElfSegment);
}

/// The position in the file of the byte that is loaded to `address`.
std::optional<std::uint64_t> place_of(std::uint64_t address, const std::vector<ElfSegment>& segments) {
    for (const ElfSegment& segment : segments)
        if (segment.p_type == PT_LOAD && address >= segment.p_vaddr && address - segment.p_vaddr < segment.p_filesz)
            return address - segment.p_vaddr + segment.p_offset;
    return {};
}

/// The names of the dependencies of a library; empty if `path` is not a readable library.
std::vector<std::string> needed_by(const std::string& path) {
    const PartialFile file(path);
    const std::vector<ElfHeader> header = file.read<ElfHeader>(0, 1);
    if (header.empty() || !is_of_this_machine(header[0])) return {};
    const std::vector<ElfSegment> segments = file.read<ElfSegment>(header[0].e_phoff, header[0].e_phnum);

    std::vector<ElfEntry> dynamic;
    constexpr std::size_t most = 10'000;  // a library has some 30
    for (const ElfSegment& segment : segments)
        if (segment.p_type == PT_DYNAMIC && segment.p_filesz / sizeof(ElfEntry) < most)
            dynamic = file.read<ElfEntry>(segment.p_offset, segment.p_filesz / sizeof(ElfEntry));
    std::optional<std::uint64_t> texts;
    for (const ElfEntry& entry : dynamic)
        if (entry.d_tag == DT_STRTAB) texts = place_of(entry.d_un.d_ptr, segments);
    if (!texts) return {};

    std::vector<std::string> names;
    for (const ElfEntry& entry : dynamic) {
        if (entry.d_tag != DT_NEEDED) continue;
        std::vector<char> text = file.read<char>(*texts + entry.d_un.d_val, 256);
        text.push_back('\0');
        names.emplace_back(text.data());
    }
    return names;
}

/// The folders in which the loader looks for this program's libraries.
std::vector<std::filesystem::path> search_folders() {
    void* program = dlopen(nullptr, RTLD_LAZY);
    Dl_serinfo size;
    if (!program || dlinfo(program, RTLD_DI_SERINFOSIZE, &size) != 0) return {};
    std::vector<std::max_align_t> memory(size.dls_size / sizeof(std::max_align_t) + 1);
    auto* info = reinterpret_cast<Dl_serinfo*>(memory.data());
    info->dls_size = size.dls_size;
    info->dls_cnt = size.dls_cnt;
    if (dlinfo(program, RTLD_DI_SERINFO, info) != 0) return {};
    std::vector<std::filesystem::path> folders;
    for (unsigned i = 0; i < info->dls_cnt; ++i) folders.emplace_back(info->dls_serpath[i].dls_name);
    return folders;
}

/// The file names of the libraries that are loaded already.
std::set<std::string> loaded_libraries() {
    std::set<std::string> names;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* all) {
            static_cast<std::set<std::string>*>(all)->insert(std::filesystem::path(info->dlpi_name).filename());
            return 0;
        },
        &names);
    return names;
}

class LeavesFirst {
public:
    explicit LeavesFirst(const std::stop_token& token) : stop_(token) {}

    void load_needed_by(const std::string& path) {
        for (const std::string& name : needed_by(path)) load(name);
    }

private:
    void load(const std::string& name) {
        if (stop_.stop_requested() || !seen_.insert(name).second) return;
        for (const auto& folder : folders_)
            if (const std::string path = folder / name; access(path.c_str(), R_OK) == 0) {
                load_needed_by(path);
                break;
            }
        // NOW: a library that uses symbols of others than its dependencies fails here. The dlopen of everything loads
        // it later.
        if (!stop_.stop_requested()) dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    }

    const std::stop_token& stop_;
    const std::vector<std::filesystem::path> folders_ = search_folders();
    std::set<std::string> seen_ = loaded_libraries();
};

}  // namespace

void load_leaves_first(const std::string& file, const std::stop_token& token) {
    LeavesFirst(token).load_needed_by(file);
}

}  // namespace csgrt::cli

#else

namespace csgrt::cli {

void load_leaves_first(const std::string&, const std::stop_token&) {}

}  // namespace csgrt::cli

#endif
