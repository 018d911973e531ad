#include "output/recorders.h"

#include "model/tracers.h"
#include "output/abstat.h"
#include "output/ale_files.h"
#include "output/beam_files.h"
#include "output/binout.h"
#include "output/bndout.h"
#include "output/contact_files.h"
#include "output/d3plot.h"
#include "output/d3thdt.h"
#include "output/dbfsi.h"
#include "output/deforc.h"
#include "output/disbout.h"
#include "output/elout.h"
#include "output/glstat.h"
#include "output/history_file.h"
#include "output/interface_series.h"
#include "output/jntforc.h"
#include "output/lsda_file.h"
#include "output/matsum.h"
#include "output/nodfor.h"
#include "output/nodout.h"
#include "output/rbdout.h"
#include "output/relax_file.h"
#include "output/rwforc.h"
#include "output/secforc.h"
#include "output/spcforc.h"
#include "output/sphout.h"
#include "output/trhist.h"
#include "output/vtk_series.h"

#include <algorithm>
#include <functional>

namespace plash {

namespace {

/// One ASCII result file: its LS-DYNA name, whether the model has anything to show in it, how it is made.
struct AsciiFile {
    std::string name;
    std::function<bool(const Model&)> wanted;
    std::function<std::unique_ptr<Recorder>(const Model&, Schedule, const ResultPath& path)> make;
};

template <class T>
std::unique_ptr<Recorder> make(const Model& model, Schedule schedule, const ResultPath& path)
{
    return std::make_unique<T>(model, std::move(schedule), path);
}

bool always(const Model&)
{
    return true;
}

bool has_history_nodes(const Model& model)
{
    return !model.controls.output.history_nodes.empty();
}

bool has_history_elements(const Model& model)
{
    const OutputControls& output = model.controls.output;
    return !output.history_shells.empty() || !output.history_solids.empty() ||
           !output.history_beams.empty() || !output.history_thick_shells.empty();
}

bool has_spot_welds(const Model& model)
{
    return !spot_weld_beams(model).empty();
}

bool has_walls(const Model& model)
{
    return !model.rigid_walls.empty();
}

bool has_supports(const Model& model)
{
    return !model.fixed_nodes.empty();
}

bool has_loads(const Model& model)
{
    return !model.nodal_loads.empty() || !model.rigid_body_loads.empty() || !model.prescribed_motions.empty();
}

bool has_rigid_bodies(const Model& model)
{
    for (Index part = 0; part < static_cast<Index>(model.parts.size()); ++part)
        if (model.is_rigid(part)) return true;
    return !model.nodal_rigid_bodies.empty();
}

bool has_joints(const Model& model)
{
    return !model.joints.empty();
}

bool has_history_particles(const Model& model)
{
    return !model.controls.output.history_particles.empty();
}

bool has_tracers(const Model& model)
{
    return tracer_count(model) > 0;
}

bool has_airbags(const Model& model)
{
    return !model.airbags.empty();
}

bool has_springs(const Model& model)
{
    return !shown_springs(model).empty();
}

bool has_discrete_beams(const Model& model)
{
    return !shown_discrete_beams(model).empty();
}

bool has_nodal_force_groups(const Model& model)
{
    return !model.nodal_force_groups.empty();
}

bool has_sections(const Model& model)
{
    return !model.cross_sections.empty();
}

bool has_contacts(const Model& model)
{
    // Couplings that stand for contacts report as these did.
    return !model.contacts.empty() ||
           std::any_of(model.others.begin(), model.others.end(), [](const Record& record) {
               return record.keyword == "CONSTRAINED_LAGRANGE_IN_SOLID" && record.peek("CONTACT");
           });
}

/// A new ASCII file gets its line here.
const std::vector<AsciiFile>& ascii_files()
{
    static const std::vector<AsciiFile> files = {
        {"glstat", always, make<GlstatRecorder>},
        {"matsum", always, make<MatsumRecorder>},
        {"nodout", has_history_nodes, make<NodoutRecorder>},
        {"elout", has_history_elements, make<EloutRecorder>},
        {"swforc", has_spot_welds, make<SwforcRecorder>},
        {"rwforc", has_walls, make<RwforcRecorder>},
        {"spcforc", has_supports, make<SpcforcRecorder>},
        {"sphout", has_history_particles, make<SphoutRecorder>},
        {"trhist", has_tracers, make<TrhistRecorder>},
        {"abstat", has_airbags, make<AbstatRecorder>},
        {"bndout", has_loads, make<BndoutRecorder>},
        {"rbdout", has_rigid_bodies, make<RbdoutRecorder>},
        {"jntforc", has_joints, make<JntforcRecorder>},
        {"secforc", has_sections, make<SecforcRecorder>},
        {"deforc", has_springs, make<DeforcRecorder>},
        {"disbout", has_discrete_beams, make<DisboutRecorder>},
        {"nodfor", has_nodal_force_groups, make<NodforRecorder>},
        {"rcforc", has_contacts, make<RcforcRecorder>},
        {"sleout", has_contacts, make<SleoutRecorder>},
        {"ncforc", has_contacts, make<NcforcRecorder>},
    };
    return files;
}

} // namespace

std::vector<std::unique_ptr<Recorder>> make_recorders(const Model& model, const std::string& directory,
                                                      const RecorderOptions& options)
{
    std::vector<std::unique_ptr<Recorder>> recorders;
    const auto path_of = [&](const std::string& name) {
        return ResultPath(directory + name, options.resume);
    };
    std::unique_ptr<BinoutRecorder> binout;
    const auto open_binout = [&]() -> BinoutRecorder& {
        if (!binout)
            binout = std::make_unique<BinoutRecorder>(std::make_unique<LsdaFile>(path_of("/binout0000")));
        return *binout;
    };
    auto history = std::make_unique<BinoutRecorder>(std::make_unique<HistoryFile>(path_of("/history.h5")));
    for (const AsciiFile& file : ascii_files()) {
        const auto request = model.controls.output.ascii.find(file.name);
        if (request == model.controls.output.ascii.end()) continue;
        if (!asked_for(request->second) || !file.wanted(model)) continue;
        const int binary = request->second.binary;
        const Schedule schedule = schedule_of(request->second, model);
        const std::string folder = binout_folder(file.name);
        auto section = make_binout_section(file.name, model);
        if (section) history->add(folder, schedule, std::move(section), model);
        if (binary >= 2) section = make_binout_section(file.name, model);
        if (section) {
            open_binout().add(folder, schedule, std::move(section), model);
            if (binary == 2) continue;
        }
        recorders.push_back(file.make(model, schedule, path_of("/" + file.name)));
    }
    if (has_fluid_surfaces(model)) {
        const Schedule schedule = fluid_surface_schedule(model);
        const int form = fluid_surface_form(model);
        history->add("dbfsi", schedule, make_dbfsi_section(model), model);
        if (form >= 2) open_binout().add("dbfsi", schedule, make_dbfsi_section(model), model);
        if (form != 2)
            recorders.push_back(std::make_unique<DbfsiRecorder>(model, schedule, path_of("/dbfsi")));
    }
    BinoutRecorder* const arrays[] = {history.get(), binout.get()};
    for (auto& recorder : make_ale_recorders(model, directory, options.resume, arrays))
        recorders.push_back(std::move(recorder));
    if (binout) recorders.push_back(std::move(binout));
    if (!history->empty()) recorders.push_back(std::move(history));
    const OutputRequest& d3plot = model.controls.output.d3plot;
    if (asked_for(d3plot)) {
        recorders.push_back(
            std::make_unique<D3plotRecorder>(model, schedule_of(d3plot, model), path_of("/d3plot")));
    }
    const auto d3thdt = model.controls.output.ascii.find("d3thdt");
    if (d3thdt != model.controls.output.ascii.end() && asked_for(d3thdt->second)) {
        recorders.push_back(
            std::make_unique<D3thdtRecorder>(model, schedule_of(d3thdt->second, model), path_of("/d3thdt")));
    }
    const auto intfor = model.controls.output.ascii.find("intfor");
    if (intfor != model.controls.output.ascii.end() && asked_for(intfor->second) && !model.contacts.empty()) {
        recorders.push_back(
            std::make_unique<InterfaceSeries>(model, schedule_of(intfor->second, model), path_of("")));
    }
    if (model.controls.relaxation.active()) {
        recorders.push_back(std::make_unique<RelaxRecorder>(model, path_of("/relax")));
        if (const long looks = model.controls.output.relaxation_states; looks > 0)
            recorders.push_back(std::make_unique<D3drlfRecorder>(model, looks, path_of("/d3drlf")));
    }
    if (options.vtk) {
        const Schedule schedule =
            asked_for(d3plot) ? schedule_of(d3plot, model) : Schedule(model.controls.time.end_time / 20);
        recorders.push_back(std::make_unique<VtkSeries>(model, schedule, path_of("")));
    }
    write_walls(model, directory);
    return recorders;
}

std::vector<std::string> ascii_file_names()
{
    std::vector<std::string> names;
    for (const AsciiFile& file : ascii_files()) names.push_back(file.name);
    return names;
}

} // namespace plash
