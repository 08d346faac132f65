// What a caller can ask for is described once (src/form/requests.hpp): the C++ headers, C's structs and the documents
// say it with the same sentences, and the command that is written back sets the same members again.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <regex>

#include <csgrt/csgrt.h>

#include "c/described.hpp"
#include "catch.hpp"
#include "cli/arguments.hpp"
#include "form/check.hpp"
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
        const std::string_view name = member.key.json.substr(member.key.json.rfind('.') + 1);  // a member's member
        CHECK(words.find(name == member.key.json ? member.key.member : name) != words.npos);
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
    else if constexpr (std::is_same_v<Value, std::vector<Density>>)
        return "const csgrt_density* " + name + ";\n    size_t density_count;";
    else if constexpr (std::is_same_v<Value, std::vector<AllowedOverlap>>)
        return "const csgrt_allowed_overlap* " + name + ";\n    size_t " + name + "_count;";
    else if constexpr (std::is_same_v<Value, Ray>)
        return "csgrt_ray " + name + ";";
    else if constexpr (std::is_same_v<Value, Estimate>)
        return "csgrt_estimate " + name + ";";
    else if constexpr (std::is_same_v<Value, std::array<std::uint32_t, 2>>)
        return "uint32_t " + name + "[2];";
    else if constexpr (std::is_same_v<Value, std::array<std::uint32_t, 3>>)
        return "uint32_t " + name + "[3];";
    else if constexpr (std::is_same_v<Value, Camera>)
        return "const csgrt_camera* " + name + ";  ///< NULL: CSGRT_CAMERA";
    else if constexpr (std::is_same_v<Value, std::optional<PixelRectangle>>)
        return "const csgrt_pixel_rectangle* " + name + ";  ///< NULL: all of them";
    else if constexpr (std::is_same_v<Value, Vec3>)
        return "csgrt_vec3 " + name + ";";
    else if constexpr (std::is_same_v<Value, Box>)
        return "csgrt_box " + name + ";";
    else if constexpr (std::is_same_v<Value, std::optional<Vec3>>)
        return "const csgrt_vec3* " + name + ";  ///< NULL: not given";
    else if constexpr (std::is_same_v<Value, std::optional<double>>)
        return "double " + name + ";  ///< 0: not given";
    else
        return "csgrt_progress " + name + ";  ///< NULL: none\n    void* user;";
}

template <class S>
std::string c_name() {
    return "csgrt_" + std::string(form::of<S>.head.name);
}

template <class Member>
constexpr bool is_listed = std::is_same_v<decltype(Member::kind), form::Listed>;

/// C's struct as csgrt.h has it.
template <class S>
std::string c_struct(bool is_sized = true) {
    const S usual_struct{};
    std::string text = "typedef struct " + c_name<S>() + " {\n" + (is_sized ? "    size_t size;\n" : "");
    form::for_members(form::of<S>, [&]<class Member>(const Member& member) {
        using Value = std::conditional_t<is_listed<Member>, std::size_t,
                                         std::remove_cvref_t<decltype(form::member_of(member, std::declval<S&>()))>>;
        if constexpr (std::is_same_v<Value, Finish>) return;  // csgrt_model_finish() gives it
        const std::string sentence = form::whole_sentence(member, form::member_of(member, usual_struct));
        if (!sentence.empty()) text += folded("    ///", "    ///", sentence);
        text += "    " + c_members<Value>(std::string(member.key.member)) + "\n";
    });
    return text + "} " + c_name<S>() + ";\n";
}

