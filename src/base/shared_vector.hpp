// Shared vector: a vector whose copies share its elements.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace csgrt {

/// A std::vector whose copies share the elements until a copy is changed. The holder of the only copy may write to
/// different elements from several threads.
template <class T>
class SharedVector {
public:
    using value_type = T;
    using Vector = std::vector<T>;

    SharedVector() = default;
    SharedVector(Vector values) : values_(std::make_shared<Vector>(std::move(values))) {}  // NOLINT: it is the same
    SharedVector(std::initializer_list<T> values) : SharedVector(Vector(values)) {}

    const Vector& get() const noexcept {
        static const Vector* const none = new Vector;  // never destroyed: threads read it while the process ends
        return values_ ? *values_ : *none;
    }
    /// The elements, to be changed. If another copy shares them, they are copied first.
    Vector& own() {
        if (!values_)
            values_ = std::make_shared<Vector>();
        else if (values_.use_count() > 1)
            values_ = std::make_shared<Vector>(*values_);
        return *values_;
    }
    operator const Vector&() const noexcept { return get(); }
    operator Vector&() { return own(); }

    /// Whether the two vectors share their elements.
    bool shares(const SharedVector& other) const noexcept { return values_ == other.values_; }

    std::size_t size() const noexcept { return get().size(); }
    bool empty() const noexcept { return get().empty(); }
    const T* data() const noexcept { return get().data(); }
    auto begin() const noexcept { return get().begin(); }
    auto end() const noexcept { return get().end(); }
    const T& operator[](std::size_t i) const noexcept { return (*values_)[i]; }
    const T& back() const noexcept { return values_->back(); }

    auto begin() { return own().begin(); }
    auto end() { return own().end(); }
    T& operator[](std::size_t i) { return own()[i]; }
    void resize(std::size_t size) { own().resize(size); }
    void push_back(T value) { own().push_back(std::move(value)); }
    template <class... Arguments>
    auto insert(Arguments&&... arguments) {
        return own().insert(std::forward<Arguments>(arguments)...);
    }
    template <class... Arguments>
    void assign(Arguments&&... arguments) {
        own().assign(std::forward<Arguments>(arguments)...);
    }

private:
    std::shared_ptr<Vector> values_;
};

}  // namespace csgrt
