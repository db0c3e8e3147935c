// This program again, as a child process.
#ifndef SEMTRACK_SIL_REGRESSION_CHILD_PROCESS_HPP
#define SEMTRACK_SIL_REGRESSION_CHILD_PROCESS_HPP

#include <filesystem>
#include <string>
#include <vector>

namespace semtrack::sil {

/// Starts the running program with these arguments; stdout and stderr go to `log`. Returns the process number.
/// Throws std::runtime_error when that is impossible.
[[nodiscard]] int start_child(const std::vector<std::string>& arguments, const std::filesystem::path& log);

struct ChildEnd {
    int process{0};
    int status{0};  ///< exit status; 128 + signal when it was killed
};
/// Waits for any child.
[[nodiscard]] ChildEnd wait_for_child();
/// SIGTERM to each, and waits for them.
void stop_children(const std::vector<int>& processes);

}  // namespace semtrack::sil

#endif
