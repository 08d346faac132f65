#include "native/pool.hpp"

#include "base/parallel.hpp"

namespace csgrt::native {

Pool::Pool(unsigned threads) {
    for (unsigned i = 1; i < thread_count(threads) && threads_.add([this] { wait_for_work(); });) ++i;
}

Pool::~Pool() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    begun_.notify_all();
}

void Pool::run(const std::function<void()>& work) {
    {
        const std::lock_guard lock(mutex_);
        work_ = &work;
        running_ = threads_.size();
        ++number_;
    }
    begun_.notify_all();
    work();
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [this] { return running_ == 0; });
}

void Pool::wait_for_work() {
    std::size_t done = 0;
    std::unique_lock lock(mutex_);
    for (;;) {
        begun_.wait(lock, [&] { return stop_ || number_ != done; });
        if (stop_) return;
        done = number_;
        const std::function<void()>& work = *work_;
        lock.unlock();
        work();
        lock.lock();
        if (--running_ == 0) ended_.notify_one();
    }
}

}  // namespace csgrt::native
