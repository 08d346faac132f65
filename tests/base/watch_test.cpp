#include <algorithm>
#include <atomic>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

#include <csgrt/error.hpp>

#include "base/watch.hpp"
#include "catch.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

void wait_for(const std::atomic<int>& calls, int number) {
    while (calls < number) std::this_thread::yield();
}

}  // namespace

TEST_CASE("the caller's thread tells of work that another does: at the beginning, meanwhile, and at the end",
          "[promise:interrupts]") {
    std::vector<double> told;
    std::atomic<int> calls{0};
    bool is_callers = true;
    const auto caller = std::this_thread::get_id();
    const auto progress = [&](double done) {
        is_callers = is_callers && std::this_thread::get_id() == caller;
        told.push_back(done);
        ++calls;
        return true;
    };
    Watch::over(progress, [&](Watch& watch) {
        CHECK(calls == 1);
        watch.begin(4);
        watch.add(1);
        wait_for(calls, 3);
        watch.add(2);
        wait_for(calls, 5);
        watch.add(1);
    });
    CHECK(is_callers);
    REQUIRE(told.size() >= 6);
    CHECK(told.front() == 0);
    CHECK(told[2] == 0.25);
    CHECK(told[told.size() - 2] >= 0.75);
    CHECK(told.back() == 1);
    CHECK(std::is_sorted(told.begin(), told.end()));
}

TEST_CASE("work that nobody follows stays on the caller's thread and never ends early") {
    const auto caller = std::this_thread::get_id();
    Watch::over(nullptr, [&](Watch& watch) {
        CHECK(std::this_thread::get_id() == caller);
        CHECK(watch.stop() == nullptr);
        watch.begin(1);
        watch.add(1);
    });
}

TEST_CASE("progress ends work before it begins, or as soon as it looks, but not once it is done") {
    std::atomic<int> calls{0};
    int end_at = 0;  // which call says no, and all behind it
    const auto progress = [&](double) { return ++calls < end_at; };
    const auto ends = [&](int at, const std::function<void(Watch&)>& work) {
        calls = 0;
        end_at = at;
        return !test::failure(Status::interrupted, [&] { Watch::over(progress, work); }).empty();
    };
    bool has_begun = false;
    CHECK(ends(1, [&](Watch&) { has_begun = true; }));
    CHECK(!has_begun);
    CHECK(ends(2, [](Watch& watch) {
        watch.begin(2);
        while (!*watch.stop()) std::this_thread::yield();
        watch.add(1);
    }));
    CHECK(calls == 2);
    CHECK(!ends(2, [](Watch& watch) {
        watch.begin(2);
        watch.add(1);
        while (!*watch.stop()) std::this_thread::yield();
        watch.add(1);  // all is done
    }));
}

TEST_CASE("what the work or progress throws comes to the caller, when the work has ended") {
    const auto fails = [](Watch&) { throw std::runtime_error("work"); };
    CHECK_THROWS_WITH(Watch::over([](double) { return true; }, fails), "work");
    std::atomic<bool> has_ended{false};
    const auto until_stopped = [&](Watch& watch) {
        while (!*watch.stop()) std::this_thread::yield();
        has_ended = true;
    };
    const auto throws = [](double, int call) {
        if (call > 1) throw std::runtime_error("progress");
        return true;
    };
    int call = 0;
    CHECK_THROWS_WITH(Watch::over([&](double done) { return throws(done, ++call); }, until_stopped), "progress");
    CHECK(has_ended);
}
