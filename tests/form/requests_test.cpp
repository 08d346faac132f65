// What a caller can ask for is described once (src/form/requests.hpp): the C++ headers, C's structs and the documents
// say it with the same sentences, and the command that is written back sets the same members again.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <regex>

#include <csgrt/csgrt.h>

#include "c/described.hpp"
#include "catch.hpp"
#include "cli/arguments.hpp"
#include "form/written_back.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace {

std::string path_of(const std::string& file) { return std::string(std::getenv("CSGRT_SCENES")) + "/../" + file; }

std::string text_of(const std::string& file) {
    std::ifstream in(path_of(file));
    REQUIRE(in);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The words of a header, without the marks of comments.
std::string words_of(const std::string& text) {
    const std::string words = std::regex_replace(text, std::regex("///<?"), " ");
    return std::regex_replace(words, std::regex("\\s+"), " ");
}

template <class S>
void require_sentences(const std::string& header) {
    const std::string words = words_of(text_of(header));
    form::for_members(form::of<S>, [&](const auto& member) {
        INFO(header << ": " << member.key.member);
        CHECK(words.find(member.help) != words.npos);
        CHECK(words.find(member.key.member) != words.npos);
    });
}

/// Lines of at most 120 columns. `first` begins the first one, `then` the others.
std::string folded(const std::string& first, const std::string& then, const std::string& sentence) {
    std::string text, line = first;
    for (std::size_t begin = 0; begin < sentence.size();) {
        const std::size_t end = std::min(sentence.find(' ', begin), sentence.size());
        if (line.size() + 1 + end - begin > 120) {
            text += line + "\n";
            line = then;
        }
        line += " " + sentence.substr(begin, end - begin);
        begin = end + 1;
    }
    return text + line + "\n";
}

template <class Value>
std::string c_members(const std::string& name) {
    if constexpr (std::is_same_v<Value, bool> || std::is_same_v<Value, int> || std::is_enum_v<Value>)
        return "int " + name + ";";
    else if constexpr (std::is_same_v<Value, double>)
        return "double " + name + ";";
    else if constexpr (std::is_same_v<Value, std::uint64_t>)
        return "uint64_t " + name + ";";
    else if constexpr (std::is_same_v<Value, unsigned>)
        return "unsigned " + name + ";";
    else if constexpr (std::is_same_v<Value, std::string>)
        return "const char* " + name + ";";
    else if constexpr (std::is_same_v<Value, std::vector<std::string>>)
        return "const char* const* " + name + ";\n    size_t " + name.substr(0, name.size() - 1) + "_count;";
    else if constexpr (std::is_same_v<Value, std::vector<Plane>>)
        return "const csgrt_plane* " + name + ";\n    size_t " + name + "_count;";
    else if constexpr (std::is_same_v<Value, Camera>)
        return "const csgrt_camera* " + name + ";  ///< NULL: CSGRT_CAMERA";
    else if constexpr (std::is_same_v<Value, std::optional<PixelRectangle>>)
        return "const csgrt_pixel_rectangle* " + name + ";  ///< NULL: all of them";
    else
        return "csgrt_progress " + name + ";  ///< NULL: none\n    void* user;";
}

/// C's struct as csgrt.h has it.
template <class S>
std::string c_struct() {
    const std::string name = "csgrt_" + std::string(form::of<S>.head.name);
    std::string text = "typedef struct " + name + " {\n    size_t size;\n";
    form::for_members(form::of<S>, [&](const auto& member) {
        using Value = std::remove_cvref_t<decltype(S{}.*member.at)>;
        if (*member.help) text += folded("    ///", "    ///", member.help);
        text += "    " + c_members<Value>(std::string(member.key.member)) + "\n";
    });
    return text + "} " + name + ";\n";
}

template <class Value>
std::string default_text(const Value& value) {
    if constexpr (std::is_same_v<Value, bool>)
        return value ? "true" : "false";
    else if constexpr (std::is_same_v<Value, double>)
        return shortest(value);
    else if constexpr (std::is_integral_v<Value>)
        return std::to_string(value);
    else if constexpr (std::is_same_v<Value, Precision>)
        return std::string(name_of(precision_names, value));
    else
        return "";
}

/// A list of a struct's members, for docs/settings.md.
template <class S>
std::string list(const std::string& title) {
    const S usual{};
    std::string text = "## " + title + "\n\n";
    form::for_members(form::of<S>, [&](const auto& member) {
        std::string line = "`" + std::string(member.key.member) + "`";
        if (*member.option.name) line += std::string(", `") + member.option.name + "`";
        if (const std::string value = default_text(usual.*member.at); !value.empty()) line += " (" + value + ")";
        text += folded("-", " ", line + (*member.help ? std::string(": ") + member.help : std::string()));
    });
    return text + "\n";
}

std::string settings_page() {
    return "# Settings and views\n\n"
           "The members of the structs that a caller fills, in C++, C and Python, and the options of the command that "
           "set\nthem, with their defaults. This page is made of src/form/requests.hpp (`csgrt_tests \"[.made]\"`).\n"
           "[command-line.md](command-line.md) has the options that set several members (`--size`, `--tolerance`) or "
           "looks.\n\n" +
           list<Settings>("csgrt::Settings") + list<LoadOptions>("csgrt::LoadOptions") + list<View>("csgrt::View") +
           list<Camera>("csgrt::Camera");
}

void replace_struct(std::string& header, const std::string& made) {
    const std::string head = made.substr(0, made.find('\n') + 1), tail = made.substr(made.rfind('}'));
    const std::size_t begin = header.find(head), end = header.find(tail, begin);
    REQUIRE(end != header.npos);
    header.replace(begin, end + tail.size() - begin, made);
}

/// As a shell does, without its signs but quotes.
std::vector<std::string> split(const std::string& command) {
    std::vector<std::string> words;
    bool is_word = false, is_quoted = false;
    for (std::size_t i = 0; i < command.size(); ++i) {
        const char c = command[i];
        if (!is_quoted && c == ' ') {
            is_word = false;
            continue;
        }
        if (!is_word) words.emplace_back();
        is_word = true;
        if (c == '\'')
            is_quoted = !is_quoted;
        else if (!is_quoted && c == '\\')
            words.back() += command[++i];
        else
            words.back() += c;
    }
    return words;
}

class Asker {
public:
    explicit Asker(std::uint32_t seed) : engine_(seed) {}
    bool coin() { return engine_() & 1u; }
    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
    Vec3 vector() {
        const double x = number(-1e3, 1e3), y = number(-1, 1), z = number(0.001, 1);
        return {x, y, z};
    }
    std::string path() { return std::vector<std::string>{"/all/a b.r", "/all/it's", "/x@2/y.r", "/all"}[whole(0, 3)]; }

    template <class Member, class Value>
    void fill(const Member& member, Value& value) {
        if (coin()) return;
        if constexpr (std::is_same_v<Value, bool>)
            value = coin();
        else if constexpr (std::is_same_v<Value, std::vector<std::string>>)
            value = {"a folder", "b"};
        else if constexpr (std::is_same_v<Value, std::vector<Plane>>)
            for (int i = whole(0, 6); i > 0; --i) value.push_back({vector(), number(-10, 10)});
        else if constexpr (std::is_same_v<Value, Precision>)
            value = coin() ? Precision::single : Precision::double_;
        else if constexpr (std::is_integral_v<Value>)
            value = static_cast<Value>(whole(1, 200));
        else
            static_cast<void>(member);
    }
    template <class S>
    void fill_all(S& s) {
        form::for_members(form::of<S>, [&](const auto& member) {
            if (*member.option.name && member.option.changes_answers) fill(member, s.*member.at);
        });
    }
    Camera camera() {
        Camera camera;
        camera.perspective = coin() ? 0 : number(0, 179);
        if (coin()) {
            camera.eye = vector();
        } else {
            camera.azimuth = number(-360, 360);
            camera.elevation = number(-90, 90);
        }
        if (coin()) (coin() ? camera.center : camera.look_at) = vector();
        if (coin() && !(camera.eye && camera.perspective > 0)) camera.view_size = number(0.01, 100);
        if (coin()) camera.up = vector();
        return camera;
    }

private:
    std::mt19937 engine_;
};

template <class S>
void require_same_members(const S& a, const S& b) {
    form::for_members(form::of<S>, [&](const auto& member) {
        INFO(member.key.member);
        using Value = std::remove_cvref_t<decltype(a.*member.at)>;
        if constexpr (std::is_same_v<Value, std::vector<Plane>>) {
            REQUIRE((a.*member.at).size() == (b.*member.at).size());
            for (std::size_t i = 0; i < (a.*member.at).size(); ++i)
                REQUIRE(((a.*member.at)[i].normal == (b.*member.at)[i].normal &&
                         (a.*member.at)[i].distance == (b.*member.at)[i].distance));
        } else if constexpr (std::is_same_v<Value, Camera>) {
            require_same_members(a.*member.at, b.*member.at);
        } else if constexpr (!std::is_same_v<Value, std::function<bool(double)>> &&
                             !std::is_same_v<Value, std::optional<PixelRectangle>>) {
            REQUIRE(a.*member.at == b.*member.at);
        }
    });
}

}  // namespace

