// semtrack-dbc: writes the object list's DBC for a dialect and base id to stdout.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "sil/can_ids.hpp"
#include "sil/dbc/dbc_text.hpp"

int main(int argc, char** argv) {
    CLI::App app{"Writes the DBC of the semtrack object list to stdout", "semtrack-dbc"};
    std::string dialect = "fd";
    semtrack::CanConfig config;
    app.add_option("--can-dialect", dialect, "fd or classic")->check(CLI::IsMember({"fd", "classic"}));
    semtrack::sil::add_can_id_options(app, config);
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
    const std::string complaint = semtrack::sil::complaint_about_ids(config);
    if (!complaint.empty()) {
        (void)std::fprintf(stderr, "semtrack-dbc: %s\n", complaint.c_str());
        return 2;
    }
    (void)std::fputs(semtrack::sil::dbc_text(config).c_str(), stdout);
    return 0;
}
