// Helpers of the tests that read databases from a literal.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "formats/brlcad/asc.hpp"
#include "formats/same_scene.hpp"
#include "formats/text_source.hpp"
#include "thrown.hpp"

namespace csgrt::asc_test {

inline Scene parse(const std::string& text) { return parse_brlcad_asc(TextSource("model.asc", text)); }

/// What `call` finds wrong with a scene.
template <class Call>
std::vector<Diagnostic> findings_by(const Call& call) {
    const test::Thrown thrown = test::thrown_by(call);
    REQUIRE((thrown.status == Status::scene || thrown.status == Status::ok));
    return thrown.findings;
}

inline std::vector<Diagnostic> findings_in(const std::string& text) {
    return findings_by([&] { parse(text); });
}

/// A database that is wrong in one place.
struct Broken {
    const char* what;
    std::string text;
    int line, column;
    const char* object;
    const char* message;  ///< a part of it
};

inline void check_broken(const Broken& broken) {
    INFO(broken.what);
    const auto findings = findings_in(broken.text);
    REQUIRE(findings.size() == 1);
    const Diagnostic& finding = findings[0];
    INFO(format(finding));
    CHECK(finding.place.file == "model.asc");
    CHECK(finding.place.line == broken.line);
    CHECK(finding.place.column == broken.column);
    CHECK(finding.place.pointer == broken.object);
    CHECK(finding.message.find(broken.message) != std::string::npos);
    // The excerpt is a line of the file and a caret.
    const std::size_t newline = finding.excerpt.find('\n');
    REQUIRE(newline != std::string::npos);
    CHECK(finding.excerpt.back() == '^');
}

struct Attempts {
    std::size_t read = 0, refused = 0;
};

/// What becomes of every beginning of a sound file's bytes, and of each byte that is made each of `values`. All that is
/// refused must be an error of the scene.
template <class Parse>
Attempts changed(const std::string& bytes, const std::string& values, const Parse& parse) {
    Attempts attempts;
    const auto attempt = [&](const std::string& text) {
        try {
            parse(text);
            ++attempts.read;
        } catch (const Error& error) {
            ++attempts.refused;
            if (error.status() != Status::scene) FAIL("a broken database is an error of the scene");
        }
    };
    for (std::size_t length = 0; length <= bytes.size(); ++length) attempt(bytes.substr(0, length));
    for (std::size_t i = 0; i < bytes.size(); ++i)
        for (const char value : values) attempt(std::string(bytes).replace(i, 1, 1, value));
    return attempts;
}

inline const Combination& comb(const Scene& scene, std::string_view name) {
    const Object* object = scene.find(std::string(name));
    REQUIRE(object != nullptr);
    REQUIRE(std::holds_alternative<Combination>(*object));
    return std::get<Combination>(*object);
}

template <class T>
const T& shape(const Scene& scene, std::string_view name) {
    const Object* object = scene.find(std::string(name));
    REQUIRE(object != nullptr);
    REQUIRE(std::holds_alternative<Solid>(*object));
    const Shape& any = std::get<Solid>(*object).shape;
    REQUIRE(std::holds_alternative<T>(any));
    return std::get<T>(any);
}

inline std::string unsupported_type(const Scene& scene, const std::string& name) {
    return shape<Unsupported>(scene, name).type;
}

/// A region with every attribute, which the tests of each form write.
inline const Combination glass_region{
    .region = true,
    .region_id = 1001,
    .air = 3,
    .material_id = 7,
    .los = 50,
    .color = Vec3{1, 0, 0.2},
    .finish = Finish{.shader = "glass", .shine = 4, .transmit = 0.85, .reflect = 0.1},
    .color_inherits = true,
    .finish_inherits = true,
};

/// The tree written out: names, and operators with their operands in brackets.
inline std::string written(const Tree& tree) {
    std::vector<std::string> stack;
    for (const TreeNode& node : tree.nodes) {
        if (node.op == Operator::leaf) {
            stack.push_back(node.object);
            continue;
        }
        REQUIRE(stack.size() >= node.arity);
        std::string out(1, "?u+-^!"[static_cast<int>(node.op)]);
        for (std::size_t i = stack.size() - node.arity; i < stack.size(); ++i) {
            out += (out.size() > 1 ? " " : "(") + stack[i];
        }
        stack.resize(stack.size() - node.arity);
        stack.push_back(out + ")");
    }
    if (stack.empty()) return "";
    REQUIRE(stack.size() == 1);
    return stack[0];
}

}  // namespace csgrt::asc_test