template <class Value>
std::string c_value(const Value& value) {
    if constexpr (std::is_same_v<Value, double>)
        return std::isinf(value) ? "HUGE_VAL" : shortest(value);
    else if constexpr (std::is_same_v<Value, std::string>)
        return "\"" + value + "\"";
    else if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>)
        return std::to_string(static_cast<long long>(value));
    else if constexpr (std::is_same_v<Value, Vec3>)
        return "{" + shortest(value.x) + ", " + shortest(value.y) + ", " + shortest(value.z) + "}";
    else if constexpr (std::is_same_v<Value, std::array<std::uint32_t, 3>>)
        return "{" + c_value(value[0]) + ", " + c_value(value[1]) + ", " + c_value(value[2]) + "}";
    else if constexpr (std::is_same_v<Value, std::array<std::uint32_t, 2>>)
        return "{" + c_value(value[0]) + ", " + c_value(value[1]) + "}";
    else if constexpr (std::is_same_v<Value, Estimate>)
        return "{" + c_value(value.value) + ", " + c_value(value.half_width) + "}";
    else if constexpr (std::is_same_v<Value, Ray>)
        return "{" + c_value(value.origin) + ", " + c_value(value.direction) + "}";
    else if constexpr (std::is_same_v<Value, Box>)
        return "{" + c_value(value.low) + ", " + c_value(value.high) + "}";
    else if constexpr (std::is_same_v<Value, std::optional<double>>)
        return c_value(value.value_or(0));
    else if constexpr (std::is_same_v<Value, Camera> || std::is_same_v<Value, std::optional<Vec3>> ||
                       std::is_same_v<Value, std::optional<PixelRectangle>>)
        return "NULL";
    else if constexpr (std::is_same_v<Value, std::function<bool(double)>>)
        return "NULL, NULL";
    else
        return "NULL, 0";
}

/// The macro with a struct's defaults.
template <class S>
std::string c_defaults() {
    std::string name = c_name<S>();
    std::string text = "#define ";
    for (const char c : name) text += static_cast<char>(std::toupper(c));
    text += " {sizeof(" + name + ")";
    const S usual{};
    form::for_members(form::of<S>, [&]<class Member>(const Member& member) {
        const auto& value = form::member_of(member, usual);
        if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(value)>, Finish>) {
            const std::string next = is_listed<Member> ? "0" : c_value(value);
            const std::size_t line = text.size() - (text.rfind('\n') + 1);
            text += line + next.size() > 114 ? ", \\\n    " : ", ";
            text += next;
        }
    });
    return text + "}\n";
}

/// The lines of an enumeration in csgrt.h.
template <class Names>
std::string enumerators(const std::string& prefix, const Names& names) {
    std::string text;
    for (const auto& [name, value] : names) {
        text += "    CSGRT_" + prefix;
        for (const char c : name) text += static_cast<char>(std::toupper(c));
        text += " = " + std::to_string(static_cast<long long>(value)) + ",\n";
    }
    return text;
}

std::string field_enumerators() {
    std::vector<std::pair<std::string, unsigned>> names;
    form::for_members(form::of<Fields>, [&](const auto& member) {
        names.emplace_back((member.option.is_off ? "without_" : "") + std::string(member.key.member),
                           1u << names.size());
    });
    return enumerators("FIELD_", names);
}

/// All of csgrt.h that is made.
std::vector<std::string> made_of_header() {
    return {enumerators("PRECISION_", every_precision),
            enumerators("TOLERANCE_", every_tolerance),
            enumerators("STATE_", state_names),
            enumerators("FASTGEN_", fastgen_names),
            enumerators("CHANNEL_", channel_names),
            enumerators("LIGHT_", lighting_names),
            enumerators("MEASURED_", measured_kind_names),
            enumerators("", operator_names),
            field_enumerators(),
            c_struct<Settings>(),
            c_struct<DeviceInfo>(),
            c_struct<LoadOptions>(),
            c_struct<Camera>(),
            c_struct<RegionInfo>(),
            c_struct<SolidInfo>(),
            c_struct<ChildInfo>(),
            c_struct<Ray>(false),
            c_struct<RayRange>(false),
            c_struct<RayGrid>(false),
            c_struct<Slice>(false),
            c_struct<Statistics>(),
            c_struct<PixelRectangle>(false),
            c_struct<View>(),
            c_struct<MeasureRequest>(),
            c_struct<CheckRequest>(),
            c_struct<CheckResult>(),
            c_struct<FoundOverlap>(),
            c_struct<UnlistedPair>(),
            c_defaults<Settings>(),
            c_defaults<DeviceInfo>(),
            c_defaults<LoadOptions>(),
            c_defaults<Camera>(),
            c_defaults<RegionInfo>(),
            c_defaults<SolidInfo>(),
            c_defaults<ChildInfo>(),
            c_defaults<Statistics>(),
            c_defaults<View>(),
            c_defaults<MeasureRequest>(),
            c_defaults<CheckRequest>(),
            c_defaults<CheckResult>(),
            c_defaults<FoundOverlap>(),
            c_defaults<UnlistedPair>()};
}

