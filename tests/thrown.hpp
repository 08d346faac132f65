// What a call throws.
#pragma once

#include <string>
#include <vector>

#include <csgrt/error.hpp>

#include "catch.hpp"

namespace csgrt::test {

struct Thrown {
    Status status = Status::ok;
    std::string text = {};
    std::vector<Diagnostic> findings = {};
};

/// The Error that `call` throws; none of it if nothing is thrown.
template <class Call>
Thrown thrown_by(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return {error.status(), error.what(), error.diagnostics()};
    }
    return {};
}

/// What the Error says that `call` throws, which must have this status; empty if nothing is thrown.
template <class Call>
std::string failure(Status status, const Call& call) {
    const Thrown thrown = thrown_by(call);
    INFO(thrown.text);
    if (thrown.status != Status::ok) CHECK(thrown.status == status);
    return thrown.text;
}

inline bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace csgrt::test
