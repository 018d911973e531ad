#pragma once

#include "output/array_file.h"
#include "output/elout.h"
#include "output/result_file.h"
#include "output/schedule.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace plash {

/// What one kind of result writes into binout, under the names that LS-DYNA gives it.
class BinoutSection {
public:
    virtual ~BinoutSection() = default;
    /// What does not change: numbers and titles, into /NAME/metadata.
    virtual void write_metadata(ArrayFile&) const {}
    /// Whether the section writes into folders below its own instead.
    virtual bool has_folders() const { return false; }
    virtual void write_state(const Snapshot&, ArrayFile&, const std::string& folder) = 0;
    virtual void follow(const Clock&, const State&) {}
    virtual void serialise(Archive&) {}
};

/// Contents of the ASCII files in one file of arrays: binout0000 for requests with BINARY = 2 or 3,
/// history.h5 for all of them. Each section has the schedule of its request; states are numbered by section
/// from d000001.
class BinoutRecorder final : public Recorder {
public:
    explicit BinoutRecorder(std::unique_ptr<ArrayFile> file) : file_(std::move(file)) {}

    /// name  of the folder: "nodout", "elout/shell"
    void add(std::string name, Schedule schedule, std::unique_ptr<BinoutSection> section, const Model& model);
    bool empty() const { return sections_.empty(); }

    double next_time() const override;
    void write(const Snapshot&) override;
    void follow(const Clock&, const State&) override;
    void serialise(Archive&) override;
    void finish(const Snapshot&) override { file_->close(); }

private:
    struct Part {
        std::string name;
        Schedule schedule;
        std::unique_ptr<BinoutSection> section;
        long states = 0;
        long last_cycle = -1;

        void serialise(Archive& archive)
        {
            archive(schedule, states, last_cycle);
            section->serialise(archive);
        }
    };
    std::unique_ptr<ArrayFile> file_;
    std::vector<Part> sections_;
};

/// The section of an ASCII file's contents; null for a file that binout does not hold.
std::unique_ptr<BinoutSection> make_binout_section(const std::string& file_name, const Model& model);

/// Folder of a file's contents in binout.
std::string binout_folder(const std::string& file_name);

} // namespace plash
