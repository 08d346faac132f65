// Many errors: fifty are told, and how many more there are, whichever reader or check found them.
#include "cli/command.hpp"

#include <functional>

using namespace command_test;

namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++count;
    return count;
}

struct Kind {
    const char* name;
    int status;
    std::function<std::string(int)> text;  ///< of a file with so many errors
};

const Kind kinds[] = {
    {"keys.json", 3,
     [](int errors) {
         std::string text =
             "{\"csgrt\": 1, \"solids\": {\"good\": {\"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1}";
         for (int i = 0; i < errors; ++i)
             text += ",\n\"b" + std::to_string(i) +
                     "\": {\"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1, \"raduis\": 1}";
         return text + "}}";
     }},
    {"model.json", 3,
     [](int errors) {  // found when the scene is checked
         std::string text =
             "{\"csgrt\": 1, \"solids\": {\"good\": {\"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1}";
         for (int i = 0; i < errors; ++i)
             text += ",\n\"b" + std::to_string(i) + "\": {\"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 0}";
         return text + "}}";
     }},
    {"small.json", 3,
     [](int errors) {  // found when it is compiled
         std::string text =
             "{\"csgrt\": 1, \"solids\": {\"good\": {\"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1}";
         for (int i = 0; i < errors; ++i)
             text +=
                 ",\n\"b" + std::to_string(i) + "\": {\"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1e-20}";
         return text + "}}";
     }},
    {"space.json", 3,
     [](int errors) {  // regions that contain empty space
         std::string text =
             "{\"csgrt\": 1, \"solids\": {\"good\": {\"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1}}, "
             "\"combinations\": {";
         for (int i = 0; i < errors; ++i)
             text +=
                 (i ? ",\n\"b" : "\"b") + std::to_string(i) + "\": {\"region\": true, \"tree\": {\"not\": \"good\"}}";
         return text + "}}";
     }},
    {"v5.asc", 3,
     [](int errors) {
         std::string text = "title many\nunits mm\n";
         for (int i = 0; i < errors; ++i) text += "put {a" + std::to_string(i) + "} ell V {0 0 zero}\n";
         return text;
     }},
    {"open.asc", 3,
     [](int errors) {
         std::string text = "title many\nunits mm\n";
         for (int i = 0; i < errors; ++i) text += "put {a" + std::to_string(i) + "} half N {\n";
         return text;
     }},
    {"v4.asc", 3,
     [](int errors) {
         std::string text = "I 0 v4\nmany\n";
         for (int i = 0; i < errors; ++i) text += "S 19 a" + std::to_string(i) + " zero\n";
         return text;
     }},
    {"rays", 6,
     [](int errors) {
         std::string text = "0 0 0 0 0 1\n";
         for (int i = 0; i < errors; ++i) text += "0 0 zero 0 0 1\n";
         return text;
     }},
};

}  // namespace

TEST_CASE("fifty errors are told, and how many more there are", "[promise:refusals]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string good = folder.write("balls.asc", two_balls);
    for (const Kind& kind : kinds) {
        for (const int errors : {1, 49, 50, 51, 60, 1000}) {
            CAPTURE(kind.name, errors);
            const std::string file = folder.write(kind.name, kind.text(errors));
            const Result result = kind.status == 6 ? run({"shoot", good, "--rays", file, "--reference"})
                                                   : run({"info", file, "--strict", "--depth", "0"});
            CHECK(result.status == kind.status);
            const int shown = std::min(errors, 50), more = errors - shown;
            CHECK(count_of(result.err, "csgrt: error: ") == static_cast<std::size_t>(shown + (more > 0)));
            CHECK(count_of(result.err, "csgrt: error: " + file + ":") == static_cast<std::size_t>(shown));
            const std::string last =
                "csgrt: error: and " + std::to_string(more) + (more == 1 ? " more error\n" : " more errors\n");
            CHECK(result.err.ends_with(last) == (more > 0));
        }
    }
}

TEST_CASE("many braces that are never closed do not take time by their number's square") {
    NEEDS_COMMAND();
    const Folder folder;
    std::string text = "title many\nunits mm\n";
    for (int i = 0; i < 100'000; ++i) text += "put {a" + std::to_string(i) + "} half N {\n";  // 2.3 MB
    check_run({"info", folder.write("open.asc", text)}, 3, "csgrt: error: and at least ");
}
