#include "sil/report/list_table.hpp"

#include "publish/object_list.hpp"
#include "sil/metrics/number_text.hpp"

namespace semtrack::sil {

namespace {

std::string row(int frame, std::int64_t time_us, const std::string& object, const SignalValues& values) {
    std::string out = std::to_string(frame) + "," + std::to_string(time_us) + "," + object;
    for (int i = 0; i < kListSignals; ++i) {
        const SignalValue& v = values[static_cast<std::size_t>(i)];
        out += v.available ? "," + number_text(v.value) : ",";
    }
    return out + "\n";
}

}  // namespace

std::string list_header() {
    std::string out = "frame,time_us,object";
    for (int i = 0; i < kListSignals; ++i) {
        out += std::string(",") + signal_spec(static_cast<SignalId>(i)).name;
    }
    return out + "\n";
}

std::string list_rows(int frame, const Output& output, CanDialect dialect, std::uint8_t list_counter) {
    const std::int64_t time_us = output.ego.time_us;
    ObjectOrder order;
    const int dropped = choose_objects(output, dialect_spec(dialect).max_objects, order);
    SignalValues values;
    header_values(output, {list_counter, order.size(), dropped, time_us}, values);
    std::string out = row(frame, time_us, "", values);
    for (int slot = 0; slot < order.size(); ++slot) {
        object_values(output.objects[order[slot]], list_counter, values);
        out += row(frame, time_us, std::to_string(slot), values);
    }
    return out;
}

}  // namespace semtrack::sil
