#include "solver/sense_switches.h"

#include <cctype>
#include <filesystem>
#include <fstream>

namespace plash {

SenseSwitch sense_switch_of(std::string word)
{
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    while (!word.empty() && word.back() == '.') word.pop_back();
    if (word == "sw1") return SenseSwitch::end_with_restart_file;
    if (word == "sw2") return SenseSwitch::tell_time;
    if (word == "sw3") return SenseSwitch::restart_file;
    if (word == "sw4") return SenseSwitch::plot_state;
    if (word == "stop") return SenseSwitch::end_with_plot_state;
    return SenseSwitch::none;
}

SenseSwitches::SenseSwitches(std::string directory, const std::atomic<bool>* stop_requested)
    : directory_(std::move(directory)), stop_requested_(stop_requested)
{}

SenseSwitch SenseSwitches::poll()
{
    if (stop_requested_ && stop_requested_->load()) return SenseSwitch::end_with_restart_file;
    if (directory_.empty()) return SenseSwitch::none;
    const auto now = WallClock::now();
    if (now < next_look_) return SenseSwitch::none;
    next_look_ = now + std::chrono::milliseconds(200);
    for (const char* name : {"D3KIL", "d3kil"}) {
        for (const std::string& path : {directory_ + "/" + name, std::string(name)}) {
            std::ifstream file(path);
            std::string word;
            if (!(file >> word)) continue; // not there, or not yet written
            file.close();
            std::error_code ignored;
            std::filesystem::remove(path, ignored);
            return sense_switch_of(word);
        }
    }
    return SenseSwitch::none;
}

} // namespace plash
