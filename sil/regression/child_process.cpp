#include "sil/regression/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace semtrack::sil {

namespace {

constexpr const char* kThisProgram = "/proc/self/exe";
constexpr int kSignalBase = 128;  // as a shell says it

/// posix_spawn's file actions, freed whatever happens.
class Redirection {
public:
    explicit Redirection(const std::string& log) {
        (void)posix_spawn_file_actions_init(&actions_);
        (void)posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                               0644);
        (void)posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    }
    ~Redirection() { (void)posix_spawn_file_actions_destroy(&actions_); }
    Redirection(const Redirection&) = delete;
    Redirection& operator=(const Redirection&) = delete;
    [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_{};
};

}  // namespace

int start_child(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
    std::vector<std::string> words{"semtrack-sil"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    const Redirection redirection(log.string());
    pid_t process = 0;
    const int error = posix_spawn(&process, kThisProgram, redirection.get(), nullptr, argv.data(), environ);
    if (error != 0) {
        throw std::runtime_error(std::string("a replay cannot be started: ") + std::strerror(error));
    }
    return process;
}

ChildEnd wait_for_child() {
    int status = 0;
    pid_t process = -1;
    do {
        process = waitpid(-1, &status, 0);
    } while (process < 0 && errno == EINTR);
    if (process < 0) {
        throw std::runtime_error(std::string("waiting for a replay: ") + std::strerror(errno));
    }
    return {process, WIFEXITED(status) ? WEXITSTATUS(status) : kSignalBase + WTERMSIG(status)};
}

void stop_children(const std::vector<int>& processes) {
    for (const int process : processes) {
        (void)kill(process, SIGTERM);
    }
    for (const int process : processes) {
        (void)waitpid(process, nullptr, 0);
    }
}

}  // namespace semtrack::sil
