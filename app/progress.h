#pragma once

#include "core/recorder.h"

#include <chrono>

namespace plash {

/// One line a second on the terminal: cycle, time, step with its owner, energy balance, estimated end. On a
/// terminal the line is rewritten in place; in a file every 10 seconds make a line.
class Progress : public Recorder {
public:
    explicit Progress(double end_time);

    double next_time() const override;
    void write(const Snapshot& snapshot) override;
    void write_relaxation(const Snapshot& snapshot, const RelaxationLook& look) override;
    void finish(const Snapshot& snapshot) override;

private:
    using WallClock = std::chrono::steady_clock;
    double end_time_;
    bool terminal_;
    WallClock::time_point next_;
    bool shown_ = false;

    void show(const Snapshot& snapshot) const;
};

} // namespace plash
