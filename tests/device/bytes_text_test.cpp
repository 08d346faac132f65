#include "catch.hpp"

#include "device/bytes_text.hpp"
#include "device/host_memory.hpp"

using namespace csgrt;

TEST_CASE("amounts of memory read as people write them", "[device]") {
    CHECK(bytes_text(0) == "0 bytes");
    CHECK(bytes_text(1023) == "1023 bytes");
    CHECK(bytes_text(1024) == "1.0 KiB");
    CHECK(bytes_text(1536 * 1024) == "1.5 MiB");
    CHECK(bytes_text(std::uint64_t{3} << 30) == "3.0 GiB");
    CHECK(bytes_text(std::uint64_t{1} << 50) == "1024.0 TiB");
}

TEST_CASE("the host says how much memory it has left", "[device]") {
    CHECK(available_host_memory() > (std::uint64_t{1} << 24));
    CHECK(available_host_memory() < (std::uint64_t{1} << 50));
}
