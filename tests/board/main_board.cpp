// The board's program: the scene in flash through the tracker, its hash and the stack it took to the console.
#include <cstdint>

#include "board/run_scene.hpp"
#include "board/semihost.hpp"

__asm__(
    ".section .rodata.scene, \"a\"\n"
    ".balign 8\n"
    ".global board_scene_begin\n"
    "board_scene_begin:\n"
    ".incbin \"" SEMTRACK_BOARD_SCENE
    "\"\n"
    ".global board_scene_end\n"
    "board_scene_end:\n"
    ".text\n");

extern "C" {
extern const std::uint8_t board_scene_begin[];
extern const std::uint8_t board_scene_end[];
extern std::uint32_t board_stack_begin[];
extern std::uint32_t board_stack_end[];
}

namespace {

constexpr std::uint32_t kPaint = 0xA5A5A5A5U;

/// Below what is in use now.
void paint_stack() {
    const auto* const here = static_cast<const std::uint32_t*>(__builtin_frame_address(0)) - 64;
    for (std::uint32_t* p = board_stack_begin; p < here; ++p) {
        *p = kPaint;
    }
}

std::uint32_t stack_used() {
    const std::uint32_t* p = board_stack_begin;
    while (p < board_stack_end && *p == kPaint) {
        ++p;
    }
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(board_stack_end) -
                                      reinterpret_cast<std::uintptr_t>(p));
}

void print_stack(std::uint32_t bytes) {
    char text[] = "stack 0000000 bytes\n";
    for (char* digit = text + 12; bytes != 0U; bytes /= 10U) {
        *digit-- = static_cast<char>('0' + bytes % 10U);
    }
    semtrack::board::print(text);
}

}  // namespace

extern "C" void board_main();  // called by the start-up code

void board_main() {
    paint_stack();
    const semtrack::board::SceneResult result =
        semtrack::board::run_scene(board_scene_begin, static_cast<std::size_t>(board_scene_end - board_scene_begin));
    char line[semtrack::board::kLineBytes];
    semtrack::board::format_result(result, line);
    semtrack::board::print(line);
    print_stack(stack_used());
    semtrack::board::leave(result.complete ? 0 : 1);
}
