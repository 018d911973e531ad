#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <span>
#include <string>

namespace plash {

/// One state of rcforc as LS-DYNA R13 prints it: resultants of both sides of each contact.
std::string format_rcforc(double time, std::span<const ElementResults::ContactForce>);

/// One state of sleout: what contacts have taken out of the motion of slave and master sides.
std::string format_sleout(double time, long cycle, std::span<const ElementResults::ContactForce>);

/// Force of all contacts on one node.
struct NodeContactForce {
    Id node = 0;
    Vec3 force{};    ///< [force]
    Vec3 position{}; ///< [length]
};

/// One state of ncforc: the nodes that a contact pushes, with forces and places.
std::string format_ncforc(double time, std::span<const NodeContactForce>);

/// *DATABASE_RCFORC.
class RcforcRecorder final : public ScheduledRecorder {
public:
    RcforcRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

/// *DATABASE_SLEOUT.
class SleoutRecorder final : public ScheduledRecorder {
public:
    SleoutRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

/// *DATABASE_NCFORC.
class NcforcRecorder final : public ScheduledRecorder {
public:
    NcforcRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash
