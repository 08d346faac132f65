// Helpers of the tests that read databases from a literal.
#pragma once

#include <string>
#include <string_view>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "formats/brlcad/asc.hpp"
#include "formats/text_source.hpp"

namespace csgrt::asc_test {

inline Scene parse(const std::string& text) { return parse_brlcad_asc(TextSource("model.asc", text)); }

inline std::vector<Diagnostic> findings_in(const std::string& text) {
    try {
        parse(text);
    } catch (const Error& error) {
        REQUIRE(error.status() == Status::scene);
        return error.diagnostics();
    }
    return {};
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
