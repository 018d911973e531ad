#include "output/schedule.h"

#include <cmath>

namespace plash {

void Schedule::advance(const Clock& clock)
{
    const double reached = clock.time + clock.step;
    if (interval_ > 0) {
        next_ = interval_ * (std::floor(reached / interval_) + 1);
    } else {
        next_ = std::max(reached, clock.time + curve_(clock.time));
    }
}

bool asked_for(const OutputRequest& request)
{
    return request.interval > 0 || request.interval_curve != none || request.states > 0;
}

Schedule schedule_of(const OutputRequest& request, const Model& model)
{
    if (request.interval_curve != none) return Schedule(model.curves[request.interval_curve].curve);
    if (request.states > 0) return Schedule(model.controls.time.end_time / request.states);
    return Schedule(request.interval);
}

void ScheduledRecorder::write(const Snapshot& snapshot)
{
    if (snapshot.clock.cycle == last_cycle_) return;
    last_cycle_ = snapshot.clock.cycle;
    write_state(snapshot);
    schedule_.advance(snapshot.clock);
}

void ScheduledRecorder::serialise(Archive& archive)
{
    archive(schedule_, last_cycle_);
    serialise_files(archive);
}

} // namespace plash
