// The program. Exit status: 0 done; 1 the run failed, or a bound or baseline is broken; 2 bad input or bad usage, one
// line on stderr.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include "math/float_env.hpp"
#include "sil/evaluation.hpp"
#include "sil/options.hpp"
#include "sil/regression/run_scenarios.hpp"
#include "sil/render.hpp"
#include "sil/replay.hpp"
#include "sil/report/text_output.hpp"
#include "sil/sequence.hpp"

namespace {

using namespace semtrack::sil;

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kBadInput = 2;

void run_convert(const ConvertCommand& command) {
    const std::string text = converted_detections(command.convert);
    try {
        write_file(command.out, text);
    } catch (const std::runtime_error& error) {
        throw InputError(error.what());
    }
}

/// false: a bound or a baseline is broken.
bool dispatch(const CommandLine& line) {
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
        case Command::kRun:
            return run_scenarios(line.run);
        case Command::kConvert:
            run_convert(line.convert);
            break;
    }
    return true;
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
        const bool kept = dispatch(parse_command_line(argc, argv));
        if (std::fflush(stdout) != 0) {
            return complain("stdout: cannot be written", kFailed);
        }
        return kept ? kDone : kFailed;
    } catch (const InputError& error) {
        return complain(error.what(), kBadInput);
    } catch (const std::exception& error) {
        return complain(error.what(), kFailed);
    } catch (...) {
        return complain("failed for an unknown reason", kFailed);
    }
}
