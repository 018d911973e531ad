#include "output/relax_file.h"

#include "output/ascii_text.h"

#include <fmt/format.h>

namespace plash {

RelaxRecorder::RelaxRecorder(const Model& model, const ResultPath& path)
    : statics_(model.controls.relaxation.flag == 5), file_(path)
{
    const char* columns = statics_
                              ? "    forces   largest acceleration\n"
                              : "     cycle          time   kinetic energy           peak          ratio\n";
    file_.write(ascii_heading(model) + "\n\n" + columns);
    file_.flush();
}

void RelaxRecorder::write_relaxation(const Snapshot& snapshot, const RelaxationLook& look)
{
    if (statics_) {
        std::string line = fmt::format("{:10}", snapshot.clock.cycle);
        append_scientific(line, look.ratio, 23, 6);
        file_.write(line + '\n');
        file_.flush();
        return;
    }
    std::string line = fmt::format("{:10}", snapshot.clock.cycle);
    append_scientific(line, snapshot.clock.time, 14, 5);
    append_scientific(line, look.energy, 17, 6);
    append_scientific(line, look.peak, 15, 6);
    append_scientific(line, look.ratio, 15, 6);
    file_.write(line + '\n');
    file_.flush();
}

D3drlfRecorder::D3drlfRecorder(const Model& model, long looks, const ResultPath& path)
    : states_(model, Schedule(forever), path), looks_(looks)
{}

void D3drlfRecorder::write_relaxation(const Snapshot& snapshot, const RelaxationLook& look)
{
    if (++seen_ % looks_ == 0 || look.last) states_.write_on_request(snapshot);
}

} // namespace plash