/// Replaces what begins as `made` does: up to its last line, or of a macro to the end of its lines.
void replace_made(std::string& header, const std::string& made) {
    INFO(made);
    const bool is_macro = made.starts_with('#'), is_struct = made.starts_with("typedef");
    const std::size_t key = is_macro ? made.find('{') : is_struct ? made.find('\n') : made.find(" =") + 1;
    const std::size_t begin = header.find(made.substr(0, key));
    REQUIRE(begin != header.npos);
    std::size_t end = begin;
    if (is_struct) {
        end = header.find(made.substr(made.rfind('}')), begin);
    } else if (is_macro) {
        while (header[header.find('\n', end) - 1] == '\\') end = header.find('\n', end) + 1;
    } else {
        end = header.find('}', begin) - 1;
    }
    REQUIRE(end != header.npos);
    end = is_struct || is_macro ? header.find('\n', end) + 1 : end + 1;
    header.replace(begin, end - begin, made);
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
        return std::string(name_of(every_precision, value));
    else if constexpr (std::is_same_v<Value, Tolerance>)
        return std::string(name_of(every_tolerance, value));
    else if constexpr (std::is_same_v<Value, Lighting>)
        return std::string(name_of(lighting_names, value));
    else
        return "";
}

/// A list of a struct's members, for docs/settings.md.
template <class S>
std::string list(const std::string& title) {
    const S usual{};
    std::string text = "## " + title + "\n\n";
    form::for_members(form::of<S>, [&]<class Member>(const Member& member) {
        std::string line = "`" + std::string(member.key.member) + "`";
        if (*member.option.name) line += std::string(", `") + member.option.name + "`";
        if constexpr (Member::given != form::Given::required)
            if (const std::string value = default_text(form::member_of(member, usual)); !value.empty())
                line += " (" + value + ")";
        const std::string sentence = form::whole_sentence(member, form::member_of(member, usual));
        text += folded("-", " ", line + (sentence.empty() ? "" : ": " + sentence));
    });
    return text + "\n";
}

/// A list of names with their numbers in C.
template <class Names>
std::string names_line(const std::string& title, const Names& names) {
    std::string text;
    for (const auto& [name, value] : names)
        text += (text.empty() ? "" : ", ") + std::string(name) + " " + std::to_string(static_cast<long long>(value));
    return folded("-", " ", title + ": " + text + ".");
}