TEST_CASE("each sentence stands in the C++ header") {
    require_sentences<Settings>("include/csgrt/settings.hpp");
    require_sentences<LoadOptions>("include/csgrt/scene_io.hpp");
    require_sentences<View>("include/csgrt/view.hpp");
    require_sentences<Camera>("include/csgrt/camera.hpp");
}

TEST_CASE("C's structs and docs/settings.md are made of the descriptions") {
    const std::string header = text_of("include/csgrt/csgrt.h");
    CHECK(header.find(c_struct<Settings>()) != header.npos);
    CHECK(header.find(c_struct<LoadOptions>()) != header.npos);
    CHECK(header.find(c_struct<View>()) != header.npos);
    CHECK(text_of("docs/settings.md") == settings_page());
}

TEST_CASE("writes C's structs and docs/settings.md", "[.made]") {
    std::string header = text_of("include/csgrt/csgrt.h");
    for (const std::string& made : {c_struct<Settings>(), c_struct<LoadOptions>(), c_struct<View>()})
        replace_struct(header, made);
    std::ofstream(path_of("include/csgrt/csgrt.h")) << header;
    std::ofstream(path_of("docs/settings.md")) << settings_page();
}

TEST_CASE("C's functions for defaults give those of C++") {
    csgrt_settings settings;
    csgrt_settings_init(&settings);
    require_same_members(c::settings_of(&settings), Settings{});
    csgrt_view view;
    csgrt_view_init(&view);
    require_same_members(c::view_of(&view), View{});
    csgrt_camera camera;
    csgrt_camera_init(&camera);
    require_same_members(c::camera_of(&camera), Camera{});
}

