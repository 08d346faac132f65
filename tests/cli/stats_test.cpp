#include "cli/text/statistics.hpp"

#include "catch.hpp"

using csgrt::Statistics;

TEST_CASE("medians leave out the first of several frames, and counts are the last frame's", "[promise:command]") {
    std::vector<Statistics> frames;
    for (double time : {100.0, 3.0, 1.0, 2.0}) {
        Statistics& frame = frames.emplace_back();
        frame.ms.frame = time;
        frame.ms.weave = 10 * time;
        frame.ends = static_cast<std::uint64_t>(time);
    }
    CHECK(csgrt::cli::median_of({frames[0]}).ms.frame == 100);
    CHECK(csgrt::cli::median_of({frames[0], frames[1]}).ms.frame == 3);
    CHECK(csgrt::cli::median_of({frames[0], frames[1], frames[2]}).ms.frame == 2);
    const Statistics median = csgrt::cli::median_of(frames);
    CHECK(median.ms.frame == 2);
    CHECK(median.ms.weave == 20);
    CHECK(median.ms.shade == 0);
    CHECK(median.ends == 2);
}

TEST_CASE("figures are JSON whatever the device is called") {
    Statistics statistics;
    statistics.device = "a \"quoted\\name\"\n";
    statistics.width = 3;
    statistics.height = 2;
    statistics.partitions_used = 5;
    statistics.partitions_allocated = 7;
    statistics.ms.frame = 0.25;
    const std::string json = csgrt::cli::to_json(statistics);
    CHECK(json.starts_with("{\n  \"device\": \"a \\\"quoted\\\\name\\\"\\u000a\",\n"));
    CHECK(json.find("\"size\": [3, 2]") != json.npos);
    CHECK(json.find("\"partitions\": {\"used\": 5, \"allocated\": 7}") != json.npos);
    CHECK(json.find("\"frame\": 0.2500, \"write\": 0.0000}\n}\n") != json.npos);
}
