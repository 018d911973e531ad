#include "output/schedule.h"
#include "tests/support/snapshot_fixture.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// Times at which a schedule writes when the loop runs with a constant step and asks as the loop does.
std::vector<double> writes(Schedule schedule, double step, int cycles)
{
    std::vector<double> times;
    for (int cycle = 0; cycle < cycles; ++cycle) {
        const Clock clock{cycle * step, cycle > 0 ? step : 0, step, cycle};
        if (clock.time + clock.step > schedule.next()) {
            times.push_back(clock.time);
            schedule.advance(clock);
        }
    }
    return times;
}

class CountingRecorder final : public ScheduledRecorder {
public:
    CountingRecorder() : ScheduledRecorder(Schedule(1.0)) {}
    int states = 0;

private:
    void write_state(const Snapshot&) override { ++states; }
    void serialise_files(Archive&) override {}
};

} // namespace

// The cantilever of ../shared/decks (step 1.65463e-3, interval 0.1): LS-DYNA's glstat has the cycles 1, 61,
// 121, 182, 242, 303, counted from 1.
TEST(Schedule, WritesTheCyclesThatLsDynaWrites)
{
    const double step = 1.65463e-3;
    const std::vector<double> times = writes(Schedule(0.1), step, 310);
    ASSERT_EQ(times.size(), 6u);
    const int cycles[] = {0, 60, 120, 181, 241, 302};
    for (int i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(times[i], cycles[i] * step);
}

TEST(Schedule, WritesEveryCycleWhenTheIntervalIsShorterThanTheStep)
{
    EXPECT_EQ(writes(Schedule(0.01), 0.25, 8).size(), 8u);
}

TEST(Schedule, FollowsACurveOfIntervals)
{
    const std::vector<double> times = writes(Schedule(Curve{{0, 4, 4, 9}, {2, 2, 1, 1}}), 0.5, 16);
    const std::vector<double> expected = {0, 2, 4, 5, 6, 7};
    EXPECT_EQ(times, expected);
}

TEST(Schedule, TakesANumberOfStatesBeforeAnInterval)
{
    Model model;
    model.controls.time.end_time = 10;
    OutputRequest request;
    EXPECT_FALSE(asked_for(request));
    request.states = 5;
    EXPECT_TRUE(asked_for(request));
    request.interval = 0.1;
    const std::vector<double> expected = {0, 2, 4, 6, 8};
    EXPECT_EQ(writes(schedule_of(request, model), 0.5, 20), expected);
}

TEST(Schedule, WritesNoCycleTwice)
{
    testing::SnapshotFixture fixture;
    fixture.start();
    CountingRecorder recorder;
    fixture.clock = {0, 0, 0.5, 0};
    recorder.write(fixture.snapshot());
    recorder.write(fixture.snapshot());
    EXPECT_EQ(recorder.states, 1);
    fixture.clock = {0.5, 0.5, 0.5, 1};
    recorder.write(fixture.snapshot());
    EXPECT_EQ(recorder.states, 2);
    EXPECT_EQ(recorder.next_time(), 2);
}

} // namespace plash
