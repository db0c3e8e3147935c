// Text out and an exit status through the debugger or emulator (ARM semihosting).
#ifndef SEMTRACK_TESTS_BOARD_SEMIHOST_HPP
#define SEMTRACK_TESTS_BOARD_SEMIHOST_HPP

namespace semtrack::board {

void print(const char* text);
[[noreturn]] void leave(int status);

}  // namespace semtrack::board

#endif
