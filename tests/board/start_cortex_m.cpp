// Start-up of a Cortex-M without operating system: vectors, floating-point unit, data, bss, constructors, board_main().
// A heap is not there: who asks for it ends the program.
#include <cstdint>

#include "board/semihost.hpp"

extern "C" {

extern std::uint32_t board_data_from[];
extern std::uint32_t board_data_begin[];
extern std::uint32_t board_data_end[];
extern std::uint32_t board_bss_begin[];
extern std::uint32_t board_bss_end[];
extern std::uint32_t board_stack_begin[];
extern std::uint32_t board_stack_end[];
using Constructor = void (*)();
extern const Constructor board_constructors_begin[];
extern const Constructor board_constructors_end[];

void board_main();

void* _sbrk(int) {
    semtrack::board::print("the heap was asked for\n");
    semtrack::board::leave(97);
}
void __cxa_pure_virtual() {
    semtrack::board::print("pure virtual call\n");
    semtrack::board::leave(96);
}
int __aeabi_atexit(void*, void (*)(void*), void*) {  // the program never ends: nothing is ever destroyed
    return 0;
}
void* __dso_handle = nullptr;

__attribute__((used, noreturn)) void board_fault() {
    semtrack::board::print("fault\n");
    semtrack::board::leave(98);
}

__attribute__((used, noreturn)) void board_reset() {
    auto* const cpacr = reinterpret_cast<volatile std::uint32_t*>(0xE000ED88U);  // access to coprocessors 10 and 11
    *cpacr = *cpacr | (0xFU << 20U);
    __asm__ volatile("dsb\n isb");
    const std::uint32_t* from = board_data_from;
    for (std::uint32_t* to = board_data_begin; to < board_data_end; ++to) {
        *to = *from++;
    }
    for (std::uint32_t* to = board_bss_begin; to < board_bss_end; ++to) {
        *to = 0U;
    }
    for (const Constructor* c = board_constructors_begin; c < board_constructors_end; ++c) {
        (*c)();
    }
    board_main();
    semtrack::board::leave(95);  // it never returns
}

using Vector = void (*)();
struct Vectors {
    const void* stack;
    Vector reset;
    Vector faults[14];
};
__attribute__((section(".vectors"), used)) const Vectors board_vectors{
    board_stack_end, board_reset, {board_fault, board_fault, board_fault, board_fault, board_fault}};

}  // extern "C"

namespace semtrack::board {

namespace {

void call(std::uint32_t operation, const void* argument) {
    register std::uint32_t r0 __asm__("r0") = operation;
    register const void* r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

}  // namespace

void print(const char* text) {
    call(0x04U, text);  // SYS_WRITE0
}

void leave(int status) {
    const std::uint32_t block[2] = {0x20026U, static_cast<std::uint32_t>(status)};  // ADP_Stopped_ApplicationExit
    call(0x20U, block);                                                             // SYS_EXIT_EXTENDED
    for (;;) {
    }
}

}  // namespace semtrack::board
