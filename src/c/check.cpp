#include "c/described.hpp"

using namespace csgrt;
using namespace csgrt::c;

struct csgrt_checker {
    Checker checker;
    CheckResult result = {};  ///< the last one
    std::vector<AllowedOverlap> allowed = {};
};

csgrt_status csgrt_checker_create(const csgrt_model* model, const csgrt_settings* settings, csgrt_checker** checker) {
    return make(checker, [&] { return Checker(CSGRT_NEED(model).model, settings_of(settings)); });
}

void csgrt_checker_free(csgrt_checker* checker) { delete checker; }

csgrt_status csgrt_checker_check(csgrt_checker* checker, const csgrt_check_request* request,
                                 csgrt_check_result* result) {
    return call([&] {
        csgrt_checker& c = CSGRT_NEED(checker);
        auto wanted = request_of<CheckRequest>(request, csgrt_check_request CSGRT_CHECK_REQUEST);
        if (wanted.allowed.empty()) wanted.allowed = c.allowed;
        c.result = c.checker.check(wanted);
        fill(result, shown<csgrt_check_result>(c.result), "result");
    });
}

csgrt_status csgrt_checker_overlap(const csgrt_checker* checker, size_t index, csgrt_found_overlap* overlap) {
    return call([&] {
        fill(overlap, shown<csgrt_found_overlap>(item(CSGRT_NEED(checker).result.overlaps, index)), "overlap");
    });
}

csgrt_status csgrt_checker_unlisted(const csgrt_checker* checker, size_t index, csgrt_unlisted_pair* pair) {
    return call(
        [&] { fill(pair, shown<csgrt_unlisted_pair>(item(CSGRT_NEED(checker).result.unlisted, index)), "pair"); });
}

csgrt_status csgrt_checker_unused(const csgrt_checker* checker, size_t index, csgrt_allowed_overlap* row) {
    return call([&] {
        const AllowedOverlap& unused = item(CSGRT_NEED(checker).result.unused, index);
        CSGRT_NEED(row) = {unused.first.c_str(), unused.second.c_str()};
    });
}

csgrt_status csgrt_checker_unbounded(const csgrt_checker* checker, size_t index, uint32_t* region) {
    return call([&] { CSGRT_NEED(region) = item(CSGRT_NEED(checker).result.unbounded, index); });
}

csgrt_status csgrt_checker_load_allowed(csgrt_checker* checker, const char* path) {
    return call([&] { CSGRT_NEED(checker).allowed = load_allowed_overlaps(&CSGRT_NEED(path)); });
}
