// The command line's CAN ids, of semtrack-dbc and of replay: what one writes, the other publishes.
#ifndef SEMTRACK_SIL_CAN_IDS_HPP
#define SEMTRACK_SIL_CAN_IDS_HPP

#include <CLI/CLI.hpp>
#include <string>

#include "semtrack/can_encoder.hpp"

namespace semtrack::sil {

inline void add_can_id_options(CLI::App& app, CanConfig& config) {
    app.add_option("--base-id", config.base_id, "CAN id of the first message");
    app.add_flag("--extended", config.extended, "29-bit ids");
}

/// Empty, or why not: sixteen ids from the base on have to fit.
inline std::string complaint_about_ids(const CanConfig& config) {
    const std::uint32_t highest = config.extended ? 0x1FFFFFFFU : 0x7FFU;
    if (config.base_id <= highest - 16U) {
        return {};
    }
    return "--base-id " + std::to_string(config.base_id) + ": ids would not fit in " +
           (config.extended ? "29" : "11") + " bits";
}

}  // namespace semtrack::sil

#endif
