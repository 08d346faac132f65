#include "formats/brlcad/view_script.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/decimal.hpp"
#include "formats/brlcad/values.hpp"
#include "scene/nearest.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

struct Word {
    std::string_view text;
    std::size_t offset;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// The words from `begin` to `end`.
std::vector<Word> words_of(std::string_view text, std::size_t begin, std::size_t end) {
    std::vector<Word> words;
    for (std::size_t i = begin; i < end;) {
        while (i < end && is_blank(text[i])) ++i;
        const std::size_t first = i;
        while (i < end && !is_blank(text[i])) ++i;
        if (i > first) words.push_back({text.substr(first, i - first), first});
    }
    return words;
}

/// The values that the commands before `end` have set. The rows of `turn` are the view's axes: right, up, to the eye.
struct ViewState {
    std::optional<double> size, perspective;
    std::optional<Vec3> eye;
    std::optional<std::array<Vec3, 3>> turn;
};

/// The axes of a quaternion. BRL-CAD's quaternions are x y z w, and rotate from the model to the view.
std::array<Vec3, 3> axes_of_quaternion(double x, double y, double z, double w) {
    return {Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
            Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
            Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
}

/// The axes of a view from the direction `to_eye`, with +z up. Views from straight above or below have the axes of
/// azimuth 0.
std::array<Vec3, 3> axes_towards(const Vec3& to_eye) {
    const Vec3 back = unit(to_eye);
    const bool vertical = back.x == 0 && back.y == 0;
    const Vec3 right = vertical ? Vec3{0, 1, 0} : unit({-back.y, back.x, 0});
    return {right, cross(back, right), back};
}

/// Reads the commands of a script up to the end of its first frame.
class ViewReader {
public:
    explicit ViewReader(const TextSource& source) : source_(source), findings_(source) {}

    Camera read() {
        const std::string_view text = source_.text();
        std::size_t begin = source_.begin(), end = text.size();
        if (text.substr(begin).starts_with("#!")) {
            const std::size_t here = text.find("<<", begin);
            if (here == std::string_view::npos) {
                findings_.add(begin, {}, "a shell script that feeds no commands to rt", "it should say <<EOF");
                findings_.throw_if_any();
            }
            read_options(begin, here);
            begin = std::min(text.find('\n', here), text.size());
            const std::vector<Word> mark = words_of(text, here + 2, begin);
            if (!mark.empty()) end = std::min(text.find("\n" + std::string(mark.front().text), begin), text.size());
        }
        bool ended = false;
        while (begin < end && !ended) {
            const std::size_t stop = std::min({text.find(';', begin), end});
            const std::vector<Word> words = words_of(text, begin, stop);
            try {
                if (!words.empty()) ended = read_command(words);
            } catch (Fault& fault) {
                findings_.add(std::move(fault), {});
            }
            begin = stop + 1;
        }
        if (findings_.empty()) check(end);
        findings_.throw_if_any();
        return camera();
    }

private:
    /// Reads the options of rt: only -p, an angle in degrees, counts.
    void read_options(std::size_t begin, std::size_t end) {
        const std::vector<Word> words = words_of(source_.text(), begin, end);
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (!words[i].text.starts_with("-p")) continue;
            std::string_view angle = words[i].text.substr(2);
            if (angle.empty() && i + 1 < words.size()) angle = words[i + 1].text;
            if (const auto value = finite_decimal(angle)) set_perspective(*value, words[i].offset);
        }
    }

    void set_perspective(double angle, std::size_t offset) {
        if (angle >= 0 && angle < 180) {
            state_.perspective = angle;
        } else {
            findings_.add(offset, {}, "the perspective must be 0 or an angle below 180 degrees");
        }
    }

    /// Reads a number. `text`: the word, or the part of it that is the number.
    static double number(const Word& word, std::string_view text) {
        const auto value = finite_decimal(text);
        if (!value) throw Fault{word.offset, quoted(word.text) + " is not a finite number", {}};
        return *value;
    }

    static std::vector<double> numbers(std::span<const Word> words, std::size_t count) {
        if (words.size() != count + 1)
            throw Fault{
                words[0].offset,
                quoted(words[0].text) + " takes " + std::to_string(count) + (count == 1 ? " number" : " numbers"),
                {}};
        std::vector<double> values;
        for (const Word& word : words.subspan(1)) values.push_back(number(word, word.text));
        return values;
    }

    /// Reads a command. True: the frame is complete.
    bool read_command(const std::vector<Word>& words) {
        const std::string_view command = words[0].text;
        if (command == "end") return true;
        if (command == "viewsize") {
            state_.size = numbers(words, 1)[0];
            if (!(*state_.size > 0)) throw Fault{words[1].offset, "the size of a view must be greater than 0", {}};
        } else if (command == "eye_pt") {
            const std::vector<double> v = numbers(words, 3);
            state_.eye = Vec3{v[0], v[1], v[2]};
        } else if (command == "orientation") {
            const std::vector<double> q = numbers(words, 4);
            const double size = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
            if (!(size > 0) || !std::isfinite(size)) throw Fault{words[0].offset, "this quaternion is no rotation", {}};
            state_.turn = axes_of_quaternion(q[0] / size, q[1] / size, q[2] / size, q[3] / size);
        } else if (command == "viewrot") {
            const std::vector<double> m = numbers(words, 16);
            const std::array<Vec3, 3> rows = {Vec3{m[0], m[1], m[2]}, Vec3{m[4], m[5], m[6]}, Vec3{m[8], m[9], m[10]}};
            if (dependent(rows[0], rows[1], rows[2])) throw Fault{words[0].offset, "this matrix is no rotation", {}};
            state_.turn = rows;
        } else if (command == "ae") {
            const std::vector<double> v = numbers(words, 2);
            set_azimuth(v[0], v[1]);
        } else if (command == "lookat_pt") {
            const std::vector<double> v = numbers(words.size() == 5 ? std::span(words).first(4) : std::span(words), 3);
            if (!state_.eye) throw Fault{words[0].offset, "'lookat_pt' must come after 'eye_pt'", {}};
            const Vec3 to_eye = *state_.eye - Vec3{v[0], v[1], v[2]};
            if (to_eye == Vec3{}) throw Fault{words[0].offset, "the eye stands at the point that it looks at", {}};
            state_.turn = axes_towards(to_eye);
        } else if (command == "set") {
            read_settings(words);
        } else {
            constexpr std::string_view passed[] = {"start", "clean", "tree", "prep", "draw", "erase", "opt"};
            if (std::find(std::begin(passed), std::end(passed), command) == std::end(passed)) unknown(words[0]);
        }
        return false;
    }

    void set_azimuth(double azimuth, double elevation) {
        constexpr double degree = std::numbers::pi / 180;
        const double a = azimuth * degree, e = elevation * degree;
        state_.turn = std::array{Vec3{-std::sin(a), std::cos(a), 0},
                                 Vec3{-std::sin(e) * std::cos(a), -std::sin(e) * std::sin(a), std::cos(e)},
                                 Vec3{std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)}};
    }

