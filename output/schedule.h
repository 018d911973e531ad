#pragma once

#include "core/recorder.h"

namespace plash {

/// The times at which a result file is written: at the start, in the last cycle before each multiple of the
/// interval, and at the end.
class Schedule {
public:
    /// Every `interval` [time] (> 0).
    explicit Schedule(double interval) : interval_(interval) {}
    /// The interval as a function of time [time].
    explicit Schedule(Curve interval) : curve_(std::move(interval)) {}

    double next() const { return next_; }
    /// The state of this cycle has been written.
    void advance(const Clock&);
    void serialise(Archive& archive) { archive(next_); }

private:
    double interval_ = 0;
    Curve curve_;
    double next_ = 0;
};

/// Whether a request asks for anything: an interval, a curve of intervals or a number of states.
bool asked_for(const OutputRequest&);

/// The schedule that a request asks for. A number of states (NPLTC) goes before the interval, as in LS-DYNA.
Schedule schedule_of(const OutputRequest&, const Model&);

/// A recorder that writes on a schedule and writes no cycle twice.
class ScheduledRecorder : public Recorder {
public:
    explicit ScheduledRecorder(Schedule schedule) : schedule_(std::move(schedule)) {}

    double next_time() const final { return schedule_.next(); }
    void write(const Snapshot&) final;
    void serialise(Archive&) final;

protected:
    virtual void write_state(const Snapshot&) = 0;
    /// The recorder's files, and what else it carries from state to state (Recorder::serialise).
    virtual void serialise_files(Archive&) = 0;

private:
    Schedule schedule_;
    long last_cycle_ = -1;
};

} // namespace plash
