#include "lines.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/interrupt.hpp"
#include "scene/byte_order_mark.hpp"
#include "scene/excerpt.hpp"

namespace csgrt::cli {

namespace {

constexpr std::size_t first_buffer = std::size_t{1} << 16;
constexpr std::size_t longest_line = std::size_t{1} << 24;  ///< a longer line means that the file is not text

}  // namespace

LineReader::LineReader(const std::string& path, Passes passes)
    : name_(path == "-" ? "standard input" : path), buffer_(first_buffer, '\0') {
    const bool closed = path == "-" && (fcntl(STDIN_FILENO, F_GETFL) & O_ACCMODE) == O_WRONLY;  // see main.cpp
    if (closed) fail("cannot read", EBADF);
    file_.reset(path == "-" ? fdopen(dup(STDIN_FILENO), "rb") : std::fopen(path.c_str(), "rb"));
    if (!file_) fail("cannot read", errno);
    struct stat about {};
    bool regular = fstat(fileno(file_.get()), &about) == 0 && S_ISREG(about.st_mode);
    if (passes == Passes::several && (!regular || path == "-")) spool();
}

void LineReader::fail(const std::string& what, int code) const {
    check_interrupt();  // a signal may have caused the failure
    throw Error(Status::file, name_ + ": " + what + ": " + (code == EBADF ? "it is closed" : std::strerror(code)));
}

void LineReader::refuse_endless(int line) const {
    throw Error(Status::file, name_ + ": line " + std::to_string(line) + " does not end: no text file");
}

std::size_t LineReader::read(char* into, std::size_t size) {
    // The wait is a series of short waits, because a signal that comes just before a wait does not end the wait.
    const int file = fileno(file_.get());
    pollfd waiting{file, POLLIN, 0};
    for (int ready = 0; ready == 0 || (ready < 0 && errno == EINTR); ready = poll(&waiting, 1, 200)) check_interrupt();
    const ssize_t count = ::read(file, into, size);
    if (count < 0) fail("cannot read", errno);
    return static_cast<std::size_t>(count);
}

void LineReader::spool() {
    File copy(std::tmpfile());
    if (!copy) fail("cannot create a temporary file for it", errno);
    std::size_t unbroken = 0;
    int line = 1;
    while (std::size_t count = read(buffer_.data(), buffer_.size())) {
        const std::string_view piece(buffer_.data(), count);
        const std::size_t last = piece.rfind('\n');
        unbroken = last == piece.npos ? unbroken + count : count - last - 1;
        line += static_cast<int>(std::count(piece.begin(), piece.end(), '\n'));
        if (unbroken > longest_line) refuse_endless(line);
        if (std::fwrite(buffer_.data(), 1, count, copy.get()) != count)
            fail("cannot copy it to a temporary file", errno);
    }
    if (std::fflush(copy.get()) != 0) fail("cannot copy it to a temporary file", errno);
    file_ = std::move(copy);
    rewind();
}

void LineReader::rewind() {
    if (lseek(fileno(file_.get()), 0, SEEK_SET) != 0) fail("cannot read again", errno);
    begin_ = end_ = 0;
    line_number_ = 0;
}

bool LineReader::next(std::string_view& line) {
    std::size_t searched = begin_;
    for (;;) {
        const char* start = buffer_.data();
        if (auto* found = static_cast<const char*>(std::memchr(start + searched, '\n', end_ - searched))) {
            auto line_end = static_cast<std::size_t>(found - start);
            line = std::string_view(start + begin_, line_end - begin_);
            begin_ = line_end + 1;
            break;
        }
        std::size_t kept = end_ - begin_;
        std::memmove(buffer_.data(), buffer_.data() + begin_, kept);
        begin_ = 0;
        end_ = searched = kept;
        if (kept == buffer_.size()) {
            if (kept >= longest_line) refuse_endless(line_number_ + 1);
            buffer_.resize(2 * kept);
        }
        std::size_t count = read(buffer_.data() + end_, buffer_.size() - end_);
        end_ += count;
        if (count > 0) continue;
        if (kept == 0) return false;
        line = std::string_view(buffer_.data(), kept);  // the last line, without a line break
        begin_ = end_;
        break;
    }
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line_number_ == 0 && line.starts_with(byte_order_mark)) line.remove_prefix(byte_order_mark.size());
    ++line_number_;
    line_ = line;
    return true;
}

Diagnostic LineReader::finding(int column, std::string message, std::string suggestion) const {
    Diagnostic result;
    result.place.file = name_;
    result.place.line = line_number_;
    result.place.column = column;
    result.message = std::move(message);
    result.suggestion = std::move(suggestion);
    result.excerpt = excerpt(line_, static_cast<std::size_t>(column) - 1);
    return result;
}

void split(std::string_view line, std::vector<Word>& words) {
    constexpr std::string_view blanks = " \t\v\f\r";
    words.clear();
    for (std::size_t begin = line.find_first_not_of(blanks); begin != line.npos;) {
        std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
        words.push_back({line.substr(begin, end - begin), static_cast<int>(begin + 1)});
        begin = line.find_first_not_of(blanks, end);
    }
}

}  // namespace csgrt::cli