    /// Reads "set perspective=40".
    void read_settings(std::span<const Word> words) {
        for (const Word& word : words.subspan(1)) {
            const std::size_t equals = word.text.find('=');
            const std::string_view key = word.text.substr(0, equals);
            if (equals == std::string_view::npos || (key != "perspective" && key != "angle")) continue;
            set_perspective(number(word, word.text.substr(equals + 1)), word.offset);
        }
    }

    [[noreturn]] static void unknown(const Word& word) {
        const std::vector<std::string_view> known = {"ae",          "clean", "end",   "eye_pt",  "lookat_pt",
                                                     "orientation", "set",   "start", "viewrot", "viewsize"};
        std::string hint = did_you_mean(word.text, known);
        if (hint.empty()) hint = "a view is viewsize, orientation and eye_pt, as MGED's saveview writes them";
        throw Fault{word.offset, quoted(word.text) + " is no command of a saved view", std::move(hint)};
    }

    void check(std::size_t end) {
        const auto lacks = [&](bool is_there, const char* what) {
            if (!is_there)
                findings_.add(std::min(end, source_.text().size()), {}, std::string("this view lacks ") + what);
        };
        lacks(state_.size.has_value(), "its size: viewsize MM");
        lacks(state_.eye.has_value(), "its eye: eye_pt X Y Z");
        lacks(state_.turn.has_value(), "its direction: orientation X Y Z W");
    }

    Camera camera() const {
        const Vec3& eye = *state_.eye;
        const auto& [right, up, back] = *state_.turn;
        Camera camera;
        camera.perspective = state_.perspective.value_or(0);
        camera.eye = eye;
        camera.up = up;
        // The target may be any point ahead of the eye. A point about as far away as the origin keeps the digits of the
        // direction.
        const double far = std::max({*state_.size, std::abs(eye.x), std::abs(eye.y), std::abs(eye.z)});
        camera.look_at = eye - far * unit(back);
        if (camera.perspective == 0) camera.view_size = state_.size;
        return camera;
    }

    const TextSource& source_;
    Findings findings_;
    ViewState state_;
};

}  // namespace

Camera parse_view_script(const TextSource& source) { return ViewReader(source).read(); }

}  // namespace csgrt
