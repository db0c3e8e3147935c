#include "hal/linux/thread_executor.hpp"

namespace semtrack::hal {

namespace {

class Lock {
public:
    explicit Lock(pthread_mutex_t& mutex) : mutex_(mutex) { (void)pthread_mutex_lock(&mutex_); }
    ~Lock() { (void)pthread_mutex_unlock(&mutex_); }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

private:
    pthread_mutex_t& mutex_;
};

}  // namespace

ThreadExecutor::ThreadExecutor() noexcept {
    (void)pthread_mutex_init(&mutex_, nullptr);
    (void)pthread_cond_init(&begun_, nullptr);
    (void)pthread_cond_init(&ended_, nullptr);
}

ThreadExecutor::~ThreadExecutor() noexcept {
    stop();
    (void)pthread_cond_destroy(&ended_);
    (void)pthread_cond_destroy(&begun_);
    (void)pthread_mutex_destroy(&mutex_);
}

bool ThreadExecutor::start(int workers) noexcept {
    if (workers < 1 || workers > kMaxWorkers || workers_ != 1) {
        return false;
    }
    for (int w = 1; w < workers; ++w) {
        Seat& seat = seats_[static_cast<std::size_t>(w)];
        seat.owner = this;
        seat.worker = w;
        if (pthread_create(&seat.thread, nullptr, &ThreadExecutor::entry, &seat) != 0) {
            stop();
            return false;
        }
        workers_ = w + 1;
    }
    return true;
}

void ThreadExecutor::stop() noexcept {
    {
        const Lock lock(mutex_);
        stopping_ = true;
        (void)pthread_cond_broadcast(&begun_);
    }
    for (int w = 1; w < workers_; ++w) {
        (void)pthread_join(seats_[static_cast<std::size_t>(w)].thread, nullptr);
    }
    const Lock lock(mutex_);
    stopping_ = false;
    workers_ = 1;
}

void* ThreadExecutor::entry(void* seat) noexcept {
    const Seat& s = *static_cast<const Seat*>(seat);
    s.owner->work(s.worker);
    return nullptr;
}

// A thread sleeps until there is a round that it has not worked in.
void ThreadExecutor::work(int worker) noexcept {
    std::uint64_t done = 0;
    for (;;) {
        {
            const Lock lock(mutex_);
            while (!stopping_ && round_ == done) {
                (void)pthread_cond_wait(&begun_, &mutex_);
            }
            if (stopping_) {
                return;
            }
            done = round_;
        }
        take_jobs(worker);
        const Lock lock(mutex_);
        if (--busy_ == 0) {
            (void)pthread_cond_signal(&ended_);
        }
    }
}

void ThreadExecutor::take_jobs(int worker) noexcept {
    for (;;) {
        int job = 0;
        {
            const Lock lock(mutex_);
            if (next_ >= count_) {
                return;
            }
            job = next_++;
        }
        jobs_->run(job, worker);
    }
}

void ThreadExecutor::run(Jobs& jobs, int count) noexcept {
    {
        const Lock lock(mutex_);
        jobs_ = &jobs;
        count_ = count;
        next_ = 0;
        busy_ = workers_ - 1;
        ++round_;
        (void)pthread_cond_broadcast(&begun_);
    }
    take_jobs(0);
    const Lock lock(mutex_);
    while (busy_ != 0) {  // all of them: a late one must not take the next run's jobs for this one's
        (void)pthread_cond_wait(&ended_, &mutex_);
    }
}

}  // namespace semtrack::hal