std::string settings_page() {
    return "# Settings, views and answers\n\n"
           "This page lists the members of the structs that a caller fills or gets, in C++, C and Python. It has the "
           "options of the\n"
           "command that set them, and their defaults. It is made of src/form/requests.hpp and src/form/answers.hpp\n"
           "(`cmake --build build --target made`). [command-line.md](command-line.md) has the options that set several "
           "members\n"
           "(`--size`, `--tolerance`) or the appearance of regions. Python has no `progress`, since Ctrl-C ends a "
           "call, and no\n"
           "`part`, since an array can be sliced.\n\n" +
           list<Settings>("csgrt::Settings") + list<LoadOptions>("csgrt::LoadOptions") + list<View>("csgrt::View") +
           list<Camera>("csgrt::Camera") + list<Fields>("csgrt::Fields") + list<RayRange>("csgrt::RayRange") +
           list<Slice>("csgrt::Slice") + list<RegionInfo>("csgrt::RegionInfo") + list<SolidInfo>("csgrt::SolidInfo") +
           list<ChildInfo>("csgrt::ChildInfo") + list<MeasureRequest>("csgrt::MeasureRequest") +
           list<CheckRequest>("csgrt::CheckRequest") + list<CheckResult>("csgrt::CheckResult") +
           list<FoundOverlap>("csgrt::FoundOverlap") + list<UnlistedPair>("csgrt::UnlistedPair") +
           list<DeviceInfo>("csgrt::DeviceInfo") + list<Statistics>("csgrt::Statistics") +
           "## Names and their numbers\n\n" + names_line("Precision", every_precision) +
           names_line("Tolerance", every_tolerance) + names_line("Light", lighting_names) +
           names_line("State", state_names) + names_line("Fastgen", fastgen_names) +
           names_line("Operator", operator_names) +
           names_line("Channels, whose sum is what a picture has", channel_names) +
           names_line("Status, which is the command's, too", status_names);
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
        Camera camera{.perspective = coin() ? 0 : number(0, 179)};
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
        if constexpr (std::is_same_v<Value, std::vector<Density>>) {
            REQUIRE((a.*member.at).size() == (b.*member.at).size());
        } else if constexpr (std::is_same_v<Value, std::vector<Plane>>) {
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

/// The bytes of a small picture, or why there is none.
std::string drawn(const Settings& settings, View view, const std::vector<Look>& looks) {
    static const Scene operators = load_scene(path_of("scenes/operators.json"));
    Scene scene = operators;
    scene.looks = looks;
    view.width = 1 + view.width % 24;
    view.height = 1 + view.height % 24;
    view.samples = 1 + view.samples % 3;
    try {
        const Image image = Renderer(std::move(scene), {}, settings).render(view);
        std::string bytes;
        for (std::size_t i = 0; i < image.channels.size(); ++i) {
            const std::span<const float> channel = image.channels[i];
            bytes.append(reinterpret_cast<const char*>(channel.data()), channel.size_bytes());
        }
        return bytes;
    } catch (const Error& error) {
        return error.what();
    }
}

}  // namespace

TEST_CASE("each sentence stands in the C++ header") {
    require_sentences<Settings>("include/csgrt/settings.hpp");
    require_sentences<LoadOptions>("include/csgrt/scene_io.hpp");
    require_sentences<View>("include/csgrt/view.hpp");
    require_sentences<PixelRectangle>("include/csgrt/view.hpp");
    require_sentences<Camera>("include/csgrt/camera.hpp");
    require_sentences<Ray>("include/csgrt/rays.hpp");
    require_sentences<RayRange>("include/csgrt/rays.hpp");
    require_sentences<RayGrid>("include/csgrt/rays.hpp");
    require_sentences<Slice>("include/csgrt/rays.hpp");
    require_sentences<Fields>("include/csgrt/partitions.hpp");
    require_sentences<RegionInfo>("include/csgrt/model.hpp");
    require_sentences<SolidInfo>("include/csgrt/model.hpp");
    require_sentences<ChildInfo>("include/csgrt/model.hpp");
    require_sentences<DeviceInfo>("include/csgrt/device.hpp");
    require_sentences<Statistics>("include/csgrt/statistics.hpp");
    require_sentences<MeasureRequest>("include/csgrt/measure.hpp");
    require_sentences<CheckRequest>("include/csgrt/check.hpp");
    require_sentences<CheckResult>("include/csgrt/check.hpp");
    require_sentences<FoundOverlap>("include/csgrt/check.hpp");
    require_sentences<UnlistedPair>("include/csgrt/check.hpp");
}

TEST_CASE("C's structs and docs/settings.md are made of the descriptions") {
    const std::string header = text_of("include/csgrt/csgrt.h");
    for (const std::string& made : made_of_header()) {
        INFO("made by `cmake --build build --target made`:\n" << made);
        CHECK(header.find(made) != header.npos);
    }
    for (const auto& [name, status] : status_names) {
        const std::string line = enumerators("ERROR_", std::vector{std::pair(name, status)});
        CHECK(header.find(line.substr(4, line.size() - 6)) != header.npos);
    }
    CHECK(text_of("docs/settings.md") == settings_page());
}

TEST_CASE("writes C's structs and docs/settings.md", "[.made]") {
    std::string header = text_of("include/csgrt/csgrt.h");
    for (const std::string& made : made_of_header()) replace_made(header, made);
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
    csgrt_measure_request request;
    csgrt_measure_request_init(&request);
    require_same_members(c::described<MeasureRequest>(request, "request"), MeasureRequest{});
    csgrt_check_request check;
    csgrt_check_request_init(&check);
    require_same_members(c::described<CheckRequest>(check, "request"), CheckRequest{});
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
        if (i % 20 == 0) REQUIRE(drawn(read.settings, read.picture, read.looks) == drawn(settings, view, looks));
    }
}
