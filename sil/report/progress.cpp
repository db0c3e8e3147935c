#include "sil/report/progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace semtrack::sil {

namespace {
constexpr const char* kEraseLine = "\r\x1b[K";
}

Progress::Progress(bool wanted, int total, const char* what)
    : on_(wanted && total > 0 && ::isatty(STDERR_FILENO) == 1), total_(total), what_(what) {}

Progress::~Progress() {
    if (on_) {
        (void)std::fputs(kEraseLine, stderr);
    }
}

void Progress::show(int done, int number) {
    const int tenth_percent = on_ ? static_cast<int>(1000LL * done / total_) : last_tenth_percent_;
    if (tenth_percent == last_tenth_percent_) {
        return;
    }
    last_tenth_percent_ = tenth_percent;
    (void)std::fprintf(stderr, "%s%s %d  (%d of %d)", kEraseLine, what_, number, done, total_);
    (void)std::fflush(stderr);
}

}  // namespace semtrack::sil
