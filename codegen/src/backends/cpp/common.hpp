// Spans, maps of Eigen and the solver of inverse corrections: what the headers of C++ have in common.
#ifndef TRUEAXIS_COMMON_HPP
#define TRUEAXIS_COMMON_HPP

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#if !defined(TRUEAXIS_WITHOUT_EIGEN) && __has_include(<Eigen/Core>)
#define TRUEAXIS_HAS_EIGEN 1
#include <Eigen/Core>
#endif

namespace trueaxis {

// Numbers that lie one behind the other and belong to somebody else: a pointer and a count.
template <class T>
class Span {
public:
    constexpr Span() noexcept = default;
    constexpr Span(T* data, ::std::size_t size) noexcept : data_(data), size_(size) {}

    // Of what has data() and size(): std::vector, std::array, std::span, a vector of Eigen.
    template <class Of, class = ::std::enable_if_t<::std::is_convertible_v<decltype(::std::declval<Of&>().data()), T*>>>
    constexpr Span(Of&& of) : data_(of.data()), size_(static_cast<::std::size_t>(of.size())) {}

    [[nodiscard]] constexpr T* data() const noexcept { return data_; }
    [[nodiscard]] constexpr ::std::size_t size() const noexcept { return size_; }
    [[nodiscard]] constexpr T* begin() const noexcept { return data_; }
    [[nodiscard]] constexpr T* end() const noexcept { return data_ + size_; }
    [[nodiscard]] constexpr T& operator[](::std::size_t at) const noexcept { return data_[at]; }

private:
    T* data_ = nullptr;
    ::std::size_t size_ = 0;
};

#ifdef TRUEAXIS_HAS_EIGEN
// The components of an observable as a vector.
template <class T, int N>
[[nodiscard]] auto eigen(T (&components)[N]) {
    using Vector = ::Eigen::Matrix<::std::remove_const_t<T>, N, 1>;
    return ::Eigen::Map<::std::conditional_t<::std::is_const_v<T>, const Vector, Vector>>(components);
}

// The derivatives of an observable as a matrix: a row for each number that it shows, a column for each error.
template <class T, int N, int Columns>
[[nodiscard]] auto eigen(T (&derivatives)[N][Columns]) {
    constexpr int order = N != 1 && Columns == 1 ? ::Eigen::ColMajor : ::Eigen::RowMajor;
    using Matrix = ::Eigen::Matrix<::std::remove_const_t<T>, N, Columns, order>;
    return ::Eigen::Map<::std::conditional_t<::std::is_const_v<T>, const Matrix, Matrix>>(&derivatives[0][0]);
}

// A column of many poses as a vector.
template <class T>
[[nodiscard]] auto eigen(Span<T> column) {
    using Vector = ::Eigen::Matrix<::std::remove_const_t<T>, ::Eigen::Dynamic, 1>;
    using Map = ::Eigen::Map<::std::conditional_t<::std::is_const_v<T>, const Vector, Vector>>;
    return Map(column.data(), static_cast<::Eigen::Index>(column.size()));
}
#endif

namespace detail {

template <class T>
bool have_length(const Span<T>& column, ::std::size_t rows) noexcept {
    return column.size() == rows;
}

template <class T, ::std::size_t N>
bool have_length(const T (&columns)[N], ::std::size_t rows) noexcept {
    for (const auto& column : columns)
        if (!have_length(column, rows))
            return false;
    return true;
}

template <class T>
void point(const Span<T>& column, T*& to) noexcept {
    to = column.data();
}

template <class T, class To, ::std::size_t N>
void point(const T (&columns)[N], To (&to)[N]) noexcept {
    for (::std::size_t at = 0; at < N; at++)
        point(columns[at], to[at]);
}

// The shortest step with slopes * step = left: Cholesky's method on slopes * slopes^T, damped by rounding.
template <int M, int N>
void shortest(const double (&slopes)[M][N], const double (&left)[N], double (&step)[M]) {
    double a[N][N], y[N], trace = 0.0;
    for (int i = 0; i < N; i++) {
        y[i] = left[i];
        for (int k = 0; k < N; k++) {
            a[i][k] = 0.0;
            for (int m = 0; m < M; m++)
                a[i][k] += slopes[m][i] * slopes[m][k];
        }
        trace += a[i][i];
    }
    for (int i = 0; i < N; i++) {
        a[i][i] += 1e-12 * trace;
        for (int k = 0; k <= i; k++) {
            for (int l = 0; l < k; l++)
                a[i][k] -= a[i][l] * a[k][l];
            a[i][k] = i == k ? ::std::sqrt(a[i][i]) : a[i][k] / a[k][k];
        }
        for (int k = 0; k < i; k++)
            y[i] -= a[i][k] * y[k];
        y[i] /= a[i][i];
    }
    for (int i = N - 1; i >= 0; i--) {
        for (int k = i + 1; k < N; k++)
            y[i] -= a[k][i] * y[k];
        y[i] /= a[i][i];
    }
    for (int m = 0; m < M; m++) {
        step[m] = 0.0;
        for (int i = 0; i < N; i++)
            step[m] += slopes[m][i] * y[i];
    }
}

// What to add to `start` so that `show` comes to the target, by Newton's steps with central differences of 1e-5 rad or m.
// Returns the distance that remains.
template <class Joints, int M, int N, class Show>
double solve(double Joints::*const (&fields)[M], const Joints& start, const double (&target)[N], Joints& correction,
             const Show& show) {
    const auto distance = [&](const Joints& at, double (&left)[N]) {
        double square = 0.0;
        show(at, left);
        for (int i = 0; i < N; i++) {
            left[i] = target[i] - left[i];
            square += left[i] * left[i];
        }
        return ::std::sqrt(square);
    };
    Joints at = start;
    double left[N], before = distance(at, left);
    for (int round = 0; round < 20; round++) {
        double slopes[M][N], above[N], below[N], step[M];
        for (int m = 0; m < M; m++) {
            Joints moved = at;
            moved.*fields[m] = at.*fields[m] + 1e-5;
            show(moved, above);
            moved.*fields[m] = at.*fields[m] - 1e-5;
            show(moved, below);
            for (int i = 0; i < N; i++)
                slopes[m][i] = (above[i] - below[i]) / 2e-5;
        }
        shortest(slopes, left, step);
        Joints next = at;
        for (int m = 0; m < M; m++)
            next.*fields[m] += step[m];
        const double after = distance(next, left);
        if (!(after < before))
            break;
        before = after;
        at = next;
    }
    for (int m = 0; m < M; m++)
        correction.*fields[m] = at.*fields[m] - start.*fields[m];
    return before;
}

// What to add to the joints of a pose so that what is shown with the errors is what it is without them. Returns the
// distance that remains.
template <class Observed, int N, class Joints, int M, class Value, class Error, class... Inputs>
double inverse(double (Observed::*shown)[N], double Joints::*const (&fields)[M], const Value& value, const Error& error,
               Joints& correction, const Joints& joints, const Inputs&... inputs) {
    const Observed seen = value(joints, inputs...), added = error(joints, inputs...);
    double target[N];
    for (int at = 0; at < N; at++)
        target[at] = (seen.*shown)[at] - (added.*shown)[at];
    return solve(fields, joints, target, correction, [&](const Joints& moved, double (&out)[N]) {
        const Observed there = value(moved, inputs...);
        for (int at = 0; at < N; at++)
            out[at] = (there.*shown)[at];
    });
}

} // namespace detail
} // namespace trueaxis

#endif
