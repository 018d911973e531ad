#pragma once

#include <stdexcept>

namespace plash {

/// The run cannot go on (negative volume, a number that is not one, a step that collapsed). The message names
/// element, part and place; the loop ends the run in order and keeps the results so far.
class RunError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace plash
