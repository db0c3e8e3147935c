#include "sil/dbc/dbc_text.hpp"

#include <cstdio>
#include <vector>

#include "publish/e2e.hpp"
#include "publish/messages.hpp"

namespace semtrack::sil {

namespace {

constexpr std::uint32_t kExtendedFlag = 0x80000000U;
constexpr int kCycle_ms = 100;

struct DbcSignal {
    std::string name;
    int start;
    SignalSpec spec;
};

struct DbcMessage {
    std::uint32_t id;
    std::uint32_t data_id;
    MessageSpec spec;
    std::vector<DbcSignal> signals;
};

std::string number(double x) {
    char text[40];
    (void)std::snprintf(text, sizeof text, "%.10g", x);
    return text;
}

SignalSpec plain(const char* name, int length, const char* comment) {
    return {name, static_cast<std::uint8_t>(length), true, 1.0, 0.0, "", nullptr, comment};
}

std::vector<DbcSignal> frame_signals(const DialectSpec& d) {
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
    const SignalSpec& counter = signal_spec(SignalId::kListCounter);
    out.push_back({counter.name, list_counter_bit(d), counter});
    return out;
}

DbcMessage message_of(const CanConfig& config, const DialectSpec& d, int k) {
    const MessageSpec& m = d.message[static_cast<std::size_t>(k)];
    DbcMessage out{(config.base_id + static_cast<std::uint32_t>(k)) | (config.extended ? kExtendedFlag : 0U),
                   static_cast<std::uint32_t>(kE2eFirstDataId + k), m, frame_signals(d)};
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

std::string signal_row(const DbcSignal& s) {
    const double lowest = s.spec.offset;
    const double highest = physical(s.spec, max_raw(s.spec));
    return " SG_ " + s.name + " : " + std::to_string(s.start) + "|" + std::to_string(s.spec.length) + "@1+ (" +
           number(s.spec.scale) + "," + number(s.spec.offset) + ") [" + number(lowest) + "|" + number(highest) +
           "] \"" + s.spec.unit + "\" Receiver\n";
}

std::string value_rows(const DbcMessage& m) {
    std::string out;
    for (const DbcSignal& s : m.signals) {
        if (s.spec.counts) {
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
        out += "CM_ SG_ " + std::to_string(m.id) + " " + s.name + " \"" + s.spec.comment + "\";\n";
    }
    return out;
}

std::string attribute_rows(const CanConfig& config, const DialectSpec& d, const DbcMessage& m) {
    const std::string id = std::to_string(m.id);
    const int format = (d.fd ? 14 : 0) + (config.extended ? 1 : 0);
    std::string out = "BA_ \"VFrameFormat\" BO_ " + id + " " + std::to_string(format) + ";\n";
    out += "BA_ \"GenMsgCycleTime\" BO_ " + id + " " + std::to_string(kCycle_ms) + ";\n";
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
        messages.push_back(message_of(config, d, k));
    }
    std::string out =
        "VERSION \"" + std::to_string(kProtocolVersion) + "\"\n\nNS_ :\n\nBS_:\n\nBU_: Semtrack Receiver\n\n";
    for (const DbcMessage& m : messages) {
        out += "BO_ " + std::to_string(m.id) + " " + m.spec.name + ": " + std::to_string(m.spec.length) + " Semtrack\n";
        for (const DbcSignal& s : m.signals) {
            out += signal_row(s);
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
