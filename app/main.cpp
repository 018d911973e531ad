#include "app/commands.h"

#include <cstdlib>
#include <string>
#include <unistd.h>
#include <vector>

namespace {

/// LS-DYNA's way of naming things, `i=deck.k ncpu=4`, as the arguments of `plash run`.
std::vector<std::string> from_ls_dyna_habits(const std::vector<std::string>& words)
{
    std::vector<std::string> translated;
    for (const std::string& word : words) {
        const auto sign = word.find('=');
        if (sign == std::string::npos) return words;
        const std::string name = word.substr(0, sign), value = word.substr(sign + 1);
        if (name == "i" || name == "I") {
            translated.insert(translated.begin(), {"run", value, "-o", "."});
        } else if (name == "ncpu" || name == "NCPU") {
            translated.insert(translated.end(), {"-j", value.substr(value.starts_with('-') ? 1 : 0)});
        } else if (name == "r" || name == "R") {
            translated.insert(translated.end(), {"--restart", value});
        } else if (name == "m" || name == "M") {
            translated.insert(translated.end(), {"--geometry", value});
        } else if (name != "memory" && name != "memory2" && name != "g" && name != "f") {
            return words;
        }
    }
    return translated.empty() ? words : translated;
}

/// Lets waiting threads sleep after some 50 microseconds instead of milliseconds: on a machine that is busy
/// with other work, spinning threads keep each other from finishing and a run becomes a hundred times slower.
/// The OpenMP runtime reads this when it is loaded, so the program starts itself anew, once.
void limit_spinning(char** arguments)
{
    if (getenv("GOMP_SPINCOUNT") || getenv("OMP_WAIT_POLICY")) return;
    setenv("GOMP_SPINCOUNT", "3000", 1);
    execv("/proc/self/exe", arguments); // comes back only where there is no /proc: then it runs as it is
}

} // namespace

int main(int argument_count, char** arguments)
{
    limit_spinning(arguments);
    CLI::App program{"Plash: explicit crash and splash from LS-DYNA-style keyword decks", "plash"};
    program.require_subcommand(1);
    program.set_version_flag("--version", PLASH_VERSION);
    int exit_code = 0;
    plash::add_run(program, exit_code);
    plash::add_check(program, exit_code);
    plash::add_compare(program, exit_code);
    plash::add_study(program, exit_code);
    plash::add_report(program, exit_code);
    plash::add_keywords(program, exit_code);
    plash::add_fill(program, exit_code);
    plash::add_picture(program, exit_code);

    std::vector<std::string> words(arguments + 1, arguments + argument_count);
    words = from_ls_dyna_habits(words);
    std::vector<std::string> reversed(words.rbegin(), words.rend()); // as CLI11 wants them
    try {
        program.parse(reversed);
    } catch (const CLI::ParseError& error) {
        return program.exit(error) == 0 ? 0 : 2;
    }
    return exit_code;
}
