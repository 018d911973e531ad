#pragma once

#include "output/d3plot.h"
#include "output/result_file.h"

namespace plash {

/// The file relax: how dynamic relaxation converges. One line for each look: cycle, time of the phase,
/// kinetic energy of the distortion, its peak so far and their ratio. Of a static start (IDRFLG = 5) one for
/// each better place: sums of forces so far, largest acceleration over that of the frame.
class RelaxRecorder final : public Recorder {
public:
    RelaxRecorder(const Model&, const ResultPath& path);

    double next_time() const override { return forever; }
    void write(const Snapshot&) override {}
    void write_relaxation(const Snapshot&, const RelaxationLook&) override;
    void serialise(Archive& archive) override { archive(file_); }

private:
    bool statics_;
    ResultFile file_;
};

/// *DATABASE_BINARY_D3DRLF: states of dynamic relaxation in the layout of d3plot, every so many looks, and
/// the last one.
class D3drlfRecorder final : public Recorder {
public:
    /// looks  between two states
    D3drlfRecorder(const Model&, long looks, const ResultPath& path);

    double next_time() const override { return forever; }
    void write(const Snapshot&) override {}
    void write_relaxation(const Snapshot&, const RelaxationLook&) override;
    void serialise(Archive& archive) override { states_.serialise(archive); }

private:
    D3plotRecorder states_;
    long looks_, seen_ = 0;
};

} // namespace plash
