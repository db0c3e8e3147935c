// The program. Exit status: 0 done; 1 the run failed; 2 bad input or bad usage, one line on stderr.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include "math/float_env.hpp"
#include "sil/evaluation.hpp"
#include "sil/options.hpp"
#include "sil/render.hpp"
#include "sil/replay.hpp"
#include "sil/sequence.hpp"

namespace {

using namespace semtrack::sil;

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kBadInput = 2;

void dispatch(const CommandLine& line) {
    switch (line.command) {
        case Command::kHelp:
            (void)std::fputs(line.help.c_str(), stdout);
            break;
        case Command::kReplay:
            run_replay(line.replay);
            break;
        case Command::kRender:
            run_render(line.render);
            break;
        case Command::kEvaluate:
            run_evaluate(line.evaluate);
            break;
    }
}

/// Always one line, whatever a file is called.
int complain(std::string text, int status) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    std::replace(text.begin(), text.end(), '\r', ' ');
    (void)std::fprintf(stderr, "semtrack-sil: %s\n", text.c_str());
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    const semtrack::FloatEnvironment environment;  // a preloaded library may have set another
    try {
        dispatch(parse_command_line(argc, argv));
        return std::fflush(stdout) == 0 ? kDone : complain("stdout: cannot be written", kFailed);
    } catch (const InputError& error) {
        return complain(error.what(), kBadInput);
    } catch (const std::exception& error) {
        return complain(error.what(), kFailed);
    } catch (...) {
        return complain("failed for an unknown reason", kFailed);
    }
}
