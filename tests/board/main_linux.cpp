// usage: semtrack-board-run FILE    what the board does with its scene, where there are files: the host, or qemu-user.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "board/run_scene.hpp"

int main(int argc, char** argv) {
    if (argc != 2) {
        (void)std::fputs("usage: semtrack-board-run FILE\n", stderr);
        return 2;
    }
    std::ifstream in(argv[1], std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const semtrack::board::SceneResult result =
        semtrack::board::run_scene(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    char line[semtrack::board::kLineBytes];
    semtrack::board::format_result(result, line);
    (void)std::fputs(line, stdout);
    return result.complete ? 0 : 1;
}
