#include "assess/run_cost.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace plash {

std::optional<RunCost> run_cost(const std::string& directory)
{
    std::ifstream file(std::filesystem::path(directory) / "summary.json");
    if (!file) return {};
    const nlohmann::json summary = nlohmann::json::parse(file, nullptr, false);
    if (summary.is_discarded()) return {};
    try {
        RunCost cost;
        const auto number = [](const nlohmann::json& value) {
            return value.is_number() ? value.get<double>() : std::nan("");
        };
        cost.deck = summary.at("deck").get<std::string>();
        cost.termination = summary.at("termination").get<std::string>();
        cost.cpu_seconds = number(summary.at("cpu_seconds"));
        cost.wall_seconds = number(summary.at("wall_seconds"));
        cost.memory = number(summary.at("peak_memory_bytes"));
        cost.balance_error = number(summary.at("energy").at("balance_error_max"));
        cost.cycles = summary.at("cycles").get<long>();
        for (const auto& term : summary.at("terms")) cost.item_steps += number(term.at("item_steps"));
        return cost;
    } catch (const nlohmann::json::exception&) {
        return {};
    }
}

std::vector<bool> pareto_front(const std::vector<double>& error, const std::vector<double>& cost)
{
    std::vector<bool> front(error.size());
    for (std::size_t i = 0; i < error.size(); ++i) {
        front[i] = std::isfinite(error[i]) && std::isfinite(cost[i]);
        for (std::size_t j = 0; j < error.size() && front[i]; ++j) {
            const bool beats =
                error[j] <= error[i] && cost[j] <= cost[i] && (error[j] < error[i] || cost[j] < cost[i]);
            if (beats) front[i] = false;
        }
    }
    return front;
}

} // namespace plash
