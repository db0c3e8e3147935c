// What the stack gate must catch; never linked.
#include <cstddef>

extern void use(volatile char* bytes);
extern int (*hook)(int);

int planted_recursion(int n) {
    return n < 2 ? n : planted_recursion(n - 1) + planted_recursion(n - 2);
}

int planted_large_frame() {
    volatile char bytes[100 * 1024];
    use(bytes);
    return bytes[7];
}

void planted_unknown_size(std::size_t n) {
    use(static_cast<volatile char*>(__builtin_alloca(n)));
}

int planted_indirect(int n) {
    return hook(n) + 1;
}
