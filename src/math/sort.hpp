// Sorting with a bound on work and stack: std::sort recurses and leaves equal keys in any order.
#ifndef SEMTRACK_MATH_SORT_HPP
#define SEMTRACK_MATH_SORT_HPP

#include <cstddef>

namespace semtrack {

namespace detail {
template <class T>
void sift_down(T* items, int root, int end) {
    const T moved = items[root];
    for (int child = 2 * root + 1; child < end; child = 2 * root + 1) {
        if (child + 1 < end && items[child] < items[child + 1]) {
            ++child;
        }
        if (!(moved < items[child])) {
            break;
        }
        items[root] = items[child];
        root = child;
    }
    items[root] = moved;
}
}  // namespace detail

/// Heap sort, ascending, in place; at most 2 n log2(n) comparisons. Keys must be unique, or equal items
/// indistinguishable: then the result is the same everywhere.
template <class T>
void heap_sort(T* items, int n) {
    for (int root = n / 2 - 1; root >= 0; --root) {
        detail::sift_down(items, root, n);
    }
    for (int end = n - 1; end > 0; --end) {
        const T largest = items[0];
        items[0] = items[end];
        items[end] = largest;
        detail::sift_down(items, 0, end);
    }
}

}  // namespace semtrack

#endif
