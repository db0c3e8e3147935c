// A planted violation for the thread sanitizer: two threads count without a lock.
#include <thread>

int main() {
    int count = 0;
    const auto add = [&count] {
        for (int i = 0; i < 1000; ++i) {
            ++count;
        }
    };
    std::thread other(add);
    add();
    other.join();
    return count > 0 ? 0 : 1;
}
