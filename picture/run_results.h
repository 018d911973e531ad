#pragma once

#include "picture/surface.h"

#include <memory>
#include <string>
#include <vector>

namespace plash {

/// The states that a run left in its folder: its d3plot family, or its series for ParaView if there is no
/// d3plot.
class RunResults {
public:
    /// Throws std::runtime_error when the folder holds neither.
    explicit RunResults(const std::string& directory);
    ~RunResults();

    const std::vector<double>& times() const { return times_; }
    const std::string& title() const { return title_; }

    /// The outside of all parts at one of `times`, without what has eroded. A shell has the largest value of
    /// its layers.
    Surface surface(std::size_t state, Quantity quantity);

    /// Corners of each planar wall (walls.vtu), if there are any.
    std::vector<std::array<std::array<float, 3>, 4>> walls() const;

private:
    struct Source;
    struct D3plotSource;
    struct VtuSource;
    std::string directory_;
    std::unique_ptr<Source> source_;
    std::vector<double> times_;
    std::string title_;
};

} // namespace plash
