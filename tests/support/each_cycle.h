#pragma once

#include "core/recorder.h"

#include <functional>
#include <utility>

namespace plash {

/// Calls a function after every cycle.
class EachCycle : public Recorder {
public:
    using Function = std::function<void(const Clock&, const State&)>;
    explicit EachCycle(Function function) : function_(std::move(function)) {}
    double next_time() const override { return forever; }
    void write(const Snapshot&) override {}
    void follow(const Clock& clock, const State& state) override { function_(clock, state); }

private:
    Function function_;
};

} // namespace plash
