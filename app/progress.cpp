#include "app/progress.h"

#include <cstdio>
#include <fmt/format.h>
#include <limits>
#include <unistd.h>

namespace plash {

namespace {

/// "1 h 02 min", "3 min 20 s" or "12 s".
std::string duration(double seconds)
{
    const long whole = static_cast<long>(seconds + 0.5);
    if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
    if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} s", whole);
}

} // namespace

Progress::Progress(double end_time)
    : end_time_(end_time),
      terminal_(isatty(STDOUT_FILENO) != 0),
      next_(WallClock::now() + std::chrono::seconds(1))
{}

double Progress::next_time() const
{
    return -std::numeric_limits<double>::infinity();
}

void Progress::write(const Snapshot& snapshot)
{
    if (WallClock::now() < next_) return;
    next_ = WallClock::now() + std::chrono::seconds(terminal_ ? 1 : 10);
    if (terminal_ && shown_) fmt::print("\r\033[K");
    shown_ = true;
    show(snapshot);
    if (!terminal_) fmt::print("\n");
    std::fflush(stdout);
}

void Progress::write_relaxation(const Snapshot& snapshot, const RelaxationLook& look)
{
    if (!look.last && WallClock::now() < next_) return;
    next_ = WallClock::now() + std::chrono::seconds(terminal_ ? 1 : 10);
    if (terminal_ && shown_) fmt::print("\r\033[K");
    shown_ = !look.last;
    fmt::print("  dynamic relaxation: cycle {:>9}   t {:.5e}   kinetic energy {:.4e}, {:.2e} of its peak",
               snapshot.clock.cycle, snapshot.clock.time, look.energy, look.ratio);
    if (!terminal_ || look.last) fmt::print("{}\n", look.last ? "; ended" : "");
    std::fflush(stdout);
}

void Progress::finish(const Snapshot& snapshot)
{
    if (terminal_ && shown_) fmt::print("\r\033[K");
    show(snapshot);
    fmt::print("\n");
}

void Progress::show(const Snapshot& snapshot) const
{
    const Clock& clock = snapshot.clock;
    const StepVote& owner = snapshot.step_owner;
    fmt::print("  cycle {:>9}   t {:.5e} of {:.5e}   step {:.4e}", clock.cycle, clock.time, end_time_,
               clock.step);
    if (owner.element != 0) fmt::print(" ({} {})", owner.kind, owner.element);
    fmt::print("   energy error {:.2f} %", 100 * snapshot.ledger.balance_error());
    const double share = clock.time / end_time_;
    if (share > 0 && share < 1) fmt::print("   {} left", duration(snapshot.wall_seconds * (1 / share - 1)));
}

} // namespace plash
