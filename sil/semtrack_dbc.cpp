// semtrack-dbc: writes the object list's DBC for a dialect and base id to stdout.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "sil/dbc/dbc_text.hpp"

int main(int argc, char** argv) {
    CLI::App app{"Writes the DBC of the semtrack object list to stdout", "semtrack-dbc"};
    std::string dialect = "fd";
    semtrack::CanConfig config;
    app.add_option("--can-dialect", dialect, "fd or classic")->check(CLI::IsMember({"fd", "classic"}));
    app.add_option("--base-id", config.base_id, "CAN id of the first message");
    app.add_flag("--extended", config.extended, "29-bit ids");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) {
            return app.exit(e);
        }
        (void)std::fprintf(stderr, "semtrack-dbc: %s\n", e.what());
        return 2;
    }
    config.dialect = dialect == "classic" ? semtrack::CanDialect::kClassic : semtrack::CanDialect::kFd;
    const std::uint32_t highest = config.extended ? 0x1FFFFFFFU : 0x7FFU;
    if (config.base_id > highest - 16U) {
        (void)std::fprintf(stderr, "semtrack-dbc: --base-id %u: ids would not fit in %d bits\n", config.base_id,
                           config.extended ? 29 : 11);
        return 2;
    }
    (void)std::fputs(semtrack::sil::dbc_text(config).c_str(), stdout);
    return 0;
}
