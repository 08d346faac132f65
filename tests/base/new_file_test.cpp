// Files that a process left which was killed, and those of others that write the same place at once.
#include <atomic>
#include <filesystem>
#include <thread>
#include <vector>

#include <unistd.h>

#include "base/new_file.hpp"
#include "catch.hpp"
#include "folder.hpp"

using csgrt::NewFile;
using csgrt::test::Folder;
namespace fs = std::filesystem;

namespace {

/// As a process leaves it that is killed.
void leave(const std::string& file) {
    if (const int part = open(file.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600); part >= 0) close(part);
}

}  // namespace

TEST_CASE("what a killed process left is removed by the next that writes that file, and no other's is",
          "[promise:files]") {
    const Folder folder;
    const std::string file = folder / "a";
    leave(folder / "a.0.part");
    leave(folder / "b.0.part");
    NewFile first(file);
    leave(folder / "a.1.part");
    leave(folder / "a.4.part");
    fs::create_symlink(folder / "b.0.part", folder / "a.3.part");
    NewFile second(file);  // beside the first, which lives
    CHECK(folder.files().size() == 4);
    first.write("first");
    second.write("second");
    first.keep();
    CHECK(csgrt::test::read_file(file) == "first");
    NewFile third(file);
    third.write("third");
    second.keep();
    CHECK(csgrt::test::read_file(file) == "second");
    third.keep();
    CHECK(csgrt::test::read_file(file) == "third");
    CHECK(folder.files().size() == 3);  // the link and another file's
}

TEST_CASE("threads that write one file at once, beside what others left, lose none and leave nothing",
          "[promise:files]") {
    const Folder folder;
    const std::string file = folder / "a";
    std::atomic<int> wrong{0}, refused{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            for (int i = 0; i < 300; ++i) {
                try {
                    NewFile mine(file);
                    for (int part = 0; part < 10; ++part) mine.write(std::string(50, static_cast<char>('a' + t)));
                    if (i % 3 == 0) leave(folder / "a." + std::to_string(i % 5) + ".part");
                    if (i % 4 != 0) mine.keep();
                } catch (const csgrt::Error&) {
                    ++refused;
                }
                const std::string found = csgrt::test::read_file(file);
                const bool whole = found.size() == 500 && found.find_first_not_of(found[0]) == found.npos;
                if (!whole && i % 4 != 0) ++wrong;
            }
        });
    for (std::thread& thread : threads) thread.join();
    CHECK(wrong == 0);
    CHECK(refused == 0);
    NewFile(file).keep();  // removes the last that were left
    CHECK(folder.files().size() == 1);
}
