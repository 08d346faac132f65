// docs/promises.md is honest.
#include <algorithm>
#include <map>
#include <regex>
#include <sstream>

#include "cli/command.hpp"

using namespace command_test;

namespace {

/// Words with one blank between them, without the marks of comments, lists and code.
std::string words_of(const std::string& text) {
    std::istringstream lines(text);
    std::string all;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        bool begins = true;
        for (std::string word; words >> word; begins = false) {
            if (begins && (word == "///" || word == "//" || word == "-")) continue;
            if (word == "///<") continue;
            std::erase(word, '`');
            if (!all.empty()) all += ' ';
            all += word;
        }
    }
    return all;
}

/// The names of a file's test cases, each on a line. Those of Python have blanks in place of underscores.
std::string names_in(const std::string& source) {
    static const std::regex begin("TEST_CASE\\("), python("\ndef (test_[a-z_0-9]+)");
    std::string names;
    for (std::sregex_iterator at(source.begin(), source.end(), python), end; at != end; ++at) {
        std::string name = (*at)[1];
        std::replace(name.begin(), name.end(), '_', ' ');
        names += name + '\n';
    }
    for (std::sregex_iterator at(source.begin(), source.end(), begin), end; at != end; ++at) {
        std::size_t i = static_cast<std::size_t>(at->position()) + at->length();
        // One literal or several, one after the other.
        while ((i = source.find_first_not_of(" \n", i)) != std::string::npos && source[i] == '"') {
            const std::size_t close = source.find('"', i + 1);
            names += source.substr(i + 1, close - i - 1);
            i = close + 1;
        }
        names += '\n';
    }
    return names;
}

}  // namespace

TEST_CASE("each promise stands where docs/promises.md says, and its tests exist") {
    NEEDS_COMMAND();
    const char* scenes = std::getenv("CSGRT_SCENES");
    if (!scenes) {
        WARN("no docs: skipped");
        return;
    }
    const std::string root = std::string(scenes) + "/../", help = "csgrt help ";
    std::map<std::string, std::string> names;  // of test cases, by file
    std::string source, item;
    std::size_t promises = 0;
    // An item is a sentence, and then tests: `FILE` NAME; `FILE` NAME
    const auto check = [&] {
        if (item.empty()) return;
        ++promises;
        INFO(item);
        const std::size_t tests = item.find('`');
        REQUIRE(tests != std::string::npos);
        CHECK(contains(source, words_of(item.substr(0, tests))));
        std::istringstream kept(item.substr(tests));
        for (std::string test; std::getline(kept, test, ';');) {
            const std::size_t open = test.find('`'), close = test.find('`', open + 1);
            REQUIRE(close != std::string::npos);
            const std::string file = test.substr(open + 1, close - open - 1), name = words_of(test.substr(close + 1));
            const std::string path =
                root + "tests/" + file + (file.ends_with(".cmake") || file.ends_with(".py") ? "" : "_test.cpp");
            INFO(path);
            REQUIRE(fs::exists(path));
            if (names.find(file) == names.end()) names[file] = names_in(read_file(path));
            CHECK(contains(names[file], name));
        }
    };
    std::istringstream page(read_file(root + "docs/promises.md"));
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("  ")) {
            item += line.substr(1);
            continue;
        }
        check();
        item.clear();
        if (line.starts_with("- ")) item = line.substr(2);
        if (!line.starts_with("## ")) continue;
        const std::string heading = line.substr(3);
        source = words_of(heading.starts_with(help) ? run({"help", heading.substr(help.size())}).out
                                                    : read_file(root + heading));
    }
    check();
    CHECK(promises > 200);
}

TEST_CASE("each row of docs/reliability.md names tests that exist") {
    const char* scenes = std::getenv("CSGRT_SCENES");
    if (!scenes) return;
    const std::string root = std::string(scenes) + "/../";
    static const std::regex test("`([a-z_]+(?:/[a-z_]+)+)`");
    std::istringstream page(read_file(root + "docs/reliability.md"));
    std::size_t rows = 0;
    for (std::string line; std::getline(page, line) && !line.starts_with("## ");) {
        if (!line.starts_with("| ") || line.starts_with("| what fails")) continue;
        INFO(line);
        std::sregex_iterator at(line.begin(), line.end(), test), end;
        CHECK(at != end);
        for (; at != end; ++at) CHECK(fs::exists(root + "tests/" + (*at)[1].str() + "_test.cpp"));
        ++rows;
    }
    CHECK(rows > 10);
}