TEST_CASE("the command that is written back sets the same members") {
    Asker ask(2026);
    for (int i = 0; i < test::tries(500); ++i) {
        Settings settings;
        LoadOptions load;
        View view;
        std::vector<Look> looks;
        ask.fill_all(settings);
        ask.fill_all(load);
        ask.fill_all(view);
        view.width = ask.whole(1, 4000);
        view.height = ask.whole(1, 4000);
        view.camera = ask.camera();
        for (int k = ask.whole(0, 3); k > 0; --k) {
            Look look{.path = ask.path()};
            if (ask.coin())
                look.color = Vec3{ask.number(0, 1), 0.5, 1};
            else
                look.state = ask.coin() ? State::shown : State::hidden;
            looks.push_back(std::move(look));
        }
        settings.tolerance = ask.coin() ? ask.number(0, 1) : -1;
        const std::string words =
            model_words("a file's.json", {"all", "x y"}, load, settings) + drawing_options(view, looks);
        INFO(words);
        std::vector<std::string> again = split(words);
        again.insert(again.end(), {"-o", "x.exr"});
        const auto read = std::get<cli::RenderArguments>(cli::parse_arguments(again));
        REQUIRE((read.scene == "a file's.json" && read.objects == std::vector<std::string>{"all", "x y"}));
        require_same_members(read.settings, settings);
        require_same_members(read.load, load);
        require_same_members(read.picture, view);
        REQUIRE(read.looks.size() == looks.size());
        for (std::size_t k = 0; k < looks.size(); ++k)
            REQUIRE((read.looks[k].path == looks[k].path && read.looks[k].state == looks[k].state &&
                     read.looks[k].color == looks[k].color));
    }
}
