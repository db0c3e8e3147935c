#include "sil/dbc/dbc_text.hpp"

#include <cstdio>
#include <vector>

#include "publish/e2e.hpp"
#include "publish/messages.hpp"

namespace semtrack::sil {

namespace {

constexpr std::uint32_t kExtendedFlag = 0x80000000U;
constexpr int kCycle_ms = 100;
constexpr int kMotionCycle_ms = 20;  // of VehicleMotion

struct DbcSignal {
    std::string name;
    int start;
    SignalSpec spec;
};

struct DbcMessage {
    std::uint32_t id;
    std::uint32_t data_id;
    MessageSpec spec;
    const char* sender;
    const char* receiver;
    int cycle_ms;
    std::vector<DbcSignal> signals;
};

std::string number(double x) {
    char text[40];  // never with an exponent: not every tool reads one; 40 bits are 13 digits
    (void)std::snprintf(text, sizeof text, "%.6f", x);
    std::string out = text;
    out.erase(out.find_last_not_of('0') + 1);
    if (out.back() == '.') {
        out.pop_back();
    }
    return out;
}

SignalSpec plain(const char* name, int length, const char* comment) {
    return {name, static_cast<std::uint8_t>(length), true, 1.0, 0.0, "", nullptr, comment};
}

std::vector<DbcSignal> protection_signals(const DialectSpec& d) {
    std::vector<DbcSignal> out;
    if (d.fd) {
        out.push_back({"E2eCrc", 0,
                       plain("E2eCrc", 16, "E2E Profile 5: CRC-16 0x1021 over the bytes behind it, then the data id")});
        out.push_back(
            {"E2eCounter", 16, plain("E2eCounter", 8, "E2E Profile 5: counts the frames of this message, 0..255")});
    } else {
        out.push_back(
            {"E2eCrc", 0,
             plain("E2eCrc", 8, "E2E Profile 11, nibble mode: CRC-8 0x1D over data id and the bytes behind it")});
        out.push_back(
            {"E2eCounter", 8, plain("E2eCounter", 4, "E2E Profile 11: counts the frames of this message, 0..14")});
        out.push_back(
            {"E2eDataIdNibble", 12, plain("E2eDataIdNibble", 4, "E2E Profile 11: bits 8 to 11 of the data id")});
    }
    return out;
}

DbcMessage bare_message(const CanConfig& config, const DialectSpec& d, int k, const MessageSpec& m) {
    return {(config.base_id + static_cast<std::uint32_t>(k)) | (config.extended ? kExtendedFlag : 0U),
            static_cast<std::uint32_t>(kE2eFirstDataId + k),
            m,
            "Semtrack",
            "Receiver",
            kCycle_ms,
            protection_signals(d)};
}

DbcMessage list_message(const CanConfig& config, const DialectSpec& d, int k) {
    const MessageSpec& m = d.message[static_cast<std::size_t>(k)];
    DbcMessage out = bare_message(config, d, k, m);
    const SignalSpec& counter = signal_spec(SignalId::kListCounter);
    out.signals.push_back({counter.name, list_counter_bit(d), counter});
    if (m.records > 0) {
        const char* comment = m.records > 1 ? "Number of the frame in the list: it holds objects 2 n and 2 n + 1"
                                            : "Number of the object in the list";
        out.signals.push_back({d.index_name, record_index_bit(d), plain(d.index_name, kRecordIndexBits, comment)});
    }
    int bit = first_signal_bit(d, m);
    for (int r = 0; r < (m.records > 0 ? m.records : 1); ++r) {
        for (int i = 0; i < m.signals; ++i) {
            const SignalSpec& s = signal_spec(m.signal[static_cast<std::size_t>(i)]);
            const std::string suffix = m.records > 1 ? "_" + std::to_string(r) : "";
            out.signals.push_back({s.name + suffix, bit, s});
            bit += s.length;
        }
    }
    return out;
}

DbcMessage motion_message(const CanConfig& config, const DialectSpec& d) {
    const MessageSpec& m = d.vehicle_motion;
    DbcMessage out = bare_message(config, d, d.messages, m);
    out.sender = "Vehicle";
    out.receiver = "Semtrack";
    out.cycle_ms = kMotionCycle_ms;
    int bit = protection_bits(d);
    for (int i = 0; i < m.signals; ++i) {
        const SignalSpec& s = signal_spec(m.signal[static_cast<std::size_t>(i)]);
        out.signals.push_back({s.name, bit, s});
        bit += s.length;
    }
    return out;
}

std::string signal_row(const DbcSignal& s, const char* receiver) {
    const double lowest = s.spec.offset;
    const double highest = physical(s.spec, max_raw(s.spec));
    return " SG_ " + s.name + " : " + std::to_string(s.start) + "|" + std::to_string(s.spec.length) + "@1+ (" +
           number(s.spec.scale) + "," + number(s.spec.offset) + ") [" + number(lowest) + "|" + number(highest) +
           "] \"" + s.spec.unit + "\" " + receiver + "\n";
}

bool is_integer(const SignalSpec& s) {
    return s.scale == 1.0 && s.offset == 0.0;
}

/// Of integers only: tools disagree whether the keys of a scaled signal are raw or physical values.
std::string value_rows(const DbcMessage& m) {
    std::string out;
    for (const DbcSignal& s : m.signals) {
        if (s.spec.counts || !is_integer(s.spec)) {
            continue;
        }
        out += "VAL_ " + std::to_string(m.id) + " " + s.name;
        std::string rest = s.spec.values == nullptr ? "" : s.spec.values;
        while (!rest.empty()) {
            const std::size_t end = rest.find(';');
            const std::string item = rest.substr(0, end);
            const std::size_t blank = item.find(' ');
            out += " " + item.substr(0, blank) + " \"" + item.substr(blank + 1) + "\"";
            rest = end == std::string::npos ? "" : rest.substr(end + 1);
        }
        out += " " + std::to_string(all_ones(s.spec.length)) + " \"not available\" ;\n";
    }
    return out;
}

std::string comment_rows(const DbcMessage& m) {
    std::string out = "CM_ BO_ " + std::to_string(m.id) + " \"" + m.spec.comment + "\";\n";
    for (const DbcSignal& s : m.signals) {
        out += "CM_ SG_ " + std::to_string(m.id) + " " + s.name + " \"" + s.spec.comment +
               (s.spec.counts ? "" : ". All ones: not available") + "\";\n";
    }
    return out;
}

std::string attribute_rows(const CanConfig& config, const DialectSpec& d, const DbcMessage& m) {
    const std::string id = std::to_string(m.id);
    const int format = (d.fd ? 14 : 0) + (config.extended ? 1 : 0);
    std::string out = "BA_ \"VFrameFormat\" BO_ " + id + " " + std::to_string(format) + ";\n";
    out += "BA_ \"GenMsgCycleTime\" BO_ " + id + " " + std::to_string(m.cycle_ms) + ";\n";
    out += "BA_ \"E2eDataId\" BO_ " + id + " " + std::to_string(m.data_id) + ";\n";
    if (d.fd) {
        out += "BA_ \"CANFD_BRS\" BO_ " + id + " 1;\n";
    }
    for (const DbcSignal& s : m.signals) {
        if (!s.spec.counts) {
            out += "BA_ \"GenSigStartValue\" SG_ " + id + " " + s.name + " " + std::to_string(all_ones(s.spec.length)) +
                   ";\n";
        }
    }
    return out;
}

std::string definitions(const DialectSpec& d) {
    std::string formats = "\"StandardCAN\",\"ExtendedCAN\"";
    for (int i = 2; i < 14; ++i) {
        formats += ",\"reserved\"";
    }
    formats += ",\"StandardCAN_FD\",\"ExtendedCAN_FD\"";
    std::string out = "BA_DEF_ \"BusType\" STRING ;\n";
    out += "BA_DEF_ BO_ \"VFrameFormat\" ENUM " + formats + ";\n";
    out += "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;\n";
    out += "BA_DEF_ BO_ \"E2eDataId\" INT 0 65535;\n";
    out += "BA_DEF_ BO_ \"CANFD_BRS\" ENUM \"0\",\"1\";\n";
    out += "BA_DEF_ SG_ \"GenSigStartValue\" INT 0 2147483647;\n";
    out += "BA_DEF_DEF_ \"BusType\" \"CAN\";\n";
    out += "BA_DEF_DEF_ \"VFrameFormat\" \"StandardCAN\";\n";
    out += "BA_DEF_DEF_ \"GenMsgCycleTime\" 0;\n";
    out += "BA_DEF_DEF_ \"E2eDataId\" 0;\n";
    out += "BA_DEF_DEF_ \"CANFD_BRS\" \"0\";\n";
    out += "BA_DEF_DEF_ \"GenSigStartValue\" 0;\n";
    out += std::string("BA_ \"BusType\" \"") + (d.fd ? "CAN FD" : "CAN") + "\";\n";
    return out;
}

}  // namespace

std::string dbc_text(const CanConfig& config) {
    const DialectSpec& d = dialect_spec(config.dialect);
    std::vector<DbcMessage> messages;
    for (int k = 0; k < d.messages; ++k) {
        messages.push_back(list_message(config, d, k));
    }
    messages.push_back(motion_message(config, d));
    std::string out =
        "VERSION \"" + std::to_string(kProtocolVersion) + "\"\n\nNS_ :\n\nBS_:\n\nBU_: Semtrack Receiver Vehicle\n\n";
    for (const DbcMessage& m : messages) {
        out += "BO_ " + std::to_string(m.id) + " " + m.spec.name + ": " + std::to_string(m.spec.length) + " " +
               m.sender + "\n";
        for (const DbcSignal& s : m.signals) {
            out += signal_row(s, m.receiver);
        }
        out += "\n";
    }
    out +=
        "CM_ \"semtrack object list. Vehicle frame as in ISO 8855: x forward, y left, z up. Velocities over ground. "
        "All ones: not available.\";\n";
    for (const DbcMessage& m : messages) {
        out += comment_rows(m);
    }
    out += definitions(d);
    for (const DbcMessage& m : messages) {
        out += attribute_rows(config, d, m);
    }
    for (const DbcMessage& m : messages) {
        out += value_rows(m);
    }
    return out;
}

}  // namespace semtrack::sil
