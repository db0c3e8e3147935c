// Counts every allocation of the process while it is asked to, whoever makes it.
#ifndef SEMTRACK_TESTS_SIL_HEAP_COUNTING_MALLOC_HPP
#define SEMTRACK_TESTS_SIL_HEAP_COUNTING_MALLOC_HPP

namespace semtrack {

/// Allocations by malloc, calloc, realloc and aligned_alloc (and so by new) between construction and count().
class AllocationCounter {
public:
    AllocationCounter();
    ~AllocationCounter();
    AllocationCounter(const AllocationCounter&) = delete;
    AllocationCounter& operator=(const AllocationCounter&) = delete;
    [[nodiscard]] long count() const;
};

}  // namespace semtrack

#endif
