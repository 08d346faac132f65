#include "catch.hpp"

#include <algorithm>

#include "device/choice.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

DeviceInfo made_up(const char* name, const char* type, bool fp64) {
    DeviceInfo info{.name = name};
    info.platform = "Platform of " + info.name;
    info.type = type;
    info.fp64 = fp64;
    return info;
}

const std::vector<DeviceInfo> several = {made_up("Slow CPU", "cpu", true), made_up("Toy GPU", "gpu", false),
                                         made_up("Real GPU", "gpu", true), made_up("Other GPU", "gpu", true)};

std::string refusal(const std::vector<DeviceInfo>& devices, const std::string& choice) {
    std::string chose;
    const auto choose = [&] { chose = "chose " + std::to_string(choose_device(devices, choice)); };
    return test::failure(Status::no_device, choose) + chose;
}

}  // namespace

TEST_CASE("a device is chosen by nothing, type, number or part of a name", "[device][promise:devices]") {
    CHECK(choose_device(several, "") == 2);  // a GPU, and one with double precision
    CHECK(choose_device(several, "cpu") == 0);
    CHECK(choose_device(several, "gpu") == 2);
    CHECK(choose_device(several, "GPU") == 2);
    CHECK(choose_device(several, "0") == 0);
    CHECK(choose_device(several, "3") == 3);
    CHECK(choose_device(several, "other") == 3);
    CHECK(choose_device(several, "platform of slow") == 0);
    CHECK(choose_device({several[1], several[0]}, "") == 1);  // no GPU will do: the first that will
}

TEST_CASE("a device that is not there is refused with a list of those that are", "[device]") {
    const std::string unknown = refusal(several, "radeon");
    CHECK(unknown.starts_with("no device has \"radeon\" in its name\n"));
    CHECK(unknown.find("0: Slow CPU (cpu, Platform of Slow CPU)") != std::string::npos);
    CHECK(unknown.find("1: Toy GPU (gpu, Platform of Toy GPU, no double precision)") != std::string::npos);
    CHECK(unknown.find("3: Other GPU") != std::string::npos);

    CHECK(unknown.find("did you mean") == std::string::npos);
    CHECK(refusal(several, "gppu").find("\n  did you mean 'gpu'?\n") != std::string::npos);
    CHECK(refusal(several, "otehr").find("\n  did you mean 'Other'?\n") != std::string::npos);
    CHECK(refusal(several, "cpu,real gup").find("chose") == std::string::npos);

    for (const std::string& none : {refusal(several, "Reference"), refusal({}, "reference")}) {
        CHECK(none.starts_with("the CPU reference is no device\n"));
        CHECK(none.find("--reference (Settings::reference) computes with it") != std::string::npos);
    }
    CHECK(refusal(several, "4").starts_with("no device has the number 4\n"));
    CHECK(refusal(several, "99999999999999999999999").starts_with("no device has the number 9999"));
    CHECK(refusal(several, "accelerator").starts_with("no device of the type accelerator was found\n"));
}

TEST_CASE("a device without double precision is refused for that", "[device][promise:devices]") {
    CHECK(refusal(several, "1").starts_with("device 1 has no double precision\n"));
    CHECK(refusal(several, "toy").starts_with("no device has \"toy\" in its name and double precision\n"));
    CHECK(refusal({several[1]}, "gpu").starts_with("no device of the type gpu has double precision\n"));
    CHECK(refusal({several[1]}, "").starts_with("no device has double precision\n"));
}

TEST_CASE("without any device, the package that brings one is named", "[device]") {
    const std::string none = refusal({}, "");
    CHECK(none.starts_with("no device was found\n"));
    CHECK(none.find("pocl-opencl-icd") != std::string::npos);
    CHECK(refusal({}, "gpu") == none);
}

TEST_CASE("every device describes itself", "[device]") {
    const std::vector<DeviceInfo> found = devices();
    REQUIRE(!found.empty());
    for (const DeviceInfo& info : found) {
        CHECK(!info.name.empty());
        CHECK(!info.platform.empty());
        CHECK((is_native(info) || info.version.starts_with("OpenCL ")));
        CHECK(!info.driver.empty());
        CHECK((info.type == "cpu" || info.type == "gpu" || info.type == "accelerator"));
        CHECK(info.memory >= info.max_allocation);
        CHECK(info.max_allocation > 0);
        CHECK(info.compute_units > 0);
    }
}

TEST_CASE("without a driver there are native devices alone, and that is no failure", "[.no_driver][promise:devices]") {
    REQUIRE(setenv("POCL_CACHE_DIR", "/dev/null/none", 1) == 0);  // PoCL could not write there
    prepare_devices();
    std::vector<std::string> notes;
    const std::vector<DeviceInfo> found = devices(&notes);
    CHECK(std::all_of(found.begin(), found.end(), is_native));
    CHECK(notes == std::vector<std::string>());
    CHECK(std::getenv("POCL_CACHE_DIR") ==
          std::string("/dev/null/none"));  // the environment is the program's, not the library's
}

TEST_CASE("native devices have double precision's kernels alone, and come before other processors",
          "[device][promise:devices]") {
    DeviceInfo native = made_up("native-level", "cpu", true);
    native.platform = "csgrt";
    const std::vector<DeviceInfo> all = {several[1], native, several[0]};
    CHECK(choose_device(all, "") == 1);
    CHECK(choose_device(all, "cpu") == 1);
    CHECK(choose_device(all, "native") == 1);
    CHECK(choose_device(all, "", Kernels::compiled_by_device) == 2);
    CHECK(choose_device(all, "cpu", Kernels::compiled_by_device) == 2);
    for (const char* choice : {"native", "1"}) {
        INFO(choice);
        CHECK_THROWS_WITH(choose_device(all, choice, Kernels::compiled_by_device),
                          ContainsSubstring("double precision alone"));
    }
    CHECK_THROWS_WITH(choose_device({native}, "", Kernels::compiled_by_device),
                      ContainsSubstring("double precision alone"));
    DeviceInfo pocl = several[0];
    pocl.version = "OpenCL 3.0 PoCL HSTR";
    CHECK(choose_device({native, several[0], pocl}, "pocl") == 2);
}

TEST_CASE("several devices are chosen by several choices, or as all GPUs", "[device][promise:devices]") {
    using Numbers = std::vector<std::size_t>;
    CHECK(choose_devices(several, "") == Numbers{2});
    CHECK(choose_devices(several, "other") == Numbers{3});
    CHECK(choose_devices(several, "3,0") == Numbers{3, 0});
    CHECK(choose_devices(several, "cpu,gpu,other") == Numbers{0, 2, 3});
    CHECK(choose_devices(several, "gpus") == Numbers{2, 3});
    const auto refusal_of = [](const std::vector<DeviceInfo>& devices, const std::string& choice) {
        return test::failure(Status::no_device, [&] { choose_devices(devices, choice); });
    };
    CHECK(refusal_of(several, "gpu,2").starts_with("\"gpu,2\" means device 2 twice\n"));
    CHECK(refusal_of(several, "0,7").starts_with("no device has the number 7\n"));
    CHECK(refusal_of({several[0], several[1]}, "gpus").starts_with("no device of the type gpu was found that has"));
}
