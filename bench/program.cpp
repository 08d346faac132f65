#include "program.hpp"

#include <sstream>

#include "cli/cache_folder.hpp"

namespace csgrt::bench {

std::vector<std::string> split_list(const std::string& list) {
    std::vector<std::string> parts;
    std::istringstream in(list);
    for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
    return parts;
}

void OptionReader::text(const std::string& name, std::string& to) {
    value(name, [&to](const std::string& text) { to = text; });
}
void OptionReader::list(const std::string& name, std::vector<std::string>& to) {
    value(name, [&to](const std::string& text) { to = split_list(text); });
}
void OptionReader::flag(const std::string& name, bool& to) {
    options_[name] = {false, [&to](const std::string&) { to = true; }};
}

std::vector<std::string> OptionReader::read(int argc, char** argv, int first, std::size_t most) const {
    std::vector<std::string> words;
    for (int i = first; i < argc; ++i) {
        const std::string word = argv[i];
        const auto option = options_.find(word);
        if (option == options_.end()) {
            if (word.starts_with("--") || words.size() == most)
                throw Error(Status::usage, word + ": unknown; the head of the program's main file lists its options");
            words.push_back(word);
            continue;
        }
        if (option->second.has_value && ++i == argc) throw Error(Status::usage, word + ": lacks its value");
        option->second.take(argv[i]);
    }
    return words;
}

int run_program(const char* name, const std::function<int()>& work) {
    cli::ensure_cache_folder();
    try {
        return work();
    } catch (const Error& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        return static_cast<int>(error.status());
    }
}

}  // namespace csgrt::bench
