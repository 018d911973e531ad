// Pressure on a flat wedge that enters water at constant speed, on cells that are flatter than they are wide
// where the root of the spray runs; beside the similarity solution. Usage: plash_flat_wedge [cut] [cells=40]
// [flat=8] [low=0] [high=0.13] [growth=0.15] [shells=2] [sound=300]
//
// The words are those of FlatWedge; `cut`: cut cells in place of springs.

#include "tests/support/flat_wedge.h"

#include <cstdio>
#include <map>
#include <omp.h>

using namespace plash::testing;

namespace {

void show(const char* name, const FlatWedgeProfile& profile)
{
    const auto [pressure, place] = profile.largest();
    const auto [at_root, root] = profile.largest(1.4);
    std::printf("largest pressure, intervals of %s: %.4f at %.3f; near the root %.4f at %.3f\n", name,
                pressure, place, at_root, root);
}

} // namespace

int main(int argc, char** argv)
{
    omp_set_num_threads(1);
    FlatWedge wedge;
    const std::map<std::string, double*> options{
        {"cells", &wedge.cells},   {"flat", &wedge.flat},     {"low", &wedge.low},    {"high", &wedge.high},
        {"growth", &wedge.growth}, {"shells", &wedge.shells}, {"sound", &wedge.sound}};
    for (int n = 1; n < argc; ++n) {
        const std::string word = argv[n];
        const auto equals = word.find('=');
        if (word == "cut") {
            wedge.by_cut_cells = true;
        } else if (equals != word.npos && options.contains(word.substr(0, equals))) {
            *options.at(word.substr(0, equals)) = std::stod(word.substr(equals + 1));
        } else {
            std::fprintf(stderr, "what is '%s'?\n", argv[n]);
            return 1;
        }
    }
    const FlatWedgeEntry entry = enter_flat_wedge(wedge);
    std::printf("force over the similarity solution's: %.4f\n", entry.force);
    show("a cell", entry.cells);
    show("half a cell", entry.halves);
    show("a quarter of a cell", entry.quarters);
}
