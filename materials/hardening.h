#pragma once

#include "math/curve.h"
#include "math/lanes_math.h"

#include <vector>

namespace plash {

/// Yield stress over plastic strain, and over strain rate where a table gives one curve for each rate.
/// Made for many look-ups at once: a curve of few points is a sum over its kinks; others are cut into equal
/// bins, and a bin holds a line with at most one kink, which is exact for any curve whose points are not
/// closer than the finest bin.
class Hardening {
public:
    Hardening() = default;
    /// yield_stress + modulus x plastic strain. [stress]
    static Hardening linear(double yield_stress, double modulus);
    /// Stress over plastic strain; before the first point constant, beyond the last with the last slope.
    static Hardening curve(const Curve& stress_of_strain);
    /// One curve for each strain rate, rising; constant below the first and above the last rate, linear in
    /// the rate between them. With `logarithmic`, `rates` are natural logarithms of rates and the
    /// interpolation is linear in the logarithm.
    static Hardening table(const std::vector<double>& rates, const std::vector<const Curve*>& curves,
                           bool logarithmic);

    bool depends_on_rate() const { return rates_.size() > 1; }

    /// Yield stress and its derivatives.
    template <class Lane>
    struct Value {
        Lane stress{};  ///< [stress]
        Lane slope{};   ///< by plastic strain [stress]
        Lane by_rate{}; ///< by strain rate [stress time]
    };

    /// At plastic strains and strain rates (rates are looked at only where there is a table).
    template <class Lane>
    Value<Lane> operator()(Lane plastic_strain, Lane rate) const
    {
        if (bins_.empty()) return along_kinks(plastic_strain);
        using Integer = IntegerLane<Lane>;
        const Integer bin = bin_of(plastic_strain);
        if (!depends_on_rate()) return in_bin(bin, plastic_strain);

        const Lane where = logarithmic_ ? log(max(rate, broadcast<Lane>(1e-300))) : rate;
        Integer segment = bin * 0;
        Lane left = broadcast<Lane>(rates_[0]), width = broadcast<Lane>(rates_[1] - rates_[0]);
        for (std::size_t i = 1; i + 1 < rates_.size(); ++i) {
            const auto beyond = where >= rates_[i];
            segment = beyond ? segment * 0 + static_cast<std::int64_t>(i) : segment;
            left = beyond ? broadcast<Lane>(rates_[i]) : left;
            width = beyond ? broadcast<Lane>(rates_[i + 1] - rates_[i]) : width;
        }
        const Integer start = segment * bin_count_ + bin;
        const Value<Lane> low = in_bin(start, plastic_strain);
        const Value<Lane> high = in_bin(start + bin_count_, plastic_strain);
        const Lane one = broadcast<Lane>(1.0);
        const Lane free_share = (where - left) / width;
        const Lane share = min(max(free_share, Lane{}), one);
        Lane by_rate = (high.stress - low.stress) / width;
        if (logarithmic_) by_rate /= max(rate, broadcast<Lane>(1e-300));
        return {low.stress + share * (high.stress - low.stress), low.slope + share * (high.slope - low.slope),
                share == free_share ? by_rate : Lane{}};
    }

    /// Smallest yield stress at any rate [stress].
    template <class Lane>
    Lane lowest(Lane plastic_strain) const
    {
        if (!depends_on_rate()) return (*this)(plastic_strain, Lane{}).stress;
        Lane result = broadcast<Lane>(1e300);
        IntegerLane<Lane> bin = bin_of(plastic_strain);
        for (std::size_t i = 0; i < rates_.size(); ++i, bin += bin_count_) {
            result = min(result, in_bin(bin, plastic_strain).stress);
        }
        return result;
    }

private:
    /// y = intercept + slope x + change max(0, x - kink)
    struct Bin {
        double intercept, slope, kink, change;
    };

    /// A change of slope.
    struct Kink {
        double place, change;
    };

    /// Without bins: a line with a few kinks, quicker than looking anything up.
    double initial_ = 0, modulus_ = 0;
    std::vector<Kink> kinks_;

    std::vector<Bin> bins_;      ///< curve after curve
    std::int64_t bin_count_ = 0; ///< of one curve
    double bins_per_strain_ = 0;
    std::vector<double> rates_;
    bool logarithmic_ = false;

    void cut(const std::vector<const Curve*>& curves);

    template <class Lane>
    Value<Lane> along_kinks(const Lane& strain) const
    {
        Lane stress = initial_ + modulus_ * strain, slope = broadcast<Lane>(modulus_);
        for (const Kink& kink : kinks_) {
            const Lane beyond = max(strain - kink.place, Lane{});
            stress += kink.change * beyond;
            slope += beyond > 0.0 ? broadcast<Lane>(kink.change) : Lane{};
        }
        return {stress, slope, Lane{}};
    }

    template <class Lane>
    IntegerLane<Lane> bin_of(Lane strain) const
    {
        // Written so that a strain that is no number falls into the first bin.
        const Lane place = max(strain * bins_per_strain_ - 0.5, Lane{});
        return nearest_integer<Lane>(min(place, broadcast<Lane>(static_cast<double>(bin_count_ - 1))));
    }

    template <class Lane>
    Value<Lane> in_bin(const IntegerLane<Lane>& bin, const Lane& strain) const
    {
        const double* table = &bins_.front().intercept;
        const IntegerLane<Lane> position = bin * 4;
        const Lane slope = gather(table + 1, position), change = gather(table + 3, position);
        const Lane beyond = max(strain - gather(table + 2, position), Lane{});
        return {gather(table, position) + slope * strain + change * beyond,
                slope + (beyond > 0.0 ? change : Lane{}), Lane{}};
    }
};

} // namespace plash
