#include "engine/primitive/exact.h"

#include <array>
#include <cassert>
#include <cmath>

namespace firstray::inline v0 {
namespace {

/// The rounded sum, and what rounding took away.
struct Two {
    double sum, rest;
};

Two two_sum(double a, double b)
{
    const double sum = a + b;
    const double b_part = sum - a;
    return {sum, (a - (sum - b_part)) + (b - b_part)};
}

Two two_product(double a, double b)
{
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

/// The sum and the product to some hundred bits, of the summands' and the product's size.
Two about_sum(const Two& a, const Two& b)
{
    const Two sums = two_sum(a.sum, b.sum);
    return two_sum(sums.sum, sums.rest + (a.rest + b.rest));
}

Two about_product(const Two& a, const Two& b)
{
    const Two product = two_product(a.sum, b.sum);
    return two_sum(product.sum, product.rest + (a.sum * b.rest + a.rest * b.sum));
}

/// The sign of det(p, q, direction) where a hundred bits tell it, else 0.
int sign_to_hundred_bits(const Two (&p)[3], const Two (&q)[3], const glm::dvec3& direction)
{
    Two det{0.0, 0.0};
    double size = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        const Two plus = about_product(p[next], q[last]), minus = about_product(p[last], q[next]);
        const Two factor = about_sum(plus, {-minus.sum, -minus.rest});
        det = about_sum(det, about_product(factor, {direction[axis], 0.0}));
        size += (std::abs(plus.sum) + std::abs(minus.sum)) * std::abs(direction[axis]);
    }
    // Seven steps err by less than 2^-100 of the size each. Where the size is tiny, rests have left double's range.
    const double error = 0x1p-90 * size;
    if (!(size > 0x1p-800)) return 0;
    return det.sum > error ? 1 : det.sum < -error ? -1 : 0;
}

/// A number as an unevaluated sum of doubles that do not overlap, smallest first.
class Expansion {
public:
    void add(double value)
    {
        if (value == 0.0) return;
        int kept = 0;
        for (int i = 0; i < count_; ++i) {
            const Two step = two_sum(value, terms_[static_cast<std::size_t>(i)]);
            if (step.rest != 0.0) terms_[static_cast<std::size_t>(kept++)] = step.rest;
            value = step.sum;
        }
        if (value != 0.0) {
            assert(kept < static_cast<int>(terms_.size()));
            terms_[static_cast<std::size_t>(kept++)] = value;
        }
        count_ = kept;
    }
    /// Adds a * b * c exactly, for a and b given as unevaluated sums.
    void add_product(const Two& a, const Two& b, double c)
    {
        for (const double x : {a.sum, a.rest})
            for (const double y : {b.sum, b.rest}) {
                const Two xy = two_product(x, y);
                for (const double part : {xy.sum, xy.rest}) {
                    const Two product = two_product(part, c);
                    add(product.rest);
                    add(product.sum);
                }
            }
    }
    int sign() const
    {
        if (count_ == 0) return 0;
        return terms_[static_cast<std::size_t>(count_ - 1)] > 0.0 ? 1 : -1;  // the largest outweighs all others
    }

private:
    std::array<double, 128> terms_{};  // six products of 16 terms each are 96
    int count_ = 0;
};

}  // namespace

int exact_side(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& origin, const glm::dvec3& direction)
{
    if (a == b) return 0;  // as in every triangle that has shrunk to a point
    Two p[3], q[3];
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = two_sum(a[axis], -origin[axis]);
        q[axis] = two_sum(b[axis], -a[axis]);  // for b - origin: the same determinant, of smaller products
    }
    if (const int sign = sign_to_hundred_bits(p, q, direction); sign != 0) return sign;
    Expansion det;
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        det.add_product(p[next], q[last], direction[axis]);
        det.add_product(p[last], q[next], -direction[axis]);
    }
    return det.sign();
}

}  // namespace firstray::inline v0
