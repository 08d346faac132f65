#include "device/kernel_source.hpp"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/letters.hpp"
#include "device/choice.hpp"
#include "device/discovery.hpp"

namespace csgrt {

namespace {

const char* text_of(const std::string& name, const std::string& wanted_by) {
    for (const KernelFile& file : kernel_files()) {
        if (name == file.name) return file.text;
    }
    throw std::logic_error("no kernel file \"" + name + "\", wanted by " + wanted_by);
}

/// The name of an included file: "../shared/layout.h" in "geometry/ell.h" is "shared/layout.h".
std::string resolve(const std::string& includer, std::string_view included) {
    std::string folder = includer.substr(0, includer.find_last_of('/') + 1);  // "" or "geometry/"
    while (included.starts_with("../") && !folder.empty()) {
        included.remove_prefix(3);
        folder.pop_back();
        folder.resize(folder.find_last_of('/') + 1);
    }
    return folder.append(included);
}

/// The rest of a line that begins with `words`, which spaces may separate. Nothing for other lines.
std::optional<std::string_view> after(std::string_view line, std::initializer_list<std::string_view> words) {
    for (const std::string_view word : words) {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (!line.starts_with(word)) return std::nullopt;
        line.remove_prefix(word.size());
    }
    return line;
}

/// The file in the quotes of an #include line; empty for any other line.
std::string_view included_file(std::string_view line) {
    const auto name = after(line, {"#", "include", "\""});
    return name ? name->substr(0, name->find('"')) : std::string_view();
}

/// The guard of a file: "geometry/ell.h" -> "CSGRT_GEOMETRY_ELL_H".
std::string guard_of(const std::string& name) {
    std::string guard = "CSGRT_" + name;
    for (char& c : guard) c = c == '.' || c == '/' ? '_' : upper(c);
    return guard;
}

/// Assembles one program's text, including each file once.
class Assembly {
public:
    void add(const std::string& name, const std::string& wanted_by) {
        if (!done_.insert(name).second) return;
        mark(1, name);
        std::string_view rest = text_of(name, wanted_by);
        for (int line_number = 1; !rest.empty(); ++line_number) {
            const std::string_view line = rest.substr(0, rest.find('\n'));
            rest.remove_prefix(std::min(line.size() + 1, rest.size()));
            if (const auto guard = after(line, {"#", "undef", "CSGRT_"}))  // then the file may be included again
                std::erase_if(
                    done_, [&](const std::string& done) { return guard_of(done) == "CSGRT_" + std::string(*guard); });
            if (const std::string_view included = included_file(line); !included.empty()) {
                add(resolve(name, included), name);
                mark(line_number + 1, name);
            } else {
                text_.append(line) += '\n';
            }
        }
    }
    std::string take() { return std::move(text_); }

private:
    void mark(int line, const std::string& name) {
        text_ += "#line " + std::to_string(line) + " \"kernels/" + name + "\"\n";
    }

    std::set<std::string> done_;
    std::string text_;
};

}  // namespace

std::string assemble_program(const std::vector<std::string>& names) {
    Assembly assembly;
    for (const std::string& name : names) assembly.add(name, "the host");
    return assembly.take();
}

std::string program_source(const DeviceInfo& device, const Settings& settings, const char* native_name,
                           const std::vector<std::string>& files) {
    if (!is_native(device)) return assemble_program(files);
    return kernels_for(settings) == Kernels::any ? native_name : "";
}

}  // namespace csgrt
