#pragma once

#include <CLI/CLI.hpp>

/// One function a subcommand: adds it with its options to the program. What a subcommand does ends in an exit
/// code: 0 fine, 1 the deck is wrong or unsupported, 2 usage, 3 the run ended early.
namespace plash {

void add_run(CLI::App& program, int& exit_code);
void add_compare(CLI::App& program, int& exit_code);
void add_study(CLI::App& program, int& exit_code);
void add_check(CLI::App& program, int& exit_code);
void add_report(CLI::App& program, int& exit_code);
void add_keywords(CLI::App& program, int& exit_code);
void add_fill(CLI::App& program, int& exit_code);
void add_picture(CLI::App& program, int& exit_code);

} // namespace plash
