// A vector with its capacity in the type: no heap, and a full one answers instead of guessing.
#ifndef SEMTRACK_STATIC_VECTOR_HPP
#define SEMTRACK_STATIC_VECTOR_HPP

#include <array>
#include <cstddef>

namespace semtrack {

template <class T, int kCapacity>
class StaticVector {
public:
    /// false: full, nothing was stored.
    [[nodiscard]] bool try_push_back(const T& value) {
        if (size_ == kCapacity) { return false; }
        items_[static_cast<std::size_t>(size_)] = value;
        ++size_;
        return true;
    }
    /// Removes item i and moves the later ones down (order is kept). i must be valid.
    void erase(int i) {
        for (int k = i + 1; k < size_; ++k) { (*this)[k - 1] = (*this)[k]; }
        --size_;
    }
    void clear() { size_ = 0; }
    /// Keeps the first n items; n at most size().
    void truncate(int n) { size_ = n < size_ ? n : size_; }
    [[nodiscard]] int size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] bool full() const { return size_ == kCapacity; }
    [[nodiscard]] static constexpr int capacity() { return kCapacity; }
    [[nodiscard]] T& operator[](int i) { return items_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const T& operator[](int i) const { return items_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] T& back() { return (*this)[size_ - 1]; }
    [[nodiscard]] const T& back() const { return (*this)[size_ - 1]; }
    [[nodiscard]] T* begin() { return items_.data(); }
    [[nodiscard]] T* end() { return items_.data() + size_; }
    [[nodiscard]] const T* begin() const { return items_.data(); }
    [[nodiscard]] const T* end() const { return items_.data() + size_; }

private:
    std::array<T, static_cast<std::size_t>(kCapacity)> items_{};
    int size_{0};
};

}  // namespace semtrack

#endif
